// SPDX-License-Identifier: GPL-2.0-or-later
// Slips that are spread in explicit steps: a column against its closed form, Newton's method, bits; rows linear in parts.
#include <gtest/gtest.h>

#include <memory>
#include <numeric>
#include <random>

#include "common/memory_archive.hpp"
#include "fem/solver/field_balance.hpp"
#include "tests/support/spread_column.hpp"

using namespace polargrain;
using namespace polargrain::fem;
using namespace polargrain::testing;

namespace {

constexpr int kElements = 20, kSteps = 2000;
constexpr double kFirst = 0.3e-3,
                 kFaster =
                     1.6;  // growth of the displacement of the top in the first row, and from row to row

/// Ends that hold the slip: the waves of a driven plate would begin one there.
Problem<2> column_of(Law (*law)(const ElastoplasticParameters<2>&)) {
  Problem<2> problem = softening_column(kElements, kWidth, 0.5 * kHeight, law);
  for (const char* field : kSpreadFields)
    for (const char* end : {"bottom", "top"})
      problem.prescribed_fields.push_back({field, end, TimeTable::constant(0.0)});
  return problem;
}

double displacement_of(int rows) {
  return kFirst * (std::pow(kFaster, rows) - 1.0) / (kFaster - 1.0);
}

StepReport row_of(Solver<2>& solver, int row, int steps = kSteps) {
  return solver.advance_explicit(displacement_of(row + 1), steps,
                                 {.speed_before = row == 0 ? 1.0 : 1.0 / kFaster});
}

TEST(spread_explicit, column_has_the_thickness_and_the_stress_of_the_closed_form) {
  for (Law (*const law)(const ElastoplasticParameters<2>&) : {cone, answers_of}) {
    Solver<2> solver(column_of(law), {});
    ASSERT_TRUE(solver.begin_explicit().converged);
    for (int row = 0; row < 5; ++row) {
      const StepReport report = row_of(solver, row);
      ASSERT_TRUE(report.converged) << row << " " << report.message;
      if (row < 2) continue;  // elastic, and the onset
      const ClosedForm exact = ClosedForm::at(displacement_of(row + 1), true);
      // Waves of the speed of the plate are 0.4 % of the peak in the last row.
      EXPECT_NEAR(solver.reaction("top")(0) / (kHeight / kElements), exact.stress(), 0.005 * kPeak) << row;
      EXPECT_NEAR(width_of(solver), exact.width(), 0.05 * exact.width()) << row;
    }
  }
}

TEST(spread_explicit, goes_on_from_an_archive_to_the_same_bits) {
  Solver<2> whole(column_of(answers_of), {});
  ASSERT_TRUE(whole.begin_explicit().converged);
  for (int row = 0; row < 3; ++row) ASSERT_TRUE(row_of(whole, row, 400).converged);
  MemoryArchive archive;
  whole.save(archive);
  Solver<2> resumed(column_of(answers_of), {});
  resumed.restore(archive);
  for (int row = 3; row < 5; ++row) {
    ASSERT_TRUE(row_of(whole, row, 400).converged);
    ASSERT_TRUE(row_of(resumed, row, 400).converged);
    EXPECT_TRUE(whole.state().displacement == resumed.state().displacement) << row;
  }
}

/// f - K x - d max(x, 0) at the nodes of a field, with a stiffness K without zeros: where whole changes go round in a circle.
class OneSided final : public StatelessContribution<2> {
 public:
  OneSided(std::vector<int> entries, Eigen::MatrixXd stiffness, Eigen::VectorXd load)
      : entries_(std::move(entries)), stiffness_(std::move(stiffness)), load_(std::move(load)) {}
  [[nodiscard]] std::string name() const override { return "springs of one side"; }
  [[nodiscard]] std::size_t elements() const override { return 1; }
  [[nodiscard]] const std::vector<int>& entries(std::size_t) const override { return entries_; }
  [[nodiscard]] bool fields_store() const override { return false; }
  [[nodiscard]] std::string evaluate(const NodalStep& step, NodalForces& forces) override {
    const Eigen::VectorXd x = step.end(entries_);
    active_ = (x.array() > 0.0).cast<double>();
    forces.internal(entries_) += load_ - stiffness_ * x - kHard * active_.cwiseProduct(x);
    forces.parts(entries_) += load_.cwiseAbs();
    return {};
  }
  [[nodiscard]] Eigen::MatrixXd tangent(std::size_t) const override {
    return -stiffness_ - kHard * Eigen::MatrixXd(active_.asDiagonal());
  }

 private:
  static constexpr double kHard = 1e4;
  std::vector<int> entries_;
  Eigen::MatrixXd stiffness_;
  Eigen::VectorXd load_, active_;
};

TEST(field_balance, finds_the_side_of_every_node) {
  std::mt19937 random(20261129);
  std::normal_distribution<double> normal;
  for (int draw = 0; draw < 200; ++draw) {
    Problem<2> problem;
    problem.mesh = rectangle({{1.0, 1.0}, {5, 3}});
    const int size = static_cast<int>(problem.mesh.nodes.size());
    std::vector<int> nodes(problem.mesh.nodes.size());
    std::iota(nodes.begin(), nodes.end(), 0);
    problem.fields = {NodalField{"x", "", nodes}};
    const FieldPlaces<2> places = problem.places();
    std::vector<int> entries;
    for (const int node : nodes) entries.push_back(places.entry(0, node));
    const Eigen::MatrixXd factor = Eigen::MatrixXd::NullaryExpr(size, size, [&] { return normal(random); });
    const Eigen::VectorXd load = Eigen::VectorXd::NullaryExpr(size, [&] { return normal(random); });
    const auto springs = std::make_shared<OneSided>(entries, factor * factor.transpose(), load);
    problem.contributions = {springs};
    const Constraints<2> constraints(problem);
    FieldBalance<2> balance;
    NodalForces forces;
    const Eigen::VectorXd start = Eigen::VectorXd::Zero(places.size());
    Eigen::VectorXd found = start;
    const auto evaluate = [&](const Eigen::VectorXd& increment) {
      forces.internal = forces.parts = Eigen::VectorXd::Zero(places.size());
      return springs->evaluate({0.0, 1.0, start, increment}, forces);
    };
    EXPECT_EQ(balance.balance(problem, constraints, evaluate, forces, found), "") << draw;
    ASSERT_EQ(evaluate(found), "");
    EXPECT_LE(forces.internal.cwiseAbs().sum(), 1e-8 * load.cwiseAbs().sum()) << draw;
  }
}

}  // namespace
