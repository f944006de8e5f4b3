// SPDX-License-Identifier: GPL-2.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "common/error.hpp"
#include "common/memory_archive.hpp"
#include "fem/material/elastic.hpp"
#include "fem/material/local_material.hpp"
#include "fem/mesh/rectangle.hpp"
#include "fem/solver/solver.hpp"
#include "fem/solver/substeps.hpp"
#include "fem/water/pore_water.hpp"

using namespace polargrain;
using namespace polargrain::fem;

namespace {

const TimeTable kZeroOfSolver = TimeTable::constant(0.0);

ElasticParameters<2> sand(double confining = 0.0) {
  ElasticParameters<2> parameters{40e6, 0.3, 10e6, 3e-3, Vector7::Zero()};
  for (const int i : {k11, k22, k33}) parameters.initial_stress(i) = -confining;
  return parameters;
}

/// Compression between smooth plates, with lateral pressure.
Problem<2> biaxial_of_solver(std::shared_ptr<Material<2>> material, double confining = 100e3) {
  Problem<2> problem;
  problem.mesh = rectangle({{0.04, 0.08}, {2, 4}});
  problem.materials["all"] = std::move(material);
  problem.prescribed = {{"bottom", Dof::u2, kZeroOfSolver, {}},
                        {"bottom_left", Dof::u1, kZeroOfSolver, {}},
                        {"top", Dof::u2, TimeTable::ramp(-0.0008), {}}};
  problem.boundary_loads = {{.on = "left", .pressure = TimeTable::constant(confining)},
                            {.on = "right", .pressure = TimeTable::constant(confining)}};
  return problem;
}

std::shared_ptr<Material<2>> elastic(double confining) {
  return std::make_shared<LocalMaterial<ElasticLaw<2>>>(ElasticLaw<2>(sand(confining)));
}

TEST(solver, starts_in_balance_without_an_iteration) {
  Solver<2> solver(biaxial_of_solver(elastic(100e3)), {});
  const StepReport report = solver.equilibrate();
  EXPECT_TRUE(report.converged);
  EXPECT_EQ(report.iterations, 0);
  // Both lateral pressures and the reactions of both plates to the initial stress.
  EXPECT_NEAR(solver.state().reference_force, 2 * 100e3 * 0.08 + 2 * 100e3 * 0.04, 1e-6);
}

TEST(solver, finds_the_balance_of_stresses_that_do_not_fit_the_loads) {
  Solver<2> solver(biaxial_of_solver(elastic(80e3)), {});
  const StepReport report = solver.equilibrate();
  EXPECT_TRUE(report.converged) << report.message;
  EXPECT_EQ(report.iterations, 1);
  for (const Response<2>& response : solver.state().responses) {
    EXPECT_NEAR(response.stress(k11), -100e3, 1e-4);                    // 1e-9 of the pressure
    EXPECT_NEAR(response.stress(k22), -80e3 - 0.3 / 0.7 * 20e3, 1e-4);  // uniaxial strain
  }
}

/// Elastic, and once, when it is asked to confirm its answers, twice as stiff from the start of the step.
class SecondThoughts : public Material<2> {
 public:
  int asked = 0;
  int committed_after = 0;  ///< times it had been asked at the last commit

  void allocate(std::size_t points) override { strain_.assign(points, Vector7::Zero()); }
  void evaluate(std::span<const Increment<2>> increments, std::span<Response<2>> responses) override {
    trial_.clear();
    for (std::size_t point = 0; point < strain_.size(); ++point) {
      trial_.push_back(strain_[point] + increments[point].strain());
      const Matrix7 stiffness = (asked > 0 ? 2.0 : 1.0) * elastic_stiffness(sand());
      responses[point] = {};
      responses[point].tangent = stiffness;
      responses[point].stress = stiffness * trial_.back();
      for (const int i : {k11, k22, k33}) responses[point].stress[i] -= 100e3;
    }
  }
  bool confirm() override { return ++asked > 1; }
  void commit() override {
    strain_ = trial_;
    committed_after = asked;
  }
  void revert() override {}

