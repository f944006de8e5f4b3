// SPDX-License-Identifier: GPL-2.0-or-later
// A run that starts from the end of another one, on its mesh and on a finer one.
#include <gtest/gtest.h>

#include <iostream>

#include "common/error.hpp"
#include "common/memory_archive.hpp"
#include "fem/material/cone_matching.hpp"
#include "fem/material/elastoplastic.hpp"
#include "fem/material/local_material.hpp"
#include "fem/mesh/rectangle.hpp"
#include "fem/solver/geostatic.hpp"
#include "fem/solver/nearest_states.hpp"
#include "fem/solver/solver.hpp"

using namespace polargrain;
using namespace polargrain::fem;

namespace {

const TimeTable kZero = TimeTable::constant(0.0);
constexpr double kWeight = 18e3;
const std::vector<std::string> kRegions{"lower", "upper"};

std::shared_ptr<Material<2>> soil(double cohesion) {
  ElastoplasticParameters<2> parameters;
  parameters.elastic = {40e6, 0.3, 10e6, 0.01, Vector7::Zero()};
  const FrozenCone cone = cone_from_plane_strain({30, 2, cohesion});
  parameters.cone = {cone.friction, cone.dilatancy, cone.cohesion};
  return std::make_shared<LocalMaterial<ElastoplasticLaw<2>>>(ElastoplasticLaw<2>(parameters));
}

/// Ground of two layers with a strip load at the middle of its surface.
Problem<2> ground(int per_metre, double load) {
  Problem<2> problem;
  problem.mesh = rectangle({{4.0, 2.0}, {4 * per_metre, 2 * per_metre}});
  for (const int e : problem.mesh.regions.at("all")) {
    const Eigen::Vector2d centre = problem.mesh.element_positions(e).colwise().mean();
    problem.mesh.regions[centre.y() < 1.0 ? "lower" : "upper"].push_back(e);
  }
  std::vector<BoundarySide>& strip = problem.mesh.boundaries["strip"];
  for (const BoundarySide& side : problem.mesh.boundaries.at("top")) {
    double x = 0.0;
    const std::vector<int> nodes = problem.mesh.side_nodes(side);
    for (const int node : nodes)
      x += problem.mesh.nodes[static_cast<std::size_t>(node)].x() / static_cast<double>(nodes.size());
    if (x > 1.0 && x < 3.0) strip.push_back(side);
  }
  problem.materials["lower"] = soil(2e3);
  problem.materials["upper"] = soil(5e3);
  problem.prescribed = {{"left", Dof::u1, kZero},
                        {"right", Dof::u1, kZero},
                        {"bottom", Dof::u1, kZero},
                        {"bottom", Dof::u2, kZero}};
  problem.body_loads = {gravity(kWeight)};
  problem.initial_stresses = {geostatic_stress({2.0, kWeight, 0.5, 0.0})};
  problem.boundary_loads = {{.on = "strip", .pressure = TimeTable({{0, 0}, {1, load}})}};
  return problem;
}

/// The end of a run under a strip load, at which points have yielded.
struct End {
  MemoryArchive archive;
  std::vector<Vector7> stresses;
  double base = 0.0;
  double moved = 0.0;  ///< the largest displacement, m
};

constexpr double kLoad = 40e3;

End end_of_first_run() {
  End end;
  Solver<2> solver(ground(2, kLoad), {});
  EXPECT_TRUE(solver.equilibrate().converged);
  for (int step = 1; step <= 4; ++step) EXPECT_TRUE(solver.advance(0.25 * step).converged);
  solver.save(end.archive);
  for (const auto& response : solver.state().responses) end.stresses.push_back(response.stress);
  end.base = solver.reaction("bottom")(1);
  end.moved = solver.state().displacement.lpNorm<Eigen::Infinity>();
  return end;
}

Problem<2> loaded(int per_metre) {
  Problem<2> problem = ground(per_metre, kLoad);
  problem.boundary_loads.front().pressure = TimeTable::constant(kLoad);
  problem.initial_stresses.clear();
  return problem;
}

TEST(start_from, the_end_of_a_run_on_the_same_mesh_is_in_balance_with_the_same_stresses) {
  End end = end_of_first_run();
  Solver<2> solver(loaded(2), {});
  const StepReport report = solver.start_from(end.archive, kRegions);
  ASSERT_TRUE(report.converged) << report.message;
  for (std::size_t i = 0; i < end.stresses.size(); ++i)
    EXPECT_LT((solver.state().responses[i].stress - end.stresses[i]).norm(), 1e-6 * end.stresses[i].norm());
  EXPECT_LT(solver.state().displacement.lpNorm<Eigen::Infinity>(), 1e-9);
}

TEST(start_from, the_end_of_a_run_on_another_mesh_lets_the_difference_go) {
  for (const int per_metre : {1, 3, 4}) {
    End end = end_of_first_run();
    Solver<2> solver(loaded(per_metre), {});
    const StepReport report = solver.start_from(end.archive, kRegions);
    ASSERT_TRUE(report.converged) << report.message;
    EXPECT_NEAR(solver.reaction("bottom")(1) / end.base, 1.0, 1e-6);  // the loads are the same
    // Stresses that are constant around each old point are out of balance on another mesh: it moves, by less than the load
    // has moved the ground (0.13 to 0.57 of it).
    const double moved = solver.state().displacement.lpNorm<Eigen::Infinity>();
    std::cout << "[figure] " << per_metre << " elements a metre from 2: moved by " << moved
              << " m, the load by " << end.moved << '\n';
    EXPECT_LT(moved, end.moved);
  }
}

TEST(start_from, a_run_without_a_region_is_refused_by_name) {
  End end = end_of_first_run();
  Solver<2> solver(loaded(2), {});
  try {
    (void)solver.start_from(end.archive, {"lower", "middle"});
    FAIL();
  } catch (const RunError& error) {
    EXPECT_STREQ(error.what(), "it has no region 'upper'; it has lower, middle");
  }
}

TEST(nearest_places, finds_the_same_as_looking_at_all) {
  std::vector<Eigen::Vector2d> places;
  std::vector<Eigen::Vector2d> among;
  for (int i = 0; i < 60; ++i) {
    places.emplace_back(std::fmod(0.37 * i, 1.0), std::fmod(0.71 * i, 1.0));
    among.emplace_back(std::fmod(0.53 * i, 1.0), std::fmod(0.29 * i, 1.0));
  }
  const std::vector<std::size_t> found = nearest_places<2>(places, among);
  for (std::size_t k = 0; k < places.size(); ++k) {
    for (const Eigen::Vector2d& other : among)
      EXPECT_LE((among[found[k]] - places[k]).norm(), (other - places[k]).norm());
  }
}

}  // namespace
