// SPDX-License-Identifier: GPL-2.0-or-later
// A solver that is saved, dropped and restored goes on as one that was left alone, to the bit.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <iostream>

#include "common/error.hpp"
#include "common/memory_archive.hpp"
#include "fem/material/elastoplastic.hpp"
#include "fem/material/local_material.hpp"
#include "fem/mesh/rectangle.hpp"
#include "fem/solver/solver.hpp"

using namespace polargrain;
using namespace polargrain::fem;

namespace {

using Step = std::function<StepReport(Solver<2>&)>;

/// A run that can be made anew as often as needed.
struct Scene {
  std::string name;
  std::function<Problem<2>()> problem;  ///< with materials of its own each time
  SolverOptions options;
  std::vector<Step> steps;
};

std::ostream& operator<<(std::ostream& out, const Scene& scene) {
  return out << scene.name;
}

Step to(double time) {
  return [time](Solver<2>& solver) { return solver.advance(time); };
}
Step along(double length) {
  return [length](Solver<2>& solver) { return solver.advance_arc_length(length); };
}
Step growing(const DisplacementMeasure& measure, double amount) {
  return [=](Solver<2>& solver) { return solver.advance_measure(measure, amount); };
}

constexpr double kShearModulus = 4000.0;
const double kYieldDisplacement = 100.0 / std::sqrt(3.0) * 100.0 / kShearModulus;

std::shared_ptr<Material<2>> softening(double strength) {
  ElastoplasticParameters<2> parameters;
  parameters.elastic = {2.5 * kShearModulus, 0.25, 2000.0, 3.0, Vector7::Zero()};
  const double start = 100.0 * strength;
  parameters.cone = {0.0, 0.0, PiecewiseLinear::ramp(start, 0.2 * start, 0.8 * start / 1000.0)};
  return std::make_shared<LocalMaterial<ElastoplasticLaw<2>>>(ElastoplasticLaw<2>(parameters));
}

/// A sheared column that softens in its middle, of two materials (docs/theory.md, E.4).
Problem<2> softening_layer() {
  constexpr int kElements = 20;
  Problem<2> problem;
  problem.mesh = rectangle({{5.0, 100.0}, {1, kElements}, {0.0, -50.0}});
  for (int e = 0; e < kElements; ++e) problem.mesh.regions[e / 2 == 5 ? "weak" : "rest"].push_back(e);
  problem.materials = {{"weak", softening(0.99)}, {"rest", softening(1.0)}};
  problem.prescribed = {{"all", Dof::u2, TimeTable::constant(0.0), {}},
                        {"bottom", Dof::u1, TimeTable::constant(0.0), {}},
                        {"top", Dof::u1, TimeTable::ramp(10 * kYieldDisplacement, 10.0), {}}};
  return problem;
}

/// Slip over the middle of the column.
DisplacementMeasure slip() {
  const Mesh<2> mesh = softening_layer().mesh;
  const auto node_at = [&](double height) {
    for (std::size_t node = 0; node < mesh.nodes.size(); ++node) {
      if (mesh.nodes[node].isApprox(Eigen::Vector2d(5.0, height))) return static_cast<int>(node);
    }
    throw RunError("no such node");
  };
  return {{{node_at(10.0), Dof::u1, 1.0}, {node_at(-10.0), Dof::u1, -1.0}}};
}

/// A block that is turned by half a radian while it is pressed, under a pressure that follows its sides.
Problem<2> turning_block() {
  Problem<2> problem;
  problem.mesh = rectangle({{1.0, 2.0}, {2, 4}});
  problem.deformation = Deformation::large;
  ElasticParameters<2> parameters{40e6, 0.3, 10e6, 0.1, Vector7::Zero()};
  problem.materials["all"] = std::make_shared<LocalMaterial<ElasticLaw<2>>>(ElasticLaw<2>(parameters));
  problem.prescribed = {
      {"bottom", Dof::u1, TimeTable::constant(0.0), {}},
      {"bottom", Dof::u2, TimeTable::constant(0.0), {}},
      {"top", Dof::u1, TimeTable::ramp(-1.0), [](const Eigen::Vector2d&) { return 0.9; }},
      {"top", Dof::u2, TimeTable::ramp(1.0), [](const Eigen::Vector2d& x) { return 0.4 * x(0) - 0.3; }}};
  problem.boundary_loads = {{.on = "left", .pressure = TimeTable::constant(100e3)}};
  return problem;
}

std::vector<Scene> scenes() {
  SolverOptions few_iterations;
  few_iterations.most_iterations = 4;
  SolverOptions loose;
  loose.force_tolerance = loose.moment_tolerance = 1e-6;
  const std::vector<Step> softening_steps{to(0.9),
                                          to(1.02),
                                          to(1.06),
                                          to(1.1),
                                          growing(slip(), 0.05 * kYieldDisplacement),
                                          growing(slip(), 0.05 * kYieldDisplacement),
                                          along(0.02 * kYieldDisplacement),
                                          along(0.02 * kYieldDisplacement)};
  return {{"softening", softening_layer, SolverOptions{}, softening_steps},
          {"softening_with_cut_steps", softening_layer, few_iterations, softening_steps},
          {"large_deformation", turning_block, loose, {to(0.2), to(0.4), to(0.6), to(0.8), to(1.0)}}};
}

/// The trace of a run: all that a history file would show.
struct Trace {
  std::vector<double> values;
  int cuts = 0;

