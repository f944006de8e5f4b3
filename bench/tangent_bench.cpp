// SPDX-License-Identifier: GPL-2.0-or-later
// The cost of the condensed tangent of 400 and 1600 grains (the packing of cases/biaxial and four copies of
// it, a tenth of the contacts sliding, a tenth at the rolling limit), in processor time: by fronts with each
// instruction set, the plain way, and two yardsticks that solve the same equations: UMFPACK, and Eigen's LDLT
// of a network without sliding.
//
//   build/release/bench/tangent_bench        from the root of the project; half a minute
#include <fmt/format.h>
#include <time.h>

#include <Eigen/Sparse>
#include <Eigen/UmfPackSupport>
#include <algorithm>
#include <vector>

#include "dem/cell/averages.hpp"
#include "dem/cell/condensed_tangent.hpp"
#include "dem/cell/plain_tangents.hpp"
#include "dem/cell/tangents.hpp"
#include "tests/support/contact_networks.hpp"

namespace polargrain {
namespace {

double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

template <typename Work>
void report(const std::string& name, int grains, Work work) {
  constexpr double kSeconds = 1.0;
  std::vector<double> times;
  for (double sum = 0.0; sum < kSeconds || times.size() < 5; sum += times.back()) {
    const double start = processor_seconds();
    work();
    times.push_back(processor_seconds() - start);
  }
  std::sort(times.begin(), times.end());
  fmt::print("{:>8} {:<44} {:>10.2f} {:>10.2f}\n", grains, name, 1e3 * times.front(),
             1e3 * times[times.size() / 2]);
}

/// The equations of a network as one sparse matrix, for a yardstick: `strains` right-hand sides, and with
/// weights one more unknown.
template <typename Solver>
void solve_with(const dem::ContactNetwork& network, int strains, std::span<const double> weights) {
  const int unknowns = 3 * network.grains + (weights.empty() ? 0 : 1);
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(36 * network.contacts.size() + 5 * static_cast<std::size_t>(network.grains));
  Eigen::MatrixXd loads = Eigen::MatrixXd::Zero(unknowns, strains);
  for (const dem::Contact& contact : network.contacts) {
    const dem::LinearContact law(contact, network.frame);
    const Eigen::Matrix<double, 6, 3> forces = law.motions.transpose() * law.stiffness;
    const Eigen::Matrix<double, 6, 6> stiffness = forces * law.motions;
    const Eigen::Matrix<double, 6, 7> load = forces * law.affine;
    const int place[2] = {3 * contact.first, 3 * contact.second};
    for (int column = 0; column < 6; ++column)
      for (int row = 0; row < 6; ++row)
        entries.emplace_back(place[row / 3] + row % 3, place[column / 3] + column % 3,
                             stiffness(row, column));
    for (int side = 0; side < 2; ++side)
      loads.middleRows<3>(place[side]) -= load.middleRows<3>(3 * side).leftCols(strains);
  }
  const double spring = network.hold * dem::mean_normal_stiffness(network.contacts);
  const double arm = network.contacts.front().arm_first;
  for (int grain = 0; grain < network.grains; ++grain) {
    for (int k = 0; k < 3; ++k)
      entries.emplace_back(3 * grain + k, 3 * grain + k, k < 2 ? spring : spring * arm * arm);
    if (weights.empty()) continue;
    entries.emplace_back(3 * grain + 2, 3 * network.grains, weights[grain]);
    entries.emplace_back(3 * network.grains, 3 * grain + 2, weights[grain]);
  }
  Eigen::SparseMatrix<double> matrix(unknowns, unknowns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Solver solver(matrix);
  const Eigen::MatrixXd fluctuations = solver.solve(loads);
  if (!fluctuations.allFinite()) fmt::print("the yardstick found no solution\n");
}

void compare(const Packing& packing) {
  const auto grains = static_cast<int>(packing.grains.size());
  const std::vector<dem::Contact> contacts = test::contacts_of(packing, {0.1, 0.1, 1});
  const std::vector<dem::Contact> sticking = test::contacts_of(packing, {});
  const Eigen::Matrix2d frame = Eigen::Matrix2d::Identity();
  const dem::ContactNetwork network{contacts, grains, frame, packing.volume(), 1e-4};
  const dem::ContactNetwork elastic{sticking, grains, frame, packing.volume(), 1e-4};
  const std::vector<double> weights(packing.grains.size(), 1.0 / grains);

  report("Voigt", grains, [&] { dem::voigt_cosserat_tangent(contacts, frame, packing.volume()); });
  dem::EliminationPlan plan;
  report("plan of the elimination", grains, [&] { plan.make(contacts, grains); });
  for (const auto& [set, name] :
       {std::pair{dem::InstructionSet::baseline, "baseline"}, std::pair{dem::InstructionSet::avx2, "avx2"},
        std::pair{dem::InstructionSet::avx512, "avx512"}}) {
    if (!dem::is_supported(set)) continue;
    dem::CondensedTangent tangent(set);
    report(fmt::format("classical, by fronts, {}", name), grains, [&] { tangent.classical(network); });
    report(fmt::format("Cosserat, by fronts, {}", name), grains, [&] { tangent.cosserat(network, weights); });
  }
  report("classical, the plain way", grains, [&] { dem::plain_classical_tangent(network); });
  report("Cosserat, the plain way", grains, [&] { dem::plain_cosserat_tangent(network, weights); });
  using Umfpack = Eigen::UmfPackLU<Eigen::SparseMatrix<double>>;
  report("classical, UMFPACK", grains, [&] { solve_with<Umfpack>(network, 3, {}); });
  report("Cosserat, UMFPACK", grains, [&] { solve_with<Umfpack>(network, 7, weights); });
  using Ldlt = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>;
  report("classical, LDLT, nothing slides", grains, [&] { solve_with<Ldlt>(elastic, 3, {}); });
}

}  // namespace
}  // namespace polargrain

int main() {
  using namespace polargrain;
  fmt::print("{:>8} {:<44} {:>10} {:>10}\n", "grains", "tangent", "least ms", "median ms");
  const Packing packing = read_packing("cases/biaxial/packing400.csv");
  for (const int times : {1, 2}) compare(test::tiled(packing, times));
}
