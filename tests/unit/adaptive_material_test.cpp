// SPDX-License-Identifier: GPL-2.0-or-later
// An adaptive material over cells whose law is known, so that the error of every point is.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iostream>
#include <map>
#include <random>

#include "common/memory_archive.hpp"
#include "coupler/cells/linearised.hpp"
#include "coupler/cells/turned_in_parts.hpp"
#include "tests/unit/known_cells.hpp"

namespace polargrain::coupler {
namespace {

// The regression test on what adaptivity is for: 90 points in three bands, twenty steps. A cell a point would
// be 1800 runs. The numbers were counted when the test was written; they may fall, and must not rise
// unnoticed.
TEST_F(AdaptiveMaterialTest, ARemarkOnTheScriptIsPassedOnOnce) {
  CellCalls<2> calls = cells_.calls();
  calls.initial = [this] {
    PlaneReply packing = cells_.at(Eigen::Matrix2d::Zero());
    packing.response.message = "too many DEM steps";
    return packing;
  };
  AdaptiveMaterial<2> sand(calls, kCosserat, {0.02, 0.0, 1});
  sand.allocate(3);
  EXPECT_EQ(sand.take_notes(), std::vector<std::string>{"too many DEM steps"});
  EXPECT_TRUE(sand.take_notes().empty());
}

TEST_F(AdaptiveMaterialTest, FewCellsServeManyPointsOfLikeHistory) {
  AdaptiveMaterial<2> sand = material(90, 0.02);
  double largest = 0.0;
  for (int k = 0; k < 20; ++k) largest = std::max(largest, error(step(sand, three_bands(90))));
  std::cout << "[figure] " << cells_.runs << " runs for 1800 point steps, " << figure(sand, "cells")
            << " cells, largest error " << largest << " at a tolerance of 0.02\n";
  EXPECT_LE(cells_.runs, 60);
  EXPECT_LE(figure(sand, "cells"), 4.0);
  EXPECT_LE(largest, 0.02);
  EXPECT_EQ(figure(sand, "cell_runs"), cells_.runs);
  const double by_tangent = figure(sand, "point_steps_by_tangent");
  EXPECT_EQ(by_tangent + figure(sand, "point_steps_by_neighbour") + figure(sand, "point_steps_by_own_cell"),
            1800.0);
  // The calm third, and more, needed no run.
  EXPECT_GE(by_tangent, 600.0);
}

TEST_F(AdaptiveMaterialTest, CalmPointsNeverAllocateACell) {
  AdaptiveMaterial<2> sand = material(10, 0.02);
  std::vector<Eigen::Matrix2d> gradients(10, compression(2e-6));
  gradients[3] = compression(1e-3);
  for (int k = 0; k < 10; ++k) step(sand, gradients);
  const std::vector<std::string> names = sand.field_names();
  std::vector<double> fields(names.size());
  const auto steps = static_cast<std::size_t>(std::ranges::find(names, "dem_steps") - names.begin());
  ASSERT_LT(steps, names.size());
  sand.fields(0, fields);
  EXPECT_EQ(fields[0], static_cast<double>(Source::tangent));
  EXPECT_EQ(fields[steps], 0.0) << "its cell is the packing, which has not been run";
  EXPECT_EQ(figure(sand, "cells"), 2.0);
  sand.fields(3, fields);
  EXPECT_EQ(fields[steps], 10.0);
}

TEST_F(AdaptiveMaterialTest, TheErrorFollowsTheTolerance) {
  std::map<double, std::pair<double, int>> found;
  for (const double tolerance : {0.2, 0.02, 0.002}) {
    cells_.runs = 0;
    AdaptiveMaterial<2> sand = material(90, tolerance);
    double largest = 0.0;
    for (int k = 0; k < 20; ++k) largest = std::max(largest, error(step(sand, three_bands(90))));
    found[tolerance] = {largest, cells_.runs};
    std::cout << "[figure] tolerance " << tolerance << ": error " << largest << ", runs " << cells_.runs
              << '\n';
    EXPECT_LE(largest, tolerance);
  }
  EXPECT_GT(found[0.2].first, 2.0 * found[0.02].first);
  EXPECT_GT(found[0.02].first, 2.0 * found[0.002].first);
  EXPECT_LT(found[0.2].second, found[0.02].second);
  EXPECT_LT(found[0.02].second, found[0.002].second);
}

// Ten points of a hundred leave the others after ten steps: they take the state along, and one cell is enough
// for them until they part as well.
TEST_F(AdaptiveMaterialTest, ClustersSplitWhenTheyPart) {
  AdaptiveMaterial<2> sand = material(100, 0.02);
  for (int k = 0; k < 10; ++k) step(sand, std::vector<Eigen::Matrix2d>(100, compression(5e-4)));
  EXPECT_EQ(figure(sand, "cells"), 1.0);
  std::vector<Eigen::Matrix2d> gradients(100, compression(5e-4));
  for (int p = 40; p < 50; ++p) gradients[p] = compression(-5e-4);
  std::vector<Response<2>> responses;
  for (int k = 0; k < 4; ++k) responses = step(sand, gradients);
  EXPECT_EQ(figure(sand, "cells"), 2.0);
  // The estimate is no bound: a law that unloads along its loading curve leaves it by the square of the
  // strain.
  EXPECT_LE(error(responses), 1.5 * 0.02);
}

TEST_F(AdaptiveMaterialTest, FallsBackToACellAPointWhereNoTwoPointsAreAlike) {
  constexpr std::size_t kPoints = 30;
  constexpr int kSteps = 8;
  AdaptiveMaterial<2> sand = material(kPoints, 1e-3);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> entry(-1e-3, 1e-3);
  double largest = 0.0;
  std::vector<Eigen::Matrix2d> last(kPoints, Eigen::Matrix2d::Zero());
  for (int k = 0; k < kSteps; ++k) {
    std::vector<Eigen::Matrix2d> gradients(kPoints);
    for (std::size_t p = 0; p < kPoints; ++p) {
      gradients[p] << entry(random), entry(random), entry(random), entry(random);
      if (k % 2 == 1) gradients[p] = -0.8 * last[p];  // load reversals
      last[p] = gradients[p];
    }
    largest = std::max(largest, error(step(sand, gradients)));
  }
  std::cout << "[figure] " << figure(sand, "point_steps_by_own_cell") << " of " << kPoints * kSteps
            << " point steps by an own cell, largest error " << largest << '\n';
  EXPECT_GE(figure(sand, "point_steps_by_own_cell"), 0.95 * kPoints * kSteps);
  EXPECT_EQ(figure(sand, "cells"), static_cast<double>(kPoints));
  // Offsets are added as gradients follow each other, the law adds strains: 1e-6 of difference a step.
  EXPECT_LE(largest, 2e-3);
}

TEST_F(AdaptiveMaterialTest, AToleranceOfZeroGivesEveryPointItsCell) {
  AdaptiveMaterial<2> sand = material(6, 0.0);
  std::vector<Eigen::Matrix2d> gradients;
  for (int p = 0; p < 6; ++p) gradients.push_back(compression(1e-4 * (p + 1)));
  const std::vector<Response<2>> responses = step(sand, gradients);
  EXPECT_EQ(cells_.runs, 6);
  EXPECT_EQ(error(responses), 0.0);
}

// An offset that a calm point has not told its cell is kept and told when the cell runs: nothing adds up over steps.
TEST_F(AdaptiveMaterialTest, GrainsAreTurnedByAllOfALargeRotation) {
  AdaptiveMaterial<2> sand = material(2, 0.0);
  const double angle = 0.35;
  const Eigen::Matrix2d turn = Eigen::Rotation2Dd(angle).toRotationMatrix() - Eigen::Matrix2d::Identity();
  step(sand, {Eigen::Matrix2d::Zero(), turn}, Configuration::start);
  const Eigen::Matrix2d& told = cells_.last_request.increment.displacement_gradient;
  EXPECT_LT((Eigen::Matrix2d::Identity() + told - Eigen::Rotation2Dd(angle).toRotationMatrix()).norm(),
            1e-15);
  EXPECT_EQ(cells_.last_point, 1u);
}

// Cells take half a radian at once.
TEST_F(AdaptiveMaterialTest, CellsAreTurnedByAnyRotationInParts) {
  const CellCalls<2> calls = cells_.calls();
  const Eigen::Matrix2d one = Eigen::Matrix2d::Identity();
  PlaneRequest far{calls.initial().state, {}};
  far.increment.displacement_gradient = Eigen::Rotation2Dd(1.1).toRotationMatrix() - one;
  far.increment.configuration = Configuration::start;
  PlaneRequest near = far;
  near.increment.displacement_gradient = Eigen::Rotation2Dd(-0.3).toRotationMatrix() - one;
  const std::vector<std::size_t> points{4, 7};
  const std::vector<PlaneReply> replies =
      evaluate_in_parts(calls, std::vector<PlaneRequest>{near, far}, points);
  EXPECT_EQ(cells_.runs, 4);
  EXPECT_EQ(cells_.last_point, 7u);
  EXPECT_EQ(replies[0].diagnostics.dem_steps, 10);
  EXPECT_EQ(replies[1].diagnostics.dem_steps, 30);
  const Eigen::Matrix2d& told = cells_.last_request.increment.displacement_gradient;
  EXPECT_LT((one + told - Eigen::Rotation2Dd(1.1 / 3.0).toRotationMatrix()).norm(), 1e-14);
}

TEST_F(AdaptiveMaterialTest, NothingDriftsOverManySmallSteps) {
  AdaptiveMaterial<2> sand = material(1, 0.02);
  double largest = 0.0;
  for (int k = 0; k < 2000; ++k) largest = std::max(largest, error(step(sand, {compression(1e-5)})));
  std::cout << "[figure] 2000 steps of 1e-5: " << cells_.runs << " runs, largest error " << largest << '\n';
  EXPECT_LE(largest, 0.02);
  EXPECT_LT(cells_.runs, 60);
}

TEST_F(AdaptiveMaterialTest, AnExcursionIsPaidInOneRun) {
  AdaptiveMaterial<2> sand = material(1, 0.05);
  step(sand, {compression(2e-3)});  // so that the packing's curvature is known
  cells_.runs = 0;
  int quiet = 0;
  for (const double amount : {3e-4, 3e-4, -6e-4, -3e-4}) {
    step(sand, {compression(amount)});
    quiet += cells_.runs == 0 ? 1 : 0;
  }
  ASSERT_GE(quiet, 2) << "the excursion was not carried, the test shows nothing";
  const int before = cells_.runs;
  const std::vector<Response<2>> responses = step(sand, {compression(-3e-3)});
  EXPECT_EQ(cells_.runs - before, 1);
  EXPECT_LE(error(responses), 0.05);
}

TEST_F(AdaptiveMaterialTest, WithinAStepTheAnswerIsLinearAndRepeatable) {
  AdaptiveMaterial<2> sand = material(3, 0.05);
  const auto increments = [](double amount) {
    return std::vector<Increment<2>>{increment_of<2>(compression(amount)),
                                     increment_of<2>(compression(1.01 * amount)),
                                     increment_of<2>(compression(0.98 * amount))};
  };
  std::vector<Response<2>> first(3), second(3), between(3), again(3);
  sand.evaluate(increments(1.00e-3), first);
  const int runs = cells_.runs;
  sand.evaluate(increments(1.02e-3), second);
  sand.evaluate(increments(1.01e-3), between);
  sand.evaluate(increments(1.00e-3), again);
  EXPECT_EQ(cells_.runs, runs) << "a correction of 2 % must not ask for new runs";
  for (int p = 0; p < 3; ++p) {
    EXPECT_EQ(std::memcmp(first[p].stress.data(), again[p].stress.data(), sizeof(Vector7)), 0);
    // Linear but for the products of gradients, 1e-3 of 1e-3, and rounding.
    EXPECT_LT((0.5 * (first[p].stress + second[p].stress) - between[p].stress).cwiseAbs().maxCoeff(), 1e-2);
  }
}

TEST_F(AdaptiveMaterialTest, RevertForgetsTheStep) {
  AdaptiveMaterial<2> sand = material(4, 0.02);
  AdaptiveMaterial<2> fresh = material(4, 0.02);
  std::vector<Response<2>> lost(4);
  sand.evaluate(std::vector<Increment<2>>(4, increment_of<2>(compression(3e-3))), lost);
  sand.revert();
  const std::vector<Eigen::Matrix2d> gradients(4, compression(1e-3));
  const std::vector<Response<2>> a = step(sand, gradients);
  const std::vector<Response<2>> b = step(fresh, gradients);
  for (int p = 0; p < 4; ++p) EXPECT_EQ(a[p].stress, b[p].stress);
}

TEST_F(AdaptiveMaterialTest, AFailedCellFailsThePointsItServes) {
  cells_.breaks_at = 5e-3;
  AdaptiveMaterial<2> sand = material(3, 0.02);
  std::vector<Increment<2>> increments{increment_of<2>(compression(1e-4)), increment_of<2>(compression(6e-3)),
                                       increment_of<2>(compression(1e-4))};
  std::vector<Response<2>> responses(3);
  sand.evaluate(increments, responses);
  EXPECT_EQ(responses[1].quality, Quality::failed);
  EXPECT_EQ(responses[1].message, "the box collapsed");
  sand.revert();
  increments[1] = increment_of<2>(compression(1e-4));
  sand.evaluate(increments, responses);
  for (const Response<2>& response : responses) EXPECT_EQ(response.quality, Quality::good);
}

// All points alike, all followed (audit: 100 %), so that the bound is the mean error itself. A cell of its own is run in every
// step and creeps each time; the points' cell is run now and then.
TEST_F(AdaptiveMaterialTest, AuditsMeasureWhatNoEstimateSeesAndItStaysPartOfTheError) {
  cells_.creep = 0.001 * kConfining;
  AdaptiveMaterial<2> sand = material(4, 0.05, 1.0);
  step(sand, std::vector<Eigen::Matrix2d>(4, compression(1e-3)));
  const double first = figure(sand, "error_bound_last");
  EXPECT_LT(first, 1e-9) << "the cell was run to where all points are";
  int carried = 0;
  for (int k = 0; k < 4; ++k) {
    const double runs = figure(sand, "cell_runs");
    step(sand, std::vector<Eigen::Matrix2d>(4, compression(1e-5)));
    carried += figure(sand, "cell_runs") == runs ? 1 : 0;
  }
  ASSERT_EQ(carried, 4) << "nothing was carried, the test shows nothing";
  // Four runs' creep, and the true error of carrying over 4e-5 of strain: its curvature makes
  // kModulus (4.3e-5)^2 / kHalf = 14 Pa, 1.4e-4 of the pressure.
  EXPECT_NEAR(figure(sand, "error_bound_last"), 0.004, 2e-4);
  EXPECT_EQ(figure(sand, "history_errors"), 20.0);
  EXPECT_EQ(figure(sand, "vouched_for"), 1.0);
  EXPECT_EQ(sand.doubt(), "");
}

TEST_F(AdaptiveMaterialTest, AStepBeyondTheToleranceIsAnsweredAnewAndWhatCannotBeMendedIsSaid) {
  cells_.creep = 0.008 * kConfining;
  AdaptiveMaterial<2> sand = material(40, 0.02, 0.1);
  for (int k = 0; k < 12; ++k) {
    std::vector<Eigen::Matrix2d> gradients;
    for (int p = 0; p < 40; ++p) gradients.push_back(compression(1.2e-4 * (1.0 + 0.05 * (p % 11) / 11.0)));
    step(sand, gradients);
  }
  // Without audits the cell is run once or twice in twelve steps; the creep of ten runs is 0.08.
  std::cout << "[figure] bound " << figure(sand, "error_bound") << ", at the end "
            << figure(sand, "error_bound_last") << ", worked with " << figure(sand, "tolerance_worked_with")
            << '\n';
  EXPECT_LT(figure(sand, "tolerance_worked_with"), 0.02);
  EXPECT_GT(figure(sand, "steps_answered_anew"), 0.0);
  EXPECT_EQ(figure(sand, "vouched_for"), 0.0);
  EXPECT_GE(figure(sand, "error_bound"), figure(sand, "error_bound_last"));
  const std::vector<std::string> notes = sand.take_notes();
  ASSERT_FALSE(notes.empty());
  EXPECT_NE(notes.front().find("more than the tolerance of 0.02"), std::string::npos) << notes.front();
  // The material knows increments; which step of a run they belong to is for the run to say.
  EXPECT_EQ(notes.front().find("step"), std::string::npos) << notes.front();
  EXPECT_NE(sand.doubt().find(" of 12 increments"), std::string::npos) << sand.doubt();
  EXPECT_TRUE(sand.take_notes().empty());
  EXPECT_NE(sand.doubt().find("cannot be vouched for"), std::string::npos) << sand.doubt();
}

TEST_F(AdaptiveMaterialTest, AuditsAreDenseAtFirstAndThinWithEvidence) {
  AdaptiveMaterial<2> sand = material(90, 0.02, 0.01);
  step(sand, three_bands(90));
  EXPECT_GE(figure(sand, "points_followed"), 11.0);
  for (int k = 0; k < 20; ++k) step(sand, three_bands(90));
  std::cout << "[figure] audits: bound " << figure(sand, "error_bound") << ", 95th percentile "
            << figure(sand, "history_error_95_percent") << '\n';
  EXPECT_EQ(figure(sand, "points_followed"), 6.0);
  EXPECT_GT(figure(sand, "history_error_largest"), 0.0);
  EXPECT_LE(figure(sand, "history_error_95_percent"), 0.02);
  // Never tightened: what it began with.
  EXPECT_DOUBLE_EQ(figure(sand, "tolerance_worked_with"), 0.02 * std::sqrt(2.0));
  EXPECT_EQ(figure(sand, "vouched_for"), 1.0);
  EXPECT_TRUE(sand.take_notes().empty());
  // Of many points more are followed, their root: 20 of 400, one less behind a calm step.
  AdaptiveMaterial<2> many = material(400, 0.02, 0.01);
  step(many, three_bands(400));
  EXPECT_GE(figure(many, "points_followed"), 19.0);
  EXPECT_LE(figure(many, "points_followed"), 20.0);
  AdaptiveMaterial<2> none = material(90, 0.02, 0.0);
  step(none, three_bands(90));
  EXPECT_NE(none.doubt().find("is unknown"), std::string::npos);
}

// The true mean error is known here: of 400 draws of the points followed the bound covers it in as many as it says.
TEST_F(AdaptiveMaterialTest, TheBoundCoversTheTrueMeanErrorFromTheFirstStep) {
  constexpr int kDraws = 400;
  std::mt19937 random(11);
  std::uniform_real_distribution<double> size(-2e-4, 6e-4);
  std::vector<Eigen::Matrix2d> own;
  for (int p = 0; p < 200; ++p) own.push_back(compression(size(random)));
  for (const int steps : {1, 3}) {
    int covered = 0;
    for (std::uint64_t seed = 1; seed <= kDraws; ++seed) {
      AdaptiveMaterial<2> sand(cells_.calls(), kCosserat, {0.05, 0.01, seed});
      sand.allocate(200);
      strain_.assign(200, Eigen::Matrix2d::Zero());
      std::vector<Response<2>> responses;
      for (int k = 0; k < steps; ++k) responses = step(sand, own);
      double mean = 0.0;
      for (std::size_t p = 0; p < 200; ++p)
        mean += GrainMeasure<2>().stress(responses[p].stress - KnownCells::stress(strain_[p])) / kConfining /
                200.0;
      covered += mean <= figure(sand, "error_bound_last") ? 1 : 0;
    }
    const double share = static_cast<double>(covered) / kDraws;
    std::cout << "[figure] after " << steps << " steps the bound covers the true mean error in " << share
              << " of the draws\n";
    // Three standard deviations of 400 draws of 95 % are 3.3 %.
    EXPECT_GE(share, 0.95 - 0.033);
  }
}

TEST_F(AdaptiveMaterialTest, SharingEndsWhereThereIsNothingToShare) {
  AdaptiveMaterial<2> sand = material(8, 0.002);
  std::vector<Eigen::Matrix2d> gradients;
  for (int p = 0; p < 8; ++p) gradients.push_back(compression((p % 2 == 0 ? 1.0 : -1.0) * 5e-4 * (p + 1)));
  for (int k = 0; k < 3; ++k) step(sand, gradients);
  EXPECT_EQ(figure(sand, "cells"), 8.0);
  EXPECT_EQ(figure(sand, "shares"), 0.0);
  const std::vector<std::string> notes = sand.take_notes();
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_NE(notes.front().find("no cells are left to share"), std::string::npos) << notes.front();
  AdaptiveMaterial<2> alike = material(8, 0.02);
  step(alike, std::vector<Eigen::Matrix2d>(8, compression(1e-3)));
  EXPECT_EQ(figure(alike, "shares"), 1.0);
}

// Runs by part: a step that is given up leaves runs that nobody used.
TEST_F(AdaptiveMaterialTest, RunsOfNoUseAreCounted) {
  AdaptiveMaterial<2> sand = material(2, 0.02);
  std::vector<Response<2>> responses(2);
  sand.evaluate(std::vector<Increment<2>>(2, increment_of<2>(compression(3e-3))), responses);
  const double runs = figure(sand, "cell_runs");
  EXPECT_GE(runs, 1.0);
  EXPECT_EQ(figure(sand, "cell_dem_steps"), 10.0 * runs);
  sand.revert();
  EXPECT_EQ(figure(sand, "cell_runs_unused"), runs);
  EXPECT_EQ(figure(sand, "cell_dem_steps_unused"), 10.0 * runs);
  step(sand, std::vector<Eigen::Matrix2d>(2, compression(1e-3)));
  EXPECT_EQ(figure(sand, "cell_runs_unused"), runs);
}

TEST_F(AdaptiveMaterialTest, GoesOnFromACheckpointBitForBit) {
  AdaptiveMaterial<2> whole = material(30, 0.02, 0.1);
  AdaptiveMaterial<2> first = material(30, 0.02, 0.1);
  std::vector<std::vector<Eigen::Matrix2d>> path;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> size(-2e-4, 1e-3);
  for (int k = 0; k < 12; ++k) {
    path.push_back(three_bands(30));
    for (int p = 0; p < 30; p += 4) path.back()[p] = compression(size(random));
  }
  std::vector<Response<2>> expected, answers;
  for (const auto& gradients : path) expected = step(whole, gradients);
  for (int k = 0; k < 6; ++k) step(first, path[k]);
  MemoryArchive archive;
  first.save(archive);
  AdaptiveMaterial<2> second = material(30, 0.02, 0.1);
  second.restore(archive);
  for (int k = 6; k < 12; ++k) answers = step(second, path[k]);
  for (int p = 0; p < 30; ++p) {
    EXPECT_EQ(std::memcmp(expected[p].stress.data(), answers[p].stress.data(), sizeof(Vector7)), 0) << p;
    EXPECT_EQ(std::memcmp(expected[p].tangent.data(), answers[p].tangent.data(), sizeof(Matrix7)), 0) << p;
  }
  const std::vector<fem::Figure> a = whole.figures();
  const std::vector<fem::Figure> b = second.figures();
  for (std::size_t k = 0; k < a.size(); ++k) {
    if (a[k].name == "decision_seconds") continue;
    EXPECT_EQ(a[k].value, b[k].value) << a[k].name;
  }
  EXPECT_GT(figure(whole, "cells"), 3.0) << "too simple a path to show anything";
  AdaptiveMaterial<2> other = material(31, 0.02, 0.1);
  EXPECT_THROW(other.restore(archive), RunError);
}

}  // namespace
}  // namespace polargrain::coupler
