// SPDX-License-Identifier: GPL-2.0-or-later
// The condensed tangent of 400 discs on states along biaxial compression: its distance from central differences of the cell,
// over the stiffness of the spring that holds each grain. Packings are made here; two states of each.
//
//   build/release/bench/disc_tangent_bench [PACKINGS]       2> figures, from the root of the project; a minute
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <vector>

#include "dem/cell/cell_service.hpp"
#include "dem/cell/condensed_tangent.hpp"
#include "dem/engine/engine.hpp"
#include "dem/pack/prepare.hpp"
#include "tests/support/packings_to_make.hpp"

namespace polargrain {
namespace {

constexpr std::array kHolds{1e-5, 1e-4, 3e-4, 1e-3, 3e-3, 1e-2, 3e-2};
constexpr double kIncrement = 1e-3;
constexpr int kIncrements = 12;
constexpr int kKeep = 6;

/// Stresses 11, 22, 12 and 21 over the strains e11, e22 and e12 + e21.
using Columns = Eigen::Matrix<double, 4, 3>;

Eigen::Vector4d stress_of(const CellReply& reply) {
  const Eigen::Matrix3d& stress = reply.response.stress;
  return {stress(0, 0), stress(1, 1), stress(0, 1), stress(1, 0)};
}

Columns differences(CellService& cell, const CellRequest& about, double strain) {
  Columns columns;
  for (int k = 0; k < 3; ++k) {
    const auto moved = [&](double sign) {
      CellRequest request = about;
      Eigen::Matrix3d& gradient = request.increment.displacement_gradient;
      const int i = k == 1 ? 1 : 0, j = k == 0 ? 0 : 1;
      gradient(i, j) += 0.5 * sign * strain;
      gradient(j, i) += 0.5 * sign * strain;
      return stress_of(cell.evaluate(request));
    };
    columns.col(k) = (moved(1.0) - moved(-1.0)) / (2.0 * strain);
  }
  return columns;
}

Columns columns_of(const Matrix7& tangent) {
  Columns columns;
  const std::array rows{k11, k22, k12, k21};
  for (int row = 0; row < 4; ++row)
    columns.row(row) << tangent(rows[row], k11), tangent(rows[row], k22),
        0.5 * (tangent(rows[row], k12) + tangent(rows[row], k21));
  return columns;
}

std::vector<std::vector<double>> off_of(int seed) {
  PackingSpecification asked = dem::specification(400, 0.5);
  asked.seed = static_cast<std::uint64_t>(seed);
  CellDefinition definition = test::demo_cell();
  definition.script = asked.script;
  definition.script_file = asked.script_file;
  definition.packing = dem::prepare_packing(asked, {}).packing;
  definition.control.tangent = CellTangent::none;
  const auto cell = dem::make_cell_service(definition);
  definition.control.unbalanced_force_ratio = definition.control.unbalanced_moment_ratio =
      std::numeric_limits<double>::max();
  const auto watcher = dem::make_cell_service(definition);
  std::vector<std::vector<double>> rows;
  CellRequest request{cell->initial().state, {}};
  request.increment.displacement_gradient.diagonal() << 0.8 * kIncrement, -kIncrement, 0.0;
  for (int k = 1; k <= kIncrements; ++k) {
    if (k % kKeep == 0) {
      const CellReply loaded = watcher->evaluate(request);
      const dem::ContactNetwork network{watcher->contacts(),
                                        static_cast<int>(definition.packing.grains.size()),
                                        Eigen::Matrix2d::Identity(),
                                        watcher->view().box.determinant(),
                                        0.0,
                                        kIncrement};
      const Columns expected = differences(*cell, request, 2e-4);
      std::vector<double>& row = rows.emplace_back();
      dem::CondensedTangent tangent;
      for (const double hold : kHolds) {
        dem::ContactNetwork held = network;
        held.hold = hold;
        const auto found = tangent.classical(held);
        row.push_back(found ? (columns_of(*found) - expected).norm() / expected.norm()
                            : std::numeric_limits<double>::quiet_NaN());
      }
      fmt::print(stderr, "{:>4} {:>7.3f} {:>8.0f}", seed, k * kIncrement,
                 100.0 * loaded.diagnostics.sliding_fraction);
      for (const double off : row) fmt::print(stderr, " {:>7.3f}", off);
      fmt::print(stderr, "\n");
    }
    request.state = cell->evaluate(request).state;
  }
  return rows;
}

int main_of_bench(int packings) {
  setenv("OMPI_MCA_ess_singleton_isolated", "1", 1);
  setenv("OMPI_MCA_btl", "self", 1);
  dem::start_engine_process();
  fmt::print(stderr, "Distance of tangents from differences of 2e-4, increments of {}\n\n{:>4} {:>7} {:>8}",
             kIncrement, "seed", "strain", "sliding%");
  for (const double hold : kHolds) fmt::print(stderr, " {:>7.0e}", hold);
  fmt::print(stderr, "\n");
  std::vector<std::vector<double>> all;
  for (int seed = 1; seed <= packings; ++seed)
    for (std::vector<double>& row : off_of(seed)) all.push_back(std::move(row));
  fmt::print(stderr, "{:<21}", "mean");
  for (std::size_t hold = 0; hold < kHolds.size(); ++hold) {
    double mean = 0.0;
    for (const auto& row : all) mean += row[hold] / static_cast<double>(all.size());
    fmt::print(stderr, " {:>7.3f}", mean);
  }
  fmt::print(stderr, "\n");
  return 0;
}

}  // namespace
}  // namespace polargrain

int main(int count, char** words) {
  return polargrain::main_of_bench(count > 1 ? std::atoi(words[1]) : 6);
}
