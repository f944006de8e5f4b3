// SPDX-License-Identifier: GPL-2.0-or-later
// Steps of both methods (fem/solver/automatic.hpp, docs/theory/explicit.md).
#include "fem/solver/automatic.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "common/memory_archive.hpp"
#include "fem/material/elastic.hpp"
#include "fem/material/local_material.hpp"
#include "fem/mesh/rectangle.hpp"

using namespace polargrain;
using namespace polargrain::fem;

namespace {

constexpr double kPressureOfAutomatic = 100e3;

ElasticParameters<2> sand_of_automatic() {
  ElasticParameters<2> parameters{40e6, 0.3, 10e6, 3e-3, Vector7::Zero()};
  for (const int i : {k11, k22, k33}) parameters.initial_stress(i) = -kPressureOfAutomatic;
  return parameters;
}

/// An elastic law whose answers to iterations are never twice the same once points are strained enough, until they are strained
/// more: what grains do that rearrange. Explicit steps get the elastic answer.
class Jumping : public Material<2> {
 public:
  Jumping(double from, double to) : law_(ElasticLaw<2>(sand_of_automatic())), from_(from), to_(to) {}
  void allocate(std::size_t points) override { law_.allocate(points); }
  void expect(const Asking& asking) override {
    once_ = asking.once;
    asked_ = 0;
  }
  void evaluate(std::span<const Increment<2>> increments, std::span<Response<2>> responses) override {
    law_.evaluate(increments, responses);
    if (once_) return;
    ++asked_;
    for (std::size_t point = 0; point < responses.size(); ++point) {
      const double load = -responses[point].stress(k22) - kPressureOfAutomatic;
      if (load > from_ && load < to_)
        responses[point].stress(k22) += ((point / 3 + asked_) % 2 == 0 ? 0.2 : -0.2) * kPressureOfAutomatic;
    }
  }
  void commit() override { law_.commit(); }
  void revert() override { law_.revert(); }
  void save(ArchiveWriter& archive) const override { law_.save(archive); }
  void restore(ArchiveReader& archive) override { law_.restore(archive); }