 private:
  std::vector<Vector7> strain_;
  std::vector<Vector7> trial_;
};

TEST(solver, a_step_is_committed_only_when_its_materials_confirm_it) {
  const auto material = std::make_shared<SecondThoughts>();
  Solver<2> solver(biaxial_of_solver(material), {});
  ASSERT_TRUE(solver.equilibrate().converged);
  EXPECT_EQ(material->asked, 0) << "the initial state is no step";
  const StepReport report = solver.advance(1.0);
  ASSERT_TRUE(report.converged) << report.message;
  EXPECT_EQ(material->committed_after, 2);
  // As below, with twice the stiffness: the first answers have left nothing behind.
  const double axial = -100e3 + 2 * 40e6 / (1 - 0.09) * -0.01;
  for (const Response<2>& response : solver.state().responses) {
    EXPECT_NEAR(response.stress(k22), axial, 1e-6 * std::abs(axial));
    EXPECT_NEAR(response.stress(k11), -100e3, 1e-6 * std::abs(axial));
  }
}

TEST(solver, a_linear_problem_takes_one_iteration_a_step_and_has_the_exact_answer) {
  Solver<2> solver(biaxial_of_solver(elastic(100e3)), {});
  ASSERT_TRUE(solver.equilibrate().converged);
  for (const double time : {0.25, 0.5, 1.0}) {
    const StepReport report = solver.advance(time);
    ASSERT_TRUE(report.converged) << report.message;
    EXPECT_EQ(report.iterations, 1);
    EXPECT_EQ(report.substeps, 1);
  }
  // Homogeneous plane strain at constant lateral stress: ds22 = E/(1-nu^2) deps22.
  const double strain = -0.01;
  const double axial = -100e3 + 40e6 / (1 - 0.09) * strain;
  EXPECT_NEAR(solver.reaction("top")(1) / (axial * 0.04), 1.0, 1e-12);
  EXPECT_NEAR(solver.reaction("bottom")(1) / (-axial * 0.04), 1.0, 1e-12);
  // A corner that stands in two places counts once, in sums and in means.
  const auto together = solver.reaction(std::vector<std::string>{"bottom", "bottom_left", "top"});
  EXPECT_NEAR(together(1) / (axial * 0.04), 0.0, 1e-12);
  const auto mean = solver.mean_displacement(std::vector<std::string>{"top", "top_left"});
  EXPECT_EQ(mean, solver.mean_displacement("top"));
  EXPECT_NEAR(solver.volume_strain() / (strain * (1 - 0.3 / 0.7)), 1.0, 1e-12);
}

TEST(solver, nodal_forces_balance_and_external_work_is_internal_work) {
  Problem<2> problem = biaxial_of_solver(elastic(100e3));
  problem.boundary_loads.push_back({.on = "top"});
  problem.boundary_loads.back().traction[0] = TimeTable::ramp(2e4);
  Solver<2> solver(std::move(problem), {});
  ASSERT_TRUE(solver.equilibrate().converged);
  ASSERT_TRUE(solver.advance(0.5).converged);
  ASSERT_TRUE(solver.advance(1.0).converged);
  const Eigen::VectorXd internal = solver.internal_forces();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t node = 0; node < solver.problem().mesh.nodes.size(); ++node) {
    const Eigen::Vector2d& x = solver.problem().mesh.nodes[node];
    const Eigen::Vector3d force = internal.segment<3>(3 * node);
    sum += Eigen::Vector3d(force(0), force(1), force(2) + x(0) * force(1) - x(1) * force(0));
  }
  const double scale = solver.state().reference_force;
  // Internal forces do no work in a rigid motion; rounding only.
  EXPECT_LT(sum.norm() / scale, 1e-14);
  const double work_error = solver.state().external_work / solver.state().internal_work - 1.0;
  std::cout << "[figure] external over internal work - 1: " << work_error << '\n';
  EXPECT_GT(std::abs(solver.state().internal_work), 1.0);
  EXPECT_LT(std::abs(work_error), 1e-10);  // of the order of the residual over the reference force
}

TEST(solver, same_problem_same_bits) {
  const auto run = [] {
    Solver<2> solver(biaxial_of_solver(elastic(80e3)), {});
    solver.equilibrate();
    solver.advance(1.0);
    return solver.state();
  };
  const SolverState<2> first = run();
  const SolverState<2> second = run();
  EXPECT_EQ(first.displacement, second.displacement);
  EXPECT_EQ(first.internal_work, second.internal_work);
}

/// Elastic, but fails or is unreliable when the strain of one step is too large, and stiffens with strain so
/// that Newton's method has something to do.
struct BrittleLaw {
  struct State {
    Vector7 strain = Vector7::Zero();
    int steps = 0;
  };
  Matrix7 stiffness;
  double longest_step = 1.0;
  Quality beyond = Quality::failed;
  double nonlinearity = 0.0;

