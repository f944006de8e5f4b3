// SPDX-License-Identifier: GPL-2.0-or-later
// The condensed tangent of 1,000 spheres on states along compression, most contacts slipping: its distance from central
// differences of the cell, over the stiffness of the spring that holds each grain; and at the stiffness that cells take
// the milliseconds of processor time in double precision, in single precision, and how far that lies off.
//
//   build/release/bench/sphere_tangent_bench        2> figures, from the root of the project; two minutes
#include <fmt/format.h>
#include <time.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "common/processor.hpp"
#include "tests/support/sheared_spheres.hpp"
#include "tests/support/sphere_cells.hpp"

namespace polargrain {
namespace {

constexpr double kHolds[] = {1e-4, 3e-4, 1e-3, 3e-3, 1e-2, 3e-2};
constexpr int kPairs[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};
using Columns = Eigen::Matrix<double, 9, 6>;

double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// The columns of the six symmetric strains.
Columns columns_of(const Matrix18& tangent) {
  Columns columns;
  for (int k = 0; k < 6; ++k) {
    const auto [i, j] = kPairs[k];
    columns.col(k) = 0.5 * (tangent.col(3 * i + j) + tangent.col(3 * j + i)).head<9>();
  }
  return columns;
}

Columns differences(CellService& cell, const CellRequest& about, double strain) {
  Columns columns;
  for (int k = 0; k < 6; ++k) {
    const auto [i, j] = kPairs[k];
    const auto moved = [&](double sign) {
      CellRequest request = about;
      request.increment.displacement_gradient(i, j) += 0.5 * sign * strain;
      request.increment.displacement_gradient(j, i) += 0.5 * sign * strain;
      return cell.evaluate(request).response.components();
    };
    columns.col(k) = (moved(1.0) - moved(-1.0)).head<9>() / (2.0 * strain);
  }
  return columns;
}

void bench(const std::string& name, CellDefinition definition, const Eigen::Vector3d& strains, int increments,
           int keep) {
  definition.control.inertial_number = 1e-3;
  const Eigen::Matrix3d gradient = strains.asDiagonal();
  const std::vector<test::LoadedNetwork> networks =
      test::loaded_networks(definition, gradient, increments, keep);
  definition.control.tangent = CellTangent::none;
  const auto cell = dem::make_cell_service(definition);
  CellRequest request;
  request.increment.displacement_gradient = gradient;
  for (int k = 1; k <= increments; ++k) {
    if (k % keep == 0) {
      const test::LoadedNetwork& loaded = networks[static_cast<std::size_t>(k / keep - 1)];
      const Columns expected = differences(*cell, request, 2e-4);
      const auto off = [&expected](const Matrix18& tangent) {
        return (columns_of(tangent) - expected).norm() / expected.norm();
      };
      dem::CondensedSpaceTangent tangent(dem::best_instruction_set(), dem::EliminationDigits::whole);
      dem::CondensedSpaceTangent quick;
      std::string line = fmt::format("{:<26} {:>7.3f} {:>8.0f} {:>7.2f}", name, loaded.strain,
                                     100.0 * loaded.sliding, off(voigt_space_tangent(loaded.network())));
      for (const double hold : kHolds) {
        const auto found = tangent.classical(loaded.network(hold));
        line += found ? fmt::format(" {:>6.3f}", off(*found)) : fmt::format(" {:>6}", "none");
      }
      const auto milliseconds = [&loaded](dem::CondensedSpaceTangent& of) {
        double least = 1e300;
        for (int repeat = 0; repeat < 7; ++repeat) {
          const double start = processor_seconds();
          of.classical(loaded.network(3e-3));
          least = std::min(least, processor_seconds() - start);
        }
        return 1e3 * least;
      };
      const Matrix18 whole = tangent.classical(loaded.network(3e-3)).value();
      const Matrix18 single = quick.classical(loaded.network(3e-3)).value();
      fmt::print(stderr, "{} {:>7.1f} {:>7.1f} {:>8.1e}{}\n", line, milliseconds(tangent),
                 milliseconds(quick), (single - whole).norm() / whole.norm(),
                 quick.repeated() > 0 ? " repeated" : "");
    }
    request.state = cell->evaluate(request).state;
  }
}

int main_of_bench() {
  setenv("OMPI_MCA_ess_singleton_isolated", "1", 1);
  setenv("OMPI_MCA_btl", "self", 1);
  dem::start_engine_process();
  fmt::print(stderr, "{}\nDistance of tangents from differences of 2e-4, increments of 1e-3\n\n",
             processor_model());
  fmt::print(stderr, "{:<26} {:>7} {:>8} {:>7}", "", "strain", "sliding%", "Voigt");
  for (const double hold : kHolds) fmt::print(stderr, " {:>6.0e}", hold);
  fmt::print(stderr, " {:>7} {:>7} {:>8}\n", "ms", "single", "off");
  const Eigen::Vector3d constant_volume(5e-4, 5e-4, -1e-3);
  const Eigen::Vector3d plane_strain(1.1e-3, 0.0, -1e-3);
  bench("history, constant volume", test::linear_spheres(), constant_volume, 6, 2);
  bench("history, plane strain", test::linear_spheres(), plane_strain, 24, 8);
  bench("li_chu, plane strain", test::rolling_spheres(test::linear_spheres(), 1.0, 0.2), plane_strain, 16, 8);
  bench("Hertz, plane strain", test::hertz_spheres(), plane_strain, 16, 8);
  return 0;
}

}  // namespace
}  // namespace polargrain

int main() {
  return polargrain::main_of_bench();
}
