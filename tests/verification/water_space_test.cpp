// SPDX-License-Identifier: GPL-2.0-or-later
// Cryer's sphere: loaded at its drained surface, the pressure of its centre rises before it falls.
#include <array>
#include <cmath>

#include "tests/verification/water_scenes.hpp"

using namespace polargrain;
using namespace polargrain::fem;

namespace {

/// An eighth of a ball of radius 1: a cube of half the radius, and a block from each of its outer faces to the surface, with n elements
/// along each edge. Boundary `side`; node sets of the planes of symmetry.
Mesh<3> eighth_of_ball(int n) {
  const ElementType<3>& type = element_type<3>("H20R");
  const auto in_block = [](int block, const Eigen::Vector3d& at) -> Eigen::Vector3d {
    if (block == 3) return 0.5 * at;
    // The third coordinate goes out along axis `block`; the others go over the face.
    Eigen::Vector3d face = Eigen::Vector3d::Ones();
    face((block + 1) % 3) = at(0);
    face((block + 2) % 3) = at(1);
    return (1.0 - at(2)) * 0.5 * face + at(2) * face.normalized();
  };
  Mesh<3> mesh;
  const auto node_at = [&mesh](const Eigen::Vector3d& place) {
    for (std::size_t node = 0; node < mesh.nodes.size(); ++node)
      if ((mesh.nodes[node] - place).norm() < 1e-9) return static_cast<int>(node);
    mesh.nodes.push_back(place);
    return static_cast<int>(mesh.nodes.size()) - 1;
  };
  for (int block = 0; block < 4; ++block)
    for (int cell = 0; cell < n * n * n; ++cell) {
      Element<3> element{&type, {}};
      for (const auto& local : type.node_positions) {
        const Eigen::Vector3d corner(cell % n, cell / n % n, cell / n / n);
        element.nodes.push_back(
            node_at(in_block(block, (corner + 0.5 * (local + Eigen::Vector3d::Ones())) / n)));
      }
      mesh.regions["all"].push_back(static_cast<int>(mesh.elements.size()));
      mesh.elements.push_back(element);
    }
  for (int e = 0; e < static_cast<int>(mesh.elements.size()); ++e)
    for (int side = 0; side < 6; ++side)
      if (std::ranges::all_of(mesh.side_nodes({e, side}), [&](int node) {
            return std::abs(mesh.nodes[static_cast<std::size_t>(node)].norm() - 1.0) < 1e-9;
          }))
        mesh.boundaries["side"].push_back({e, side});
  for (int node = 0; node < static_cast<int>(mesh.nodes.size()); ++node)
    for (int axis = 0; axis < 3; ++axis)
      if (std::abs(mesh.nodes[static_cast<std::size_t>(node)](axis)) < 1e-9)
        mesh.node_sets[std::array{"left", "front", "bottom"}[static_cast<std::size_t>(axis)]].push_back(node);
  return mesh;
}

/// Pressure of the centre over the load at these time factors. @param n elements along half of the radius @param steps between the times
std::array<double, 5> pressures_of_centre(int n, int steps, const std::array<double, 5>& times) {
  Problem<3> problem;
  problem.mesh = eighth_of_ball(n);
  problem.continuum = Continuum::cauchy;
  problem.materials["all"] = elastic<3>(1e7, 0.25);
  const TimeTable zero = TimeTable::constant(0.0);
  problem.prescribed = {
      {"left", Dof::u1, zero, {}}, {"front", Dof::u2, zero, {}}, {"bottom", Dof::u3, zero, {}}};
  problem.boundary_loads.push_back({"side", TimeTable::constant(1e5)});
  PoreWaterOptions options;
  options.unit_weight = 1e4;
  add_pore_water<3>(problem, {{"all", {Permeability::constant(1e-8), 0.7, kIncompressible}}}, options);
  problem.prescribed_fields = {{kPorePressure, "side", zero}};
  Solver<3> solver(std::move(problem), {});
  expect_balance<3>(solver.equilibrate());
  std::array<double, 5> pressures{};
  for (std::size_t k = 0; k < times.size(); ++k) {
    go(solver, times[k] / 1.2e-5, steps);
    pressures[k] = pressure_at<3>(solver, {0.0, 0.0, 0.0}) / 1e5;
  }
  return pressures;
}

// Series of Cryer (1963), nu = 0.25, for fluid and grains that do not yield; the roots x of (1 - eta x^2 / 2) tan x = x with
// eta = (1 - nu) / (1 - 2 nu). Differences in the radius give the same to 1e-4. The error is of first order in time and of second in
// space: one run with shorter steps and one with smaller elements show what is left when both are drawn on, 0.2 % of the load.
TEST(water_space, cryers_sphere) {
  constexpr std::array<double, 5> kTimes{0.01, 0.02, 0.05, 0.1, 0.2};
  constexpr std::array<double, 5> kExact{1.153891, 1.218650, 1.307501, 1.117879, 0.606629};
  const auto first = pressures_of_centre(3, 12, kTimes);
  const auto shorter = pressures_of_centre(3, 24, kTimes);
  const auto smaller = pressures_of_centre(4, 12, kTimes);
  for (std::size_t k = 0; k < kTimes.size(); ++k) {
    EXPECT_NEAR(first[k], kExact[k], 0.02) << kTimes[k];
    const double of_time = 2.0 * (shorter[k] - first[k]);
    const double of_space = (smaller[k] - first[k]) / (1.0 - 9.0 / 16.0);
    EXPECT_NEAR(first[k] + of_time + of_space, kExact[k], 5e-3) << kTimes[k];
  }
}

}  // namespace