  State initial_state() const { return {}; }
  static std::vector<double> packed(const State& state) {
    std::vector<double> values(state.strain.begin(), state.strain.end());
    values.push_back(state.steps);
    return values;
  }
  static State unpacked(std::span<const double> values) {
    return {Vector7(Eigen::Map<const Vector7>(values.data())), static_cast<int>(values[7])};
  }
  Response<2> integrate(const State& start, const Increment<2>& increment, State& trial) const {
    Response<2> response;
    trial.strain = start.strain + increment.strain();
    trial.steps = start.steps + 1;
    const double factor = 1.0 + nonlinearity * trial.strain.head<5>().squaredNorm();
    const Vector7 elastic = stiffness * trial.strain;
    response.stress = factor * elastic;
    response.tangent = factor * stiffness;
    response.tangent.leftCols<5>() += 2.0 * nonlinearity * elastic * trial.strain.head<5>().transpose();
    if (increment.strain().norm() > longest_step) {
      response.quality = beyond;
      response.message = "too long a step";
      response.step_factor = 0.4;
    }
    return response;
  }
};

std::shared_ptr<LocalMaterial<BrittleLaw>> brittle(double longest_step, Quality beyond,
                                                   double nonlinearity = 0.0) {
  return std::make_shared<LocalMaterial<BrittleLaw>>(
      BrittleLaw{elastic_stiffness(sand()), longest_step, beyond, nonlinearity});
}

class Brittle : public ::testing::TestWithParam<Quality> {};

TEST_P(Brittle, steps_are_cut_rolled_back_and_grow_back) {
  // The whole path strains by about 0.011 in norm: steps of a quarter of it pass.
  const auto material = brittle(0.003, GetParam());
  Solver<2> solver(biaxial_of_solver(material, 0.0), {});
  ASSERT_TRUE(solver.equilibrate().converged);
  const StepReport report = solver.advance(1.0);
  ASSERT_TRUE(report.converged) << report.message;
  EXPECT_GE(report.cuts, 2);
  EXPECT_GE(report.substeps, 4);
  for (const BrittleLaw::State& state : material->states()) {
    // Every point has lived through the committed steps (and the initial state), never through a lost one.
    EXPECT_EQ(state.steps, report.substeps + 1);
    EXPECT_NEAR(state.strain(k22), -0.01, 1e-12);
  }
  const double axial = 40e6 / (1 - 0.09) * -0.01;
  EXPECT_NEAR(solver.reaction("top")(1) / (axial * 0.04), 1.0, 1e-10);
}

INSTANTIATE_TEST_SUITE_P(Qualities, Brittle, ::testing::Values(Quality::failed, Quality::unreliable));

TEST(solver, a_step_that_cannot_be_made_is_never_committed_nor_called_converged) {
  const auto material = brittle(1e-6, Quality::failed);
  SolverOptions options;
  options.most_cuts = 3;
  Solver<2> solver(biaxial_of_solver(material, 0.0), options);
  ASSERT_TRUE(solver.equilibrate().converged);
  const StepReport report = solver.advance(1.0);
  EXPECT_FALSE(report.converged);
  EXPECT_EQ(report.cuts, 3);
  EXPECT_NE(report.message.find("too long a step"), std::string::npos) << report.message;
  EXPECT_EQ(solver.state().time, 0.0);
  EXPECT_EQ(solver.state().displacement.norm(), 0.0);
  for (const BrittleLaw::State& state : material->states()) EXPECT_EQ(state.steps, 1);
}

/// Counts what it is told, and keeps the last of it.
struct Listener : Observer {
  void struggles(const Trouble& trouble) override {
    ++calls;
    last = trouble;
  }
  int calls = 0;
  Trouble last;
};

TEST(solver, says_which_points_have_no_good_answer) {
  SolverOptions options;
  options.most_cuts = 3;
  Solver<2> solver(biaxial_of_solver(brittle(1e-6, Quality::unreliable), 0.0), options);
  Listener listener;
  solver.set_observer(&listener);
  ASSERT_TRUE(solver.equilibrate().converged);
  EXPECT_TRUE(solver.trouble().is_empty());
  ASSERT_FALSE(solver.advance(1.0).converged);
  EXPECT_EQ(listener.calls, 1);  // after the second cut, and not after every one
  for (const Trouble& trouble : {listener.last, solver.trouble()}) {
    EXPECT_EQ(trouble.not_good, solver.points());
    ASSERT_EQ(trouble.points.size(), 3u);
    EXPECT_EQ(trouble.points[0].message, "too long a step");
    EXPECT_NE(trouble.reason.find("too long a step"), std::string::npos) << trouble.reason;
  }
}

