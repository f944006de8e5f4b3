// SPDX-License-Identifier: GPL-2.0-or-later
// Stresses that carry noise, tangents that are not true, corrections that are absurd: what the solver makes
// of them and how it says so. Pseudo-noise is a function of the increment, with a fixed seed.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <random>

#include "fem/material/elastic.hpp"
#include "fem/material/local_material.hpp"
#include "fem/mesh/rectangle.hpp"
#include "fem/solver/anderson.hpp"
#include "fem/solver/residual_floor.hpp"
#include "fem/solver/solver.hpp"

using namespace polargrain;
using namespace polargrain::fem;

namespace {

const TimeTable kZeroOfNoise = TimeTable::constant(0.0);
const ElasticParameters<2> kSand{40e6, 0.3, 10e6, 3e-3, Vector7::Zero()};

/// Seed of a sequence of random numbers: the bits of an increment.
std::uint64_t bits_of(const Increment<2>& increment) {
  std::uint64_t hash = 1469598103934665603U;
  const auto add = [&](double value) {
    hash = (hash ^ std::bit_cast<std::uint64_t>(value)) * 1099511628211U;
  };
  for (const double value : increment.displacement_gradient.reshaped()) add(value);
  add(increment.micro_rotation);
  return hash;
}

/// Elastic, stiffening with strain; its stress carries noise and its tangent is wrong by a factor.
struct GrainyLaw {
  struct State {
    Vector7 strain = Vector7::Zero();
  };
  double noise = 0.0;           ///< Pa
  double tangent_factor = 1.0;  ///< reported over true
  double nonlinearity = 0.0;
  /// Beyond this compression (of e22) the tangent reported is a millionth of the true one.
  double soft_beyond = HUGE_VAL;
  double fails_beyond = HUGE_VAL;
  double* largest_asked = nullptr;