 private:
  LocalMaterial<ElasticLaw<2>> law_;
  double from_, to_;
  bool once_ = false;
  std::size_t asked_ = 0;
};

Problem<2> biaxial(std::shared_ptr<Material<2>> material, double imbalance = 1.0) {
  Problem<2> problem;
  problem.mesh = rectangle({{0.04, 0.08}, {2, 4}});
  problem.materials["all"] = std::move(material);
  const TimeTable zero = TimeTable::constant(0.0);
  problem.prescribed = {{"bottom", Dof::u1, zero, {}},
                        {"bottom", Dof::u2, zero, {}},
                        {"top", Dof::u1, zero, {}},
                        {"top", Dof::u2, TimeTable::ramp(-0.0008), {}}};
  problem.boundary_loads = {
      {.on = "left", .pressure = TimeTable::constant(imbalance * kPressureOfAutomatic)},
      {.on = "right", .pressure = TimeTable::constant(imbalance * kPressureOfAutomatic)}};
  return problem;
}

std::shared_ptr<Material<2>> elastic_of_automatic() {
  return std::make_shared<LocalMaterial<ElasticLaw<2>>>(ElasticLaw<2>(sand_of_automatic()));
}

constexpr int kSteps = 10;
const AutomaticOptions kOptions{.effort = 12, .explicit_steps = 200, .options = {}};
const SolverOptions kCoarse{.force_tolerance = 1e-3, .moment_tolerance = 1e-3};

std::vector<StepReport> run(Solver<2>& solver, int from = 1, int to = kSteps,
                            std::vector<StepReport> reports = {}) {
  if (from == 1) reports = {solver.begin_automatic(kOptions.effort)};
  for (int step = from; step <= to; ++step)
    reports.push_back(advance_automatic(solver, static_cast<double>(step) / kSteps, reports, kOptions));
  return reports;
}

TEST(iterations_are_due, less_and_less_often_where_they_fail) {
  std::vector<StepReport> steps(1);  // the start, in balance
  std::vector<int> tried;
  for (int step = 1; step <= 70; ++step) {
    StepReport& report = steps.emplace_back();
    report.explicit_steps = 100;
    std::vector<StepReport> before(steps.begin(), steps.end() - 1);
    if (iterations_are_due(before)) {
      tried.push_back(step);
      report.given_up = 12;
    }
  }
  EXPECT_EQ(tried, (std::vector<int>{1, 2, 4, 8, 16, 32, 48, 64}));
  steps.emplace_back();  // balanced by iterations
  EXPECT_TRUE(iterations_are_due(steps));
  StepReport start;
  start.given_up = 12;
  EXPECT_FALSE(iterations_are_due(std::vector{start}));
}

// Where Newton's method never fails nothing else happens, to the bit.
TEST(automatic, has_the_bits_of_newtons_method_where_it_balances) {
  Solver<2> newton(biaxial(elastic_of_automatic(), 1.2), kCoarse);
  ASSERT_TRUE(newton.equilibrate().converged);
  for (int step = 1; step <= kSteps; ++step)
    ASSERT_TRUE(newton.advance(static_cast<double>(step) / kSteps).converged);
  Solver<2> solver(biaxial(elastic_of_automatic(), 1.2), kCoarse);
  for (const StepReport& report : run(solver)) {
    EXPECT_TRUE(report.converged);
    EXPECT_EQ(report.explicit_steps + report.given_up, 0);
  }
  EXPECT_EQ(solver.state().displacement, newton.state().displacement);
  EXPECT_EQ(solver.state().external_work, newton.state().external_work);
}

// Some steps cannot be balanced: explicit steps take them, Newton's method goes on behind them, and the end is where an elastic
// body is.
TEST(automatic, goes_explicitly_through_what_cannot_be_balanced_and_back) {
  Solver<2> newton(biaxial(elastic_of_automatic()), kCoarse);
  ASSERT_TRUE(newton.equilibrate().converged);
  ASSERT_TRUE(newton.advance(1.0).converged);
  Solver<2> plain(biaxial(std::make_shared<Jumping>(1.0 * kPressureOfAutomatic, 3.0 * kPressureOfAutomatic)),
                  kCoarse);
  ASSERT_TRUE(plain.equilibrate().converged);
  bool balanced = true;
  for (int step = 1; step <= kSteps; ++step)
    balanced = balanced && plain.advance(static_cast<double>(step) / kSteps).converged;
  EXPECT_FALSE(balanced);  // so it is a hard case

  Solver<2> solver(biaxial(std::make_shared<Jumping>(1.0 * kPressureOfAutomatic, 3.0 * kPressureOfAutomatic)),
                   kCoarse);
  std::string methods;
  for (const StepReport& report : run(solver)) {
    ASSERT_TRUE(report.converged) << report.message;
    methods += report.given_up > 0 ? 'g' : report.explicit_steps > 0 ? 'e' : 'n';
  }
  std::cout << "[figure] methods of the steps: " << methods << '\n';
  EXPECT_EQ(methods.front(), 'n');
  EXPECT_NE(methods.find('g'), std::string::npos);
  EXPECT_EQ(methods.back(), 'n');
  EXPECT_NEAR(solver.reaction("top")(1) / newton.reaction("top")(1), 1.0, 2e-3);
  EXPECT_NEAR(solver.state().time, 1.0, 1e-12);
}

// The effort is a bound, whatever the step needs: cuts, jumps that are passed, or both.
TEST(automatic, takes_no_more_iterations_than_its_effort) {
  SolverOptions jumping = kCoarse;
  jumping.most_jumps = 50;
  int passed = 0;
  for (const double jump_residual : {0.0, 10.0}) {
    jumping.jump_residual = jump_residual;
    for (const int effort : {1, 2, 3, 5, 8, 13, 40}) {
      Solver<2> solver(
          biaxial(std::make_shared<Jumping>(1.0 * kPressureOfAutomatic, 3.0 * kPressureOfAutomatic)),
          jumping);
      AutomaticOptions options = kOptions;
      options.effort = effort;
      std::vector<StepReport> reports{solver.begin_automatic(effort)};
      for (int step = 1; step <= kSteps; ++step) {
        reports.push_back(advance_automatic(solver, static_cast<double>(step) / kSteps, reports, options));
        ASSERT_TRUE(reports.back().converged) << reports.back().message;
        const bool explicitly = reports.back().explicit_steps > 0;
        EXPECT_LE(explicitly ? reports.back().given_up : reports.back().iterations, effort) << step;
        passed += reports.back().jumps;
      }
    }
  }
  EXPECT_GT(passed, 0);
}

// A start that iterations do not balance: what is out of balance comes in over the first explicit steps.
TEST(automatic, begins_where_iterations_cannot) {
  // Half of the pressure at the sides is missing; points answer with jumps from the start on.
  Solver<2> newton(biaxial(elastic_of_automatic(), 0.7), kCoarse);
  ASSERT_TRUE(newton.equilibrate().converged);
  ASSERT_TRUE(newton.advance(1.0).converged);
  Solver<2> solver(biaxial(std::make_shared<Jumping>(-kPressureOfAutomatic, 0.1 * kPressureOfAutomatic), 0.7),
                   kCoarse);
  const std::vector<StepReport> reports = run(solver);
  EXPECT_GT(reports.front().given_up, 0);
  EXPECT_TRUE(reports.front().converged);
  EXPECT_EQ(reports[1].given_up, 0);
  EXPECT_GT(reports[1].explicit_steps, 0);
  EXPECT_NEAR(solver.reaction("top")(1) / newton.reaction("top")(1), 1.0, 5e-3);
}

// Broken off behind any step, it goes on to the same bits.
TEST(automatic, goes_on_from_an_archive_to_the_same_bits) {
  const auto problem = [] {
    return biaxial(std::make_shared<Jumping>(1.0 * kPressureOfAutomatic, 3.0 * kPressureOfAutomatic));
  };
  Solver<2> through(problem(), kCoarse);
  run(through);
  for (int broken = 1; broken < kSteps; ++broken) {
    Solver<2> first(problem(), kCoarse);
    const std::vector<StepReport> reports = run(first, 1, broken);
    MemoryArchive archive;
    first.save(archive);
    Solver<2> again(problem(), kCoarse);
    again.restore(archive);
    run(again, broken + 1, kSteps, reports);
    EXPECT_EQ(again.state().displacement, through.state().displacement) << broken;
  }
}

}  // namespace