/// Elastic, but the stress of the last point changes with every evaluation: no balance there.
class RestlessMaterial : public Material<2> {
 public:
  void allocate(std::size_t points) override { law_.allocate(points); }
  void evaluate(std::span<const Increment<2>> increments, std::span<Response<2>> responses) override {
    law_.evaluate(increments, responses);
    ++times_;
    if (times_ > 1) responses.back().stress(k11) += times_ % 2 == 0 ? 5e4 : -5e4;
  }
  void commit() override { law_.commit(); }
  void revert() override { law_.revert(); }

 private:
  LocalMaterial<ElasticLaw<2>> law_{ElasticLaw<2>(sand())};
  int times_ = 0;
};

TEST(solver, says_where_it_is_out_of_balance) {
  SolverOptions options;
  options.most_cuts = 2;
  options.most_line_search_halvings = 0;  // would evaluate twice, and find the same stress again
  Solver<2> solver(biaxial_of_solver(std::make_shared<RestlessMaterial>(), 0.0), options);
  ASSERT_TRUE(solver.equilibrate().converged);
  const StepReport report = solver.advance(1.0);
  ASSERT_FALSE(report.converged);
  const Trouble& trouble = solver.trouble();
  EXPECT_EQ(trouble.not_good, 0u);
  ASSERT_EQ(trouble.nodes.size(), 4u);
  const std::vector<int>& nodes = solver.problem().mesh.elements.back().nodes;
  double share = 0.0;
  for (const Trouble::Node& node : trouble.nodes) {
    EXPECT_NE(std::ranges::find(nodes, node.number), nodes.end()) << node.number;
    share += node.share;
  }
  // Nothing but the element of that point is out of balance, and four of its eight nodes have most of it.
  EXPECT_GT(share, 0.5);
  EXPECT_LE(share, 1.0 + 1e-12);
  EXPECT_GT(trouble.least_force_residual, options.force_tolerance);
  EXPECT_GE(trouble.first_force_residual, trouble.least_force_residual);
}

TEST(solver, newton_converges_quadratically) {
  Problem<2> problem = biaxial_of_solver(brittle(1.0, Quality::failed, 2000.0), 0.0);
  // Rough plates make the field inhomogeneous.
  problem.prescribed.push_back({"top", Dof::u1, kZeroOfSolver, {}});
  problem.prescribed.push_back({"bottom", Dof::u1, kZeroOfSolver, {}});
  SolverOptions options;
  options.force_tolerance = options.moment_tolerance = 1e-12;
  Solver<2> solver(std::move(problem), options);
  ASSERT_TRUE(solver.equilibrate().converged);
  const StepReport report = solver.advance(1.0);
  ASSERT_TRUE(report.converged) << report.message;
  std::cout << "[figure] residuals";
  for (const double residual : report.force_residuals) std::cout << ' ' << residual;
  std::cout << '\n';
  const std::vector<double>& r = report.force_residuals;
  ASSERT_GE(r.size(), 3U);
  // While above rounding, each residual is below a constant times the square of the one before.
  for (std::size_t i = 1; i < r.size(); ++i) EXPECT_LT(r[i], std::max(5.0 * r[i - 1] * r[i - 1], 1e-12));
}

TEST(solver, gives_up_when_the_iteration_stagnates) {
  /// A tangent of less than half the stiffness: every correction overshoots by more than itself.
  struct WrongTangentLaw {
    struct State {};
    Matrix7 stiffness;
    State initial_state() const { return {}; }
    Response<2> integrate(const State&, const Increment<2>& increment, State&) const {
      Response<2> response;
      response.stress = stiffness * increment.strain();
      response.tangent = 0.45 * stiffness;
      return response;
    }
  };
  SolverOptions options;
  options.most_cuts = 0;
  options.most_line_search_halvings = 0;  // a line search would get there all the same
  Solver<2> solver(biaxial_of_solver(std::make_shared<LocalMaterial<WrongTangentLaw>>(
                       WrongTangentLaw{elastic_stiffness(sand())})),
                   options);
  const StepReport report = solver.equilibrate();
  EXPECT_FALSE(report.converged);
  EXPECT_NE(report.message.find("stagnates"), std::string::npos) << report.message;
  EXPECT_LT(report.iterations, 12);
}