  State initial_state() const { return {}; }
  Response<2> integrate(const State& start, const Increment<2>& increment, State& trial) const {
    const Matrix7 stiffness = elastic_stiffness(kSand);
    Response<2> response;
    const Vector7 strain = increment.strain();
    trial.strain = start.strain + strain;
    const double factor = 1.0 + nonlinearity * trial.strain.head<5>().squaredNorm();
    const Vector7 elastic = stiffness * trial.strain;
    response.stress = factor * elastic;
    response.tangent = factor * stiffness;
    response.tangent.leftCols<5>() += 2.0 * nonlinearity * elastic * trial.strain.head<5>().transpose();
    response.tangent *= trial.strain(k22) < -soft_beyond ? 1e-6 : tangent_factor;
    if (noise > 0.0 && !strain.isZero(0.0)) {
      std::mt19937_64 generator(bits_of(increment));
      std::normal_distribution<double> normal(0.0, noise);
      response.stress(k11) += normal(generator);
      response.stress(k22) += normal(generator);
      const double shear = normal(generator);
      response.stress(k12) += shear;
      response.stress(k21) += shear;
      response.noise.symmetric = noise;
    }
    const Eigen::Matrix2d& h = increment.displacement_gradient;
    if (largest_asked != nullptr) {
      *largest_asked = std::max(*largest_asked, (0.5 * (h + h.transpose())).norm());
    }
    if (strain.norm() > fails_beyond) {
      response.quality = Quality::failed;
      response.message = "too long a step";
    }
    return response;
  }
};

std::shared_ptr<Material<2>> grainy(const GrainyLaw& law) {
  return std::make_shared<LocalMaterial<GrainyLaw>>(law);
}

/// Compression by 1 % of strain between rough plates.
Problem<2> grainy_block(const GrainyLaw& law) {
  Problem<2> problem;
  problem.mesh = rectangle({{0.04, 0.08}, {3, 6}});
  problem.materials["all"] = grainy(law);
  problem.prescribed = {{"bottom", Dof::u1, kZeroOfNoise, {}},
                        {"bottom", Dof::u2, kZeroOfNoise, {}},
                        {"top", Dof::u1, kZeroOfNoise, {}},
                        {"top", Dof::u2, TimeTable::ramp(-0.0008), {}}};
  return problem;
}

StepReport compress(const GrainyLaw& law, const SolverOptions& options) {
  Solver<2> solver(grainy_block(law), options);
  EXPECT_TRUE(solver.equilibrate().converged);
  return solver.advance(1.0);
}

TEST(noise, what_it_leaves_of_the_residual_is_foreseen) {
  const Problem<2> problem = grainy_block({});
  for (const Continuum continuum : {Continuum::cosserat, Continuum::cauchy}) {
    const Discretisation<2> discretisation(problem.mesh, continuum);
    std::vector<Response<2>> responses(discretisation.points());
    const StressNoise noise{100.0, 40.0, 0.3};
    for (Response<2>& response : responses) response.noise = noise;
    const Eigen::VectorXd expected = forces_of_noise<2>(discretisation, continuum, responses);
    std::mt19937_64 generator(7);
    std::normal_distribution<double> normal;
    Eigen::VectorXd mean = Eigen::VectorXd::Zero(expected.size());
    constexpr int kSamples = 4000;
    for (int sample = 0; sample < kSamples; ++sample) {
      for (Response<2>& response : responses) {
        const double shear = noise.symmetric * normal(generator);
        const double skew = noise.skew * normal(generator);
        response.stress << noise.symmetric * normal(generator), noise.symmetric * normal(generator), 0.0,
            shear - 0.5 * skew, shear + 0.5 * skew, noise.couple * normal(generator),
            noise.couple * normal(generator);
      }
      mean += discretisation.internal_forces(responses).cwiseAbs() / kSamples;
    }
    for (Eigen::Index entry = 0; entry < mean.size(); ++entry) {
      // The mean of |x| of 4000 samples scatters by 1.2 %: five times that.
      EXPECT_NEAR(mean(entry), expected(entry), 0.06 * expected(entry)) << entry;
    }
  }
}

TEST(noise, a_step_within_the_noise_ends_there_and_says_so) {
  const GrainyLaw law{.noise = 20.0};  // of stresses of 400 kPa
  SolverOptions options;
  options.force_tolerance = options.moment_tolerance = 1e-8;
  options.most_cuts = 1;
  const StepReport without = compress(law, options);
  EXPECT_FALSE(without.converged);
  EXPECT_NE(without.message.find("the noise of the stresses alone leaves about"), std::string::npos)
      << without.message;

  options.noise_factor = 2.0;
  const StepReport report = compress(law, options);
  ASSERT_TRUE(report.converged) << report.message;
  EXPECT_EQ(report.cuts, 0);
  EXPECT_EQ(report.within_noise, 1);
  EXPECT_GT(report.force_residual, options.force_tolerance);
  EXPECT_LE(report.force_residual, 2.0 * report.force_noise);
  // One correction of a linear material, and perhaps another sample of the noise.
  EXPECT_LE(report.iterations, 3);
  std::cout << "[figure] noise of 5e-5 of the stress, tolerance 1e-8: without the noise's part stopped after "
            << without.iterations << " iterations, with it " << report.iterations << " iterations, residual "
            << report.force_residual << ", noise " << report.force_noise << '\n';
}

TEST(noise, a_step_within_its_tolerance_is_not_flagged) {
  SolverOptions options;
  options.force_tolerance = options.moment_tolerance = 1e-2;
  options.noise_factor = 2.0;
  const StepReport report = compress({.noise = 20.0}, options);
  ASSERT_TRUE(report.converged) << report.message;
  EXPECT_EQ(report.within_noise, 0);
  EXPECT_GT(report.force_noise, 0.0);
}

TEST(rounding, ends_an_iteration_that_nothing_else_can_end) {
  // Tolerances far below what double precision can balance.
  SolverOptions options;
  options.reference_force = 1e-12;
  const StepReport report = compress({.nonlinearity = 2000.0}, options);
  ASSERT_TRUE(report.converged) << report.message;
  EXPECT_EQ(report.within_rounding, 1);
  EXPECT_GT(report.force_residual, options.force_tolerance);
  EXPECT_LT(report.force_residual * options.reference_force, 1e-12 * 40e6 * 0.01 * 0.04);
}

TEST(rounding, does_not_hide_a_wrong_balance) {
  // A tangent of three times the stiffness converges slowly; cut off early it is far from rounding.
  SolverOptions options;
  options.most_iterations = 8;
  options.most_cuts = 0;
  EXPECT_FALSE(compress({.tangent_factor = 3.0, .nonlinearity = 2000.0}, options).converged);
}

/// Its skew stress is a constant that nothing balances; small strains hardly resist it, and throw the rotations far away.
struct UnbalancedLaw {
  struct State {};
  State initial_state() const { return {}; }
  Response<2> integrate(const State&, const Increment<2>& increment, State&) const {
    const Vector7 strain = increment.strain();
    const double skew_strain = std::abs(strain(k21) - strain(k12));
    ElasticParameters<2> resisting{40e6, 0.3, 10e6, 0.0, Vector7::Zero()};
    if (skew_strain > 0.0 && skew_strain < 1.0) resisting.cosserat_shear_modulus *= 1e-15;
    ElasticParameters<2> symmetric = resisting;
    symmetric.cosserat_shear_modulus = 0.0;
    Response<2> response;
    response.stress = elastic_stiffness(symmetric) * strain;
    if (skew_strain > 0.0) {
      response.stress(k21) += 1e3;
      response.stress(k12) -= 1e3;
    }
    response.tangent = elastic_stiffness(resisting);
    return response;
  }
};

TEST(rounding, does_not_excuse_rotations_that_have_gone_astray) {
  Problem<2> problem = grainy_block({});
  problem.materials["all"] = std::make_shared<LocalMaterial<UnbalancedLaw>>(UnbalancedLaw{});
  SolverOptions options;
  options.most_cuts = 0;
  Solver<2> solver(std::move(problem), options);
  ASSERT_TRUE(solver.equilibrate().converged);
  const StepReport report = solver.advance(1.0);
  // At rotations of 1e17 rad rounding is as large as any stress.
  EXPECT_FALSE(report.converged) << report.within_rounding;
  EXPECT_EQ(report.within_rounding, 0);
  EXPECT_NE(report.message.find("stagnates"), std::string::npos) << report.message;
}

struct Untrue {
  double factor;
  double noise;
};

class Acceleration : public ::testing::TestWithParam<Untrue> {};

TEST_P(Acceleration, needs_fewer_iterations_where_the_tangent_is_not_true) {
  const auto [factor, noise] = GetParam();
  const GrainyLaw law{.noise = noise, .tangent_factor = factor, .nonlinearity = 2000.0};
  SolverOptions options;
  options.noise_factor = 2.0;
  options.moment_tolerance = 1e-3;  // the noise is in the forces
  options.most_cuts = 0;
  options.most_line_search_halvings = 0;
  options.most_iterations = 100;
  const StepReport plain = compress(law, options);
  options.acceleration_depth = 5;
  const StepReport accelerated = compress(law, options);
  std::cout << "[figure] tangent " << factor << " times the true one, noise " << noise
            << " Pa: " << plain.iterations << (plain.converged ? "" : " (no balance)")
            << " iterations, with acceleration " << accelerated.iterations << '\n';
  ASSERT_TRUE(accelerated.converged) << accelerated.message;
  EXPECT_LE(accelerated.force_residual,
            std::max(options.force_tolerance, options.noise_factor * accelerated.force_noise));
  // Acceleration that does not halve the cost is not worth having; measured are ratios of 2.5 and more.
  if (plain.converged) {
    EXPECT_LT(2 * accelerated.iterations, plain.iterations);
  }
}

INSTANTIATE_TEST_SUITE_P(Tangents, Acceleration,
                         ::testing::Values(Untrue{3.0, 0.0}, Untrue{3.0, 20.0}, Untrue{6.0, 20.0},
                                           Untrue{0.45, 0.0}));

TEST(acceleration, leaves_a_true_tangent_alone) {
  SolverOptions options;
  options.force_tolerance = options.moment_tolerance = 1e-12;
  const StepReport plain = compress({.nonlinearity = 2000.0}, options);
  options.acceleration_depth = 5;
  const StepReport accelerated = compress({.nonlinearity = 2000.0}, options);
  ASSERT_TRUE(plain.converged && accelerated.converged);
  EXPECT_EQ(accelerated.iterations, plain.iterations);
}

/// One node, a tangent of one, places on a line or off it.
TEST(acceleration, takes_no_jump_for_stiffness) {
  const auto at = [](double x, double y) { return Correction{Eigen::Vector3d(x, y, 0.0), 0.0}; };
  const auto solve = [](const Eigen::VectorXd& forces) { return Correction{forces, 0.0}; };

  Anderson overshot(5, 1.0);
  overshot.remember(at(0.0, 0.0), Eigen::Vector3d(1.0, 0.0, 0.0), Eigen::Vector3d::Zero());
  overshot.remember(at(1.0, 0.0), Eigen::Vector3d(-1.2, 0.0, 0.0), Eigen::Vector3d::Zero());
  Correction back = at(-1.2, 0.0);
  overshot.accelerate(back, solve);
  // 2.2 of force went with a way of one.
  EXPECT_NEAR(back.displacement(0), -1.2 / 2.2, 1e-14);

  Anderson jumped(5, 1.0);
  jumped.remember(at(0.0, 0.0), Eigen::Vector3d(1.0, 0.0, 0.0), Eigen::Vector3d::Zero());
  jumped.remember(at(1.0, 0.0), Eigen::Vector3d(0.5, 2.0, 0.0), Eigen::Vector3d::Zero());
  Correction on = at(0.5, 2.0);
  jumped.accelerate(on, solve);
  EXPECT_EQ(on.displacement(0), 0.5);
  EXPECT_EQ(on.displacement(1), 2.0);
  // The places before it stay forgotten: along (0.5, 2) half of the force was left, so as much again is to go.
  jumped.remember(at(1.5, 2.0), Eigen::Vector3d(0.25, 1.0, 0.0), Eigen::Vector3d::Zero());
  Correction next = at(0.25, 1.0);
  jumped.accelerate(next, solve);
  EXPECT_NEAR(next.displacement(0), 0.5, 1e-14);
  EXPECT_NEAR(next.displacement(1), 2.0, 1e-14);
}

TEST(equilibrate, lets_an_imbalance_go_in_shares_when_a_material_cannot_follow_at_once) {
  Problem<2> problem = grainy_block({.fails_beyond = 0.003});
  problem.prescribed = {{"bottom", Dof::u2, kZeroOfNoise, {}},
                        {"bottom_left", Dof::u1, kZeroOfNoise, {}},
                        {"top", Dof::u2, TimeTable::constant(-0.0008), {}}};
  problem.boundary_loads = {{.on = "left", .pressure = TimeTable::constant(100e3)},
                            {.on = "right", .pressure = TimeTable::constant(100e3)}};
  Solver<2> solver(std::move(problem), {});
  const StepReport report = solver.equilibrate();
  ASSERT_TRUE(report.converged) << report.message;
  EXPECT_GE(report.cuts, 2);
  EXPECT_GE(report.substeps, 4);
  // Plane strain under lateral pressure: s22 = E/(1-nu^2) e22 - nu/(1-nu) p.
  const double axial = 40e6 / (1 - 0.09) * -0.01 - 0.3 / 0.7 * 100e3;
  EXPECT_NEAR(solver.reaction("top")(1) / (axial * 0.04), 1.0, 1e-8);  // the tolerance
  // Loads and withheld forces together do the work of the stresses: a linear material makes that exact.
  EXPECT_NEAR(solver.state().external_work / solver.state().internal_work, 1.0, 1e-8);
  // Steps to come are not cut because the first one was.
  EXPECT_EQ(solver.state().next_step, 0.0);
}

TEST(equilibrate, gives_up_with_a_reason) {
  Problem<2> problem = grainy_block({.fails_beyond = 1e-7});
  problem.boundary_loads = {{.on = "left", .pressure = TimeTable::constant(100e3)}};
  Solver<2> solver(std::move(problem), {});
  const StepReport report = solver.equilibrate();
  EXPECT_FALSE(report.converged);
  EXPECT_NE(report.message.find("too long a step"), std::string::npos) << report.message;
}

/// A field beside the displacements that stays zero.
class IdleField final : public StatelessContribution<2> {
 public:
  explicit IdleField(Problem<2>& problem) {
    NodalField field{"idle", "K", {}};
    for (std::size_t node = 0; node < problem.mesh.nodes.size(); ++node)
      field.nodes.push_back(static_cast<int>(node));
    problem.fields = {field};
    for (const int node : field.nodes) entries_.push_back({problem.places().entry(0, node)});
  }
  [[nodiscard]] std::string name() const override { return "an idle field"; }
  [[nodiscard]] std::size_t elements() const override { return entries_.size(); }
  [[nodiscard]] const std::vector<int>& entries(std::size_t element) const override {
    return entries_[element];
  }
  [[nodiscard]] std::string evaluate(const NodalStep& step, NodalForces& forces) override {
    for (const std::vector<int>& entry : entries_) {
      forces.internal(entry) += step.end(entry);
      forces.parts(entry) += Eigen::VectorXd::Ones(1);
    }
    return {};
  }
  [[nodiscard]] Eigen::MatrixXd tangent(std::size_t) const override { return Eigen::MatrixXd::Ones(1, 1); }

