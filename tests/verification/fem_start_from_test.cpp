// SPDX-License-Identifier: GPL-2.0-or-later
// A run that starts from the end of another one, on its mesh and on a finer one.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "common/error.hpp"
#include "common/memory_archive.hpp"
#include "fem/material/cone_matching.hpp"
#include "fem/material/elastoplastic.hpp"
#include "fem/material/local_material.hpp"
#include "fem/mesh/box.hpp"
#include "fem/mesh/rectangle.hpp"
#include "fem/solver/geostatic.hpp"
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
Problem<2> ground(int per_metre, double load, const std::string& element = "Q8R") {
  Problem<2> problem;
  problem.mesh = rectangle({{4.0, 2.0}, {4 * per_metre, 2 * per_metre}}, element);
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

constexpr double kLoad = 40e3;

/// A run under the strip load, at which points have yielded.
std::unique_ptr<Solver<2>> loaded_run(int per_metre, const std::string& element = "Q8R") {
  auto solver = std::make_unique<Solver<2>>(ground(per_metre, kLoad, element), SolverOptions{});
  EXPECT_TRUE(solver->equilibrate().converged);
  for (int step = 1; step <= 4; ++step) EXPECT_TRUE(solver->advance(0.25 * step).converged);
  return solver;
}

/// The same under the whole load from the start, for a run that begins there.
std::unique_ptr<Solver<2>> fresh(int per_metre, const std::string& element = "Q8R") {
  Problem<2> problem = ground(per_metre, kLoad, element);
  problem.boundary_loads.front().pressure = TimeTable::constant(kLoad);
  problem.initial_stresses.clear();
  return std::make_unique<Solver<2>>(std::move(problem), SolverOptions{});
}

MemoryArchive end_of(const Solver<2>& solver) {
  MemoryArchive archive;
  solver.save(archive);
  return archive;
}

/// Root mean square over the points of the difference of two runs' s22 on one mesh.
double difference(const Solver<2>& one, const Solver<2>& other) {
  double sum = 0.0;
  for (std::size_t i = 0; i < one.points(); ++i)
    sum += std::pow(one.state().responses[i].stress(k22) - other.state().responses[i].stress(k22), 2);
  return std::sqrt(sum / static_cast<double>(one.points()));
}

/// The largest displacement of a node along an axis, m.
double largest(const Solver<2>& solver) {
  double most = 0.0;
  for (Eigen::Index entry = 0; entry < solver.state().displacement.size(); ++entry)
    if (!is_rotation(dof_at<2>(entry))) most = std::max(most, std::abs(solver.state().displacement(entry)));
  return most;
}

TEST(start_from, the_end_of_a_run_on_the_same_mesh_is_that_end) {
  const auto before = loaded_run(2);
  MemoryArchive end = end_of(*before);
  const auto solver = fresh(2);
  const StartReport report = solver->start_from(end, kRegions);
  ASSERT_TRUE(report.step.converged) << report.step.message;
  EXPECT_TRUE(report.same_mesh);
  for (std::size_t i = 0; i < solver->points(); ++i) {
    const Vector7& stress = before->state().responses[i].stress;
    EXPECT_LT((solver->state().responses[i].stress - stress).norm(), 1e-12 * stress.norm());
    EXPECT_LT((solver->state().strain[i] - before->state().strain[i]).norm(), 1e-15);
  }
  EXPECT_EQ(solver->state().displacement, before->state().displacement);
  EXPECT_EQ(report.moved, 0.0);
}

class OnAnotherMesh : public ::testing::TestWithParam<std::tuple<int, std::string>> {};

// Linear functions smear the jump of the stress under the edges of the strip over an element of the old mesh. What is out of balance
// there acts over half of a metre, as a share of a strip of two metres; measured: it moves by 0.09 to 0.12 of the load's movement
// on all meshes, where the state of the nearest point moves by up to 0.57. The stresses end within 0.05 of the load of those of a run
// on the new mesh, rms.
TEST_P(OnAnotherMesh, the_difference_is_that_of_the_old_mesh) {
  const auto& [per_metre, element] = GetParam();
  const auto before = loaded_run(2);
  const auto direct = loaded_run(per_metre, element);
  MemoryArchive end = end_of(*before);
  const auto solver = fresh(per_metre, element);
  const StartReport report = solver->start_from(end, kRegions);
  ASSERT_TRUE(report.step.converged) << report.step.message;
  EXPECT_FALSE(report.same_mesh);
  EXPECT_EQ(report.outside, 0U);
  // The loads are the same, so the base carries the same.
  EXPECT_NEAR(solver->reaction("bottom")(1) / before->reaction("bottom")(1), 1.0, 1e-6);
  std::cout << "[figure] " << element << " " << per_metre << " a metre from 2: imbalance " << report.imbalance
            << ", moved " << report.moved << " m of " << largest(*before) << ", zeroed " << report.zeroed
            << ", s22 off by " << difference(*solver, *direct) << " Pa of " << kLoad << ", displacement "
            << largest(*solver) << " of " << largest(*direct) << '\n';
  EXPECT_LT(report.moved, 0.12 * largest(*before));
  EXPECT_LT(difference(*solver, *direct), 0.05 * kLoad);
  EXPECT_NEAR(largest(*solver), largest(*direct), 0.08 * largest(*direct));
}

INSTANTIATE_TEST_SUITE_P(Meshes, OnAnotherMesh,
                         ::testing::Values(std::tuple{1, "Q8R"}, std::tuple{3, "Q8R"}, std::tuple{4, "Q8R"},
                                           std::tuple{2, "T6"}, std::tuple{4, "Q4"}, std::tuple{8, "Q8R"}));

// Linear stresses and displacements come out as they are, on any mesh, so nothing moves.
TEST(start_from, ground_at_rest_that_is_stretched_stays_as_it_is) {
  for (const std::string element : {"Q8R", "Q8", "T6", "Q4"}) {
    const auto problem_of = [](const std::string& type, int columns) {
      Problem<2> problem;
      problem.mesh = rectangle({{4.0, 3.0}, {columns, 5}}, type);
      problem.materials["all"] = std::make_shared<LocalMaterial<ElasticLaw<2>>>(
          ElasticLaw<2>(ElasticParameters<2>{20e6, 0.25, 8e6, 0.2}));
      problem.prescribed = {{"left", Dof::u1, kZero}, {"right", Dof::u1, kZero}, {"bottom", Dof::u2, kZero}};
      problem.body_loads = {gravity(kWeight)};
      problem.boundary_loads = {{.on = "top", .pressure = TimeTable({{0, 0}, {1, 50e3}})}};
      return problem;
    };
    Problem<2> first = problem_of("Q8R", 3);
    first.initial_stresses = {geostatic_stress({3.0, kWeight, 0.5, 0.0})};
    Solver<2> before(std::move(first), {});
    ASSERT_TRUE(before.equilibrate().converged);
    ASSERT_TRUE(before.advance(1.0).converged);
    MemoryArchive end;
    before.save(end);
    Problem<2> second = problem_of(element, 7);
    second.boundary_loads.front().pressure = TimeTable::constant(50e3);
    Solver<2> solver(std::move(second), {});
    const StartReport report = solver.start_from(end, {"all"});
    ASSERT_TRUE(report.step.converged) << report.step.message;
    EXPECT_LT(report.imbalance, 1e-9) << element;
    EXPECT_LT(report.moved, 1e-9) << element;
    const double oedometric = 20e6 * (1 - 0.25) / ((1 + 0.25) * (1 - 2 * 0.25));
    const int top = solver.problem().mesh.nodes_on("top").front();
    EXPECT_NEAR(solver.state().displacement(entry_of<2>(top, Dof::u2)), -50e3 / oedometric * 3.0, 1e-9);
  }
}

TEST(start_from, a_cube_goes_over_to_another_element) {
  const auto problem_of = [](const std::string& type, int count) {
    Problem<3> problem;
    problem.mesh = box({{1.0, 1.0, 1.0}, {count, 2, 1}}, type);
    problem.materials["all"] = std::make_shared<LocalMaterial<ElasticLaw<3>>>(
        ElasticLaw<3>(ElasticParameters<3>{20e6, 0.25, 8e6, 0.2}));
    problem.prescribed = {{"left", Dof::u1, kZero}, {"front", Dof::u2, kZero}, {"bottom", Dof::u3, kZero}};
    problem.boundary_loads = {{.on = "top", .pressure = TimeTable({{0, 0}, {1, 50e3}})}};
    return problem;
  };
  Solver<3> before(problem_of("H20R", 1), {});
  ASSERT_TRUE(before.equilibrate().converged);
  ASSERT_TRUE(before.advance(1.0).converged);
  MemoryArchive end;
  before.save(end);
  for (const std::string element : {"H20R", "H8"}) {
    Problem<3> problem = problem_of(element, 2);
    problem.boundary_loads.front().pressure = TimeTable::constant(50e3);
    Solver<3> solver(std::move(problem), {});
    const StartReport report = solver.start_from(end, {"all"});
    ASSERT_TRUE(report.step.converged) << report.step.message;
    EXPECT_LT(report.moved, 1e-9) << element;
    const int top = solver.problem().mesh.nodes_on("top").front();
    EXPECT_NEAR(solver.state().displacement(entry_of<3>(top, Dof::u3)), -50e3 / 20e6, 1e-9);
  }
  MemoryArchive plane = end_of(*loaded_run(1));
  Solver<3> solver(problem_of("H8", 1), {});
  EXPECT_THROW((void)solver.start_from(plane, kRegions), RunError);
}

TEST(start_from, a_run_without_a_region_is_refused_by_name) {
  MemoryArchive end = end_of(*loaded_run(2));
  const auto solver = fresh(2);
  try {
    (void)solver->start_from(end, {"lower", "middle"});
    FAIL();
  } catch (const RunError& error) {
    EXPECT_STREQ(error.what(), "it has no region 'upper'; it has lower, middle");
  }
}

// The run goes on: supports count from where nodes are, and a checkpoint of it keeps that.
TEST(start_from, a_run_that_was_started_so_goes_on_and_is_restored) {
  MemoryArchive end = end_of(*loaded_run(2));
  const auto make = [] {
    Problem<2> problem = ground(4, kLoad);
    problem.boundary_loads.front().pressure = TimeTable({{0, kLoad}, {1, 1.25 * kLoad}});
    problem.prescribed.push_back({"top_right", Dof::u2, TimeTable({{0, 0}, {1, -1e-4}})});
    problem.initial_stresses.clear();
    return std::make_unique<Solver<2>>(std::move(problem), SolverOptions{});
  };
  const auto solver = make();
  ASSERT_TRUE(solver->start_from(end, kRegions).step.converged);
  const Eigen::VectorXd start = solver->state().displacement;
  MemoryArchive middle;
  solver->save(middle);
  ASSERT_TRUE(solver->advance(1.0).converged);
  for (const int node : solver->problem().mesh.nodes_on("top_right")) {
    const auto entry = entry_of<2>(node, Dof::u2);
    EXPECT_NEAR(solver->state().displacement(entry) - start(entry), -1e-4, 1e-15);
  }
  const auto again = make();
  again->restore(middle);
  ASSERT_TRUE(again->advance(1.0).converged);
  EXPECT_EQ(again->state().displacement, solver->state().displacement);
}

}  // namespace