/// Elastic, but the stress falls by a fixed amount under any strain, however small, as that of a few grains
/// whose contacts rearrange.
struct JumpingLaw {
  struct State {};
  Matrix7 stiffness;
  State initial_state() const { return {}; }
  Response<2> integrate(const State&, const Increment<2>& increment, State&) const {
    Response<2> response;
    response.stress = stiffness * increment.strain();
    response.tangent = stiffness;
    // On which side of the jump it is depends on the strain: no strain makes up for it.
    if (!increment.strain().isZero(0.0)) response.stress(k11) += increment.strain()(k11) > 0.0 ? 1e7 : -1e7;
    return response;
  }
};

TEST(solver, says_that_no_cut_will_help_where_stresses_jump) {
  SolverOptions options;
  options.most_cuts = 4;
  Solver<2> solver(
      biaxial_of_solver(std::make_shared<LocalMaterial<JumpingLaw>>(JumpingLaw{elastic_stiffness(sand())}),
                        0.0),
      options);
  ASSERT_TRUE(solver.equilibrate().converged);
  const StepReport report = solver.advance(1.0);
  EXPECT_FALSE(report.converged);
  EXPECT_NE(report.message.find("the stresses jump here"), std::string::npos) << report.message;
  EXPECT_EQ(solver.state().time, 0.0);
}

/// As JumpingLaw at first; once committed on either side of its jump it stays there and is elastic again.
struct RearrangingLaw {
  struct State {
    Vector7 strain = Vector7::Zero();
    double side = 0.0;
  };
  Matrix7 stiffness;
  State initial_state() const { return {}; }
  Response<2> integrate(const State& start, const Increment<2>& increment, State& trial) const {
    trial = start;
    trial.strain += increment.strain();
    if (start.side == 0.0 && !increment.strain().isZero(0.0))
      trial.side = increment.strain()(k11) > 0.0 ? 1.0 : -1.0;
    Response<2> response;
    response.stress = stiffness * trial.strain;
    response.stress(k11) += 1e6 * trial.side;
    response.tangent = stiffness;
    return response;
  }
};

TEST(solver, passes_a_jump_where_it_may_and_ends_the_step_in_balance) {
  for (const int most_jumps : {0, 1}) {
    SolverOptions options;
    options.most_cuts = 4;
    options.most_jumps = most_jumps;
    Solver<2> solver(
        biaxial_of_solver(
            std::make_shared<LocalMaterial<RearrangingLaw>>(RearrangingLaw{elastic_stiffness(sand())}), 0.0),
        options);
    ASSERT_TRUE(solver.equilibrate().converged);
    const StepReport report = solver.advance(1.0);
    EXPECT_EQ(report.converged, most_jumps == 1) << report.message;
    EXPECT_EQ(report.jumps, most_jumps) << report.message;
    if (most_jumps == 0) continue;
    // The height of the jump on both free sides, less what the short substep balances of it.
    EXPECT_NEAR(report.jump_residual, 2.0 * 1e6 * 0.08 / solver.state().reference_force, 0.2);
    EXPECT_LE(report.force_residual, options.force_tolerance);
    // Free sides carry nothing in the end, whatever lies behind: the jump has become a strain.
    EXPECT_LT(std::abs(solver.state().responses[0].stress(k11)),
              1e-2 * std::abs(solver.state().responses[0].stress(k22)));
    // A step after it knows of no jump any more.
    const StepReport after = solver.advance(1.5);
    EXPECT_TRUE(after.converged) << after.message;
    EXPECT_EQ(after.jumps, 0);
    EXPECT_EQ(after.cuts, 0);
  }
}

TEST(solver, leaves_water_time_to_flow_behind_a_jump) {
  Problem<2> problem = biaxial_of_solver(
      std::make_shared<LocalMaterial<RearrangingLaw>>(RearrangingLaw{elastic_stiffness(sand())}), 0.0);
  PoreWaterOptions water;
  water.unit_weight = 1e4;
  add_pore_water<2>(problem, {{"all", {Permeability::constant(1e-2), 0.7, 2.2e9}}}, water);
  problem.prescribed_fields = {{kPorePressure, "right", kZeroOfSolver}};
  SolverOptions options;
  options.most_cuts = 4;
  options.most_jumps = 10;
  options.jump_residual = 10.0;  // no cut comes before it
  Solver<2> solver(std::move(problem), options);
  ASSERT_TRUE(solver.equilibrate().converged);
  const StepReport report = solver.advance(1.0);
  EXPECT_TRUE(report.converged) << report.message;
  EXPECT_GE(report.jumps, 1);
  // Jumps take no time, so their water is shut in: some 1e5 Pa. Milliseconds drain the specimen, as the step loads it.
  for (const int node : solver.problem().fields[0].nodes)
    EXPECT_LT(std::abs(solver.state().displacement(solver.problem().places().entry(0, node))), 100.0);
}