  void add(const StepReport& report, const Solver<2>& solver) {
    EXPECT_TRUE(report.converged) << report.message;
    cuts += report.cuts;
    values.insert(values.end(),
                  {report.time, static_cast<double>(report.substeps), static_cast<double>(report.iterations),
                   report.force_residual, report.moment_residual, solver.reaction("top")(0),
                   solver.volume_strain(), solver.state().external_work, solver.state().internal_work});
    const Eigen::VectorXd& u = solver.state().displacement;
    values.insert(values.end(), u.begin(), u.end());
  }
};

class Interrupted : public ::testing::TestWithParam<Scene> {};

TEST_P(Interrupted, goes_on_with_the_same_bits) {
  const Scene& scene = GetParam();
  Trace whole;
  std::vector<MemoryArchive> saved(scene.steps.size());
  Solver<2> solver(scene.problem(), scene.options);
  ASSERT_TRUE(solver.equilibrate().converged);
  std::vector<std::size_t> marks;
  for (std::size_t s = 0; s < scene.steps.size(); ++s) {
    solver.save(saved[s]);
    marks.push_back(whole.values.size());
    whole.add(scene.steps[s](solver), solver);
    ASSERT_FALSE(HasFailure());
  }
  std::cout << "[figure] " << scene.name << ": " << whole.cuts << " cuts\n";
  if (scene.name == "softening_with_cut_steps") {
    EXPECT_GT(whole.cuts, 0);
  }

  for (std::size_t first = 0; first < scene.steps.size(); ++first) {
    Solver<2> other(scene.problem(), scene.options);
    other.restore(saved[first]);
    Trace rest;
    for (std::size_t s = first; s < scene.steps.size(); ++s) rest.add(scene.steps[s](other), other);
    const std::vector<double> expected(whole.values.begin() + static_cast<std::ptrdiff_t>(marks[first]),
                                       whole.values.end());
    EXPECT_EQ(rest.values, expected) << "restored before step " << first;
  }
}

TEST_P(Interrupted, shows_the_same_values_right_after_it_was_restored) {
  const Scene& scene = GetParam();
  Solver<2> solver(scene.problem(), scene.options);
  ASSERT_TRUE(solver.equilibrate().converged);
  ASSERT_TRUE(scene.steps[0](solver).converged);
  ASSERT_TRUE(scene.steps[1](solver).converged);
  MemoryArchive saved;
  solver.save(saved);
  Solver<2> other(scene.problem(), scene.options);
  other.restore(saved);
  EXPECT_EQ(solver.internal_forces(), other.internal_forces());
  EXPECT_EQ(solver.external_forces(), other.external_forces());
  MemoryArchive again;
  other.save(again);
  EXPECT_EQ(saved.all_doubles(), again.all_doubles());
}

INSTANTIATE_TEST_SUITE_P(Scenes, Interrupted, ::testing::ValuesIn(scenes()),
                         [](const auto& info) { return info.param.name; });

TEST(solver_archive, of_another_mesh_is_refused) {
  Solver<2> layer(softening_layer(), {});
  ASSERT_TRUE(layer.equilibrate().converged);
  MemoryArchive saved;
  layer.save(saved);
  Solver<2> block(turning_block(), {});
  EXPECT_THROW(block.restore(saved), RunError);
}

}  // namespace