 private:
  std::vector<std::vector<int>> entries_;
};

class AbsurdCorrections : public ::testing::TestWithParam<bool> {};

// The parameter: with a field beside the displacements.
TEST_P(AbsurdCorrections, AreNotAskedOfTheMaterial) {
  double asked = 0.0;
  enum class Control { time, measure };
  const auto column = [&](SolverOptions options, Control control) {
    Problem<2> problem = grainy_block({.largest_asked = &asked});
    problem.mesh = rectangle({{0.04, 0.08}, {1, 20}});
    problem.mesh.regions["band"] = {10};
    for (int e = 0; e < 20; ++e) {
      if (e != 10) problem.mesh.regions["rest"].push_back(e);
    }
    problem.materials = {{"rest", grainy({.largest_asked = &asked})},
                         {"band", grainy({.soft_beyond = 0.002, .largest_asked = &asked})}};
    problem.prescribed = {{"bottom", Dof::u2, kZeroOfNoise, {}},
                          {"bottom_left", Dof::u1, kZeroOfNoise, {}},
                          {"top", Dof::u2, TimeTable::ramp(-0.0008), {}}};
    if (GetParam()) problem.contributions.push_back(std::make_shared<IdleField>(problem));
    Solver<2> solver(std::move(problem), options);
    EXPECT_TRUE(solver.equilibrate().converged);
    EXPECT_TRUE(solver.advance(0.25).converged);
    asked = 0.0;
    if (control == Control::time) return solver.advance(0.35);
    DisplacementMeasure measure;
    for (const int node : solver.problem().mesh.nodes_on("top"))
      measure.terms.push_back({node, Dof::u2, 1.0 / 3.0});
    const StepReport report = solver.advance_measure(measure, -0.1 * 0.0008);
    EXPECT_NEAR(report.time, 0.35, 1e-9);
    EXPECT_NEAR(solver.mean_displacement("top")(1), -0.35 * 0.0008, 1e-12);
    return report;
  };
  for (const Control control : {Control::time, Control::measure}) {
    SolverOptions options;
    const StepReport free = column(options, control);  // the predictor puts all of the way into the band
    EXPECT_GT(asked, 0.018);
    EXPECT_EQ(free.limited, 0);
    options.largest_strain = 0.01;
    const StepReport limited = column(options, control);
    ASSERT_TRUE(limited.converged) << limited.message;
    EXPECT_LE(asked, 0.01);
    EXPECT_GT(limited.limited, 0);
    EXPECT_EQ(limited.cuts, 0);  // the step before, drawn on, is the answer here
    EXPECT_EQ(limited.iterations, 1);
  }
}
INSTANTIATE_TEST_SUITE_P(WithAndWithoutAField, AbsurdCorrections, ::testing::Bool());

TEST(absurd_corrections, cut_the_step_when_there_is_no_other_way) {
  double asked = 0.0;
  SolverOptions options;
  options.largest_strain = 0.004;
  Solver<2> solver(grainy_block({.largest_asked = &asked}), options);
  ASSERT_TRUE(solver.equilibrate().converged);
  const StepReport report = solver.advance(1.0);  // a strain of more than 0.01 at once
  ASSERT_TRUE(report.converged) << report.message;
  EXPECT_GE(report.cuts, 1);
  EXPECT_GE(report.limited, 1);
  EXPECT_LE(asked, 0.004);
}

TEST(rotations, that_nothing_resists_are_refused_before_the_first_iteration) {
  ElasticParameters<2> parameters = kSand;
  parameters.cosserat_shear_modulus = 0.0;
  const auto equilibrate = [&](bool fixed, double internal_length) {
    parameters.internal_length = internal_length;
    Problem<2> problem = grainy_block({});
    problem.materials["all"] = std::make_shared<LocalMaterial<ElasticLaw<2>>>(ElasticLaw<2>(parameters));
    if (fixed) problem.prescribed.push_back({"bottom_left", Dof::w, kZeroOfNoise, {}});
    Solver<2> solver(std::move(problem), {});
    StepReport report = solver.equilibrate();
    if (report.converged) report = solver.advance(1.0);
    return report;
  };
  const StepReport free = equilibrate(false, 3e-3);
  EXPECT_FALSE(free.converged);
  EXPECT_NE(free.message.find("nothing resists the micro-rotation"), std::string::npos) << free.message;
  EXPECT_TRUE(equilibrate(true, 3e-3).converged);  // couple stresses hold the rest
  EXPECT_FALSE(equilibrate(true, 0.0).converged);  // nothing joins the other nodes to the one that is held
}

}  // namespace