TEST(solver, says_no_jump_where_a_step_fails_for_its_length) {
  const auto material = brittle(1e-6, Quality::unreliable, 2000.0);
  SolverOptions options;
  options.most_cuts = 6;
  Solver<2> solver(biaxial_of_solver(material, 0.0), options);
  ASSERT_TRUE(solver.equilibrate().converged);
  const StepReport report = solver.advance(1.0);
  EXPECT_FALSE(report.converged);
  EXPECT_EQ(report.message.find("jump"), std::string::npos) << report.message;
}

TEST(solver, says_which_points_have_come_apart) {
  /// Breaks at the first strain and bears nothing from then on.
  struct BreakingLaw {
    using State = double;  // 1: broken
    Matrix7 stiffness;
    double initial_state() const { return 0.0; }
    Response<2> integrate(const double& start, const Increment<2>& increment, double& trial) const {
      trial = start == 1.0 || !increment.strain().isZero(0.0) ? 1.0 : 0.0;
      Response<2> response;
      if (trial == 0.0) response.tangent = stiffness;
      return response;
    }
  };
  Solver<2> solver(
      biaxial_of_solver(std::make_shared<LocalMaterial<BreakingLaw>>(BreakingLaw{elastic_stiffness(sand())}),
                        0.0),
      {.reference_force = 1.0});
  ASSERT_TRUE(solver.equilibrate().converged);
  ASSERT_TRUE(solver.advance(0.5).converged);  // nothing resists, nothing is out of balance
  const StepReport report = solver.advance(1.0);
  EXPECT_FALSE(report.converged);
  EXPECT_NE(report.message.find("32 of 32 points have come apart"), std::string::npos) << report.message;
}

TEST(solver, refuses_a_problem_with_faults) {
  Problem<2> problem = biaxial_of_solver(elastic(0.0));
  problem.prescribed.clear();
  EXPECT_THROW(Solver<2>(std::move(problem), {}), RunError);
}

TEST(solver, goes_on_from_a_saved_state_with_the_same_bits) {
  const auto material = brittle(1.0, Quality::failed, 2000.0);
  Solver<2> whole(biaxial_of_solver(material, 0.0), {});
  whole.equilibrate();
  whole.advance(0.5);
  MemoryArchive saved;
  whole.save(saved);
  whole.advance(1.0);

  const auto other_material = brittle(1.0, Quality::failed, 2000.0);
  Solver<2> other(biaxial_of_solver(other_material, 0.0), {});
  other.restore(saved);
  other.advance(1.0);
  EXPECT_EQ(whole.state().displacement, other.state().displacement);
  EXPECT_EQ(whole.state().external_work, other.state().external_work);
}

TEST(substeps, go_the_whole_way_and_grow_behind_cuts) {
  Substeps whole(1.5);
  EXPECT_EQ(whole.end(), 1.0);
  whole.went();
  EXPECT_TRUE(whole.arrived());
  EXPECT_EQ(whole.next(), 0.0);  // nothing was cut

  Substeps way(1.5);
  way.failed(0.5);
  way.failed(0.01);  // no cut is by more than ten
  EXPECT_EQ(way.cuts_in_a_row(), 2);
  EXPECT_DOUBLE_EQ(way.share(), 0.05);
  double reached = 0.0;
  int parts = 0;
  for (double share = 0.05; !way.arrived(); share *= 1.5, ++parts) {
    if (way.end() < 1.0) {
      EXPECT_NEAR(way.share(), share, 1e-15);
    }
    reached = way.end();
    way.went();
    EXPECT_EQ(way.cuts_in_a_row(), 0);
  }
  EXPECT_EQ(reached, 1.0);  // exactly
  EXPECT_EQ(parts, 6);      // 0.05, 0.075, 0.1125, 0.16875, 0.253125 and the rest
  way.begin_again();
  EXPECT_EQ(way.done(), 0.0);
  EXPECT_FALSE(way.arrived());
}

}  // namespace
