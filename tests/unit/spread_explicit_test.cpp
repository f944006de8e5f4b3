// SPDX-License-Identifier: GPL-2.0-or-later
// Slips that are spread in explicit steps: bits of a run that goes on; rows linear in parts.
#include <gtest/gtest.h>

#include <memory>
#include <numeric>
#include <random>

#include "common/memory_archive.hpp"
#include "fem/solver/field_balance.hpp"
#include "tests/support/spread_explicit_column.hpp"

namespace polargrain::testing::spread_column {
namespace {

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
}  // namespace polargrain::testing::spread_column
