// SPDX-License-Identifier: GPL-2.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <iostream>
#include <string>
#include <vector>

#include "common/memory_archive.hpp"
#include "coupler/cells/cell_increment.hpp"
#include "coupler/cells/cell_material.hpp"
#include "tests/integration/command.hpp"
#include "tests/integration/fake_engine.hpp"

namespace polargrain::coupler {
namespace {

constexpr CosseratParameters kCosserat{40e6, 10e6, 0.02};

class CellMaterialTest : public ::testing::Test {
 protected:
  CellMaterialTest() : scratch_("CellMaterial"), pool_(options()) {}

  CellMaterial<2> material(const std::string& script, std::size_t points) {
    CellMaterial<2> made(pool_, pool_.define(testing::fake_definition(script)), kCosserat);
    made.allocate(points);
    return made;
  }

  [[nodiscard]] PoolOptions options() const {
    PoolOptions options;
    options.directory = scratch_.path();
    options.worker_command = {FAKE_WORKER};
    return options;
  }

  testing::Scratch scratch_;
  Pool pool_;
};

Increment<2> some_increment() {
  Increment<2> increment;
  increment.displacement_gradient << 1e-3, -4e-4, 7e-4, -2e-3;
  increment.micro_rotation = 3e-4;
  increment.curvature << 0.02, -0.05;
  return increment;
}

Response<2> evaluate(CellMaterial<2>& material, const Increment<2>& increment) {
  Response<2> response;
  material.evaluate({&increment, 1}, {&response, 1});
  return response;
}

/// The increment whose Cosserat strain is `strain` (eps_33 = 0).
Increment<2> increment_of(const Vector7& strain) {
  Increment<2> increment;
  increment.displacement_gradient << strain[k11], strain[k21], strain[k12], strain[k22];
  increment.curvature << strain[kCurvature1], strain[kCurvature2];
  return increment;
}

TEST_F(CellMaterialTest, CosseratPartFollowsItsClosedForm) {
  CellMaterial<2> sand = material("", 1);
  const Increment<2> increment = some_increment();
  const Vector7 strain = increment.strain();
  const Response<2> response = evaluate(sand, increment);
  const Vector7 cell = testing::fake_stress(increment_for_cell(increment));
  // A.4: s21 - s12 = 2 Gc (eps21 - eps12), m = 2 G lc^2 kappa; sums of doubles of 1e5 Pa.
  EXPECT_NEAR(response.stress[k21] - response.stress[k12], 2.0 * 10e6 * (strain[k21] - strain[k12]), 1e-9);
  EXPECT_NEAR(response.stress[kCurvature1], 2.0 * 40e6 * 0.02 * 0.02 * 0.02, 1e-9);
  EXPECT_NEAR(response.stress[kCurvature2], -2.0 * 40e6 * 0.02 * 0.02 * 0.05, 1e-9);
  EXPECT_NEAR(0.5 * (response.stress[k12] + response.stress[k21]), cell[k12], 1e-9);
  for (int i : {k11, k22, k33}) EXPECT_EQ(response.stress[i], cell[i]);
}

TEST_F(CellMaterialTest, TangentIsTheDerivativeOfTheStress) {
  CellMaterial<2> sand = material("", 1);
  evaluate(sand, some_increment());
  sand.commit();
  const Matrix7 tangent = evaluate(sand, some_increment()).tangent;
  double error = 0.0;
  for (int column : {k11, k22, k12, k21, kCurvature1, kCurvature2}) {
    constexpr double kStep = 1e-4;
    Vector7 strain = Vector7::Zero();
    strain[column] = kStep;
    const Vector7 plus = evaluate(sand, increment_of(strain)).stress;
    strain[column] = -kStep;
    const Vector7 minus = evaluate(sand, increment_of(strain)).stress;
    error = std::max(error, ((plus - minus) / (2.0 * kStep) - tangent.col(column)).cwiseAbs().maxCoeff());
  }
  std::cout << "[figure] tangent against central differences: " << error / 1e8 << " of Young's modulus\n";
  // The law is linear, so only the rounding of 1e5 Pa over a step of 1e-4 is left: 1e-11/1e-4/1e8.
  EXPECT_LT(error / 1e8, 1e-12);
}

TEST_F(CellMaterialTest, IncrementsAddUpOverCommits) {
  CellMaterial<2> sand = material("", 1);
  for (int step = 0; step < 3; ++step) {
    evaluate(sand, some_increment());
    sand.commit();
  }
  Increment<2> whole = some_increment();
  whole.displacement_gradient *= 3.0;
  whole.micro_rotation *= 3.0;
  whole.curvature *= 3.0;
  CellMaterial<2> once = material("", 1);
  const Vector7 expected = evaluate(once, whole).stress;
  const Vector7 stress = evaluate(sand, Increment<2>{}).stress;
  EXPECT_LT((stress - expected).cwiseAbs().maxCoeff(), 1e-9);
  std::vector<double> fields(sand.field_names().size());
  sand.fields(0, fields);
  // The fake counts its evaluations in the coordination number, from 4.
  EXPECT_EQ(fields[1], 7.0);
}

TEST_F(CellMaterialTest, ACommitBringsTheStates) {
  CellMaterial<2> sand = material("", 1);
  evaluate(sand, some_increment());
  evaluate(sand, some_increment());
  EXPECT_EQ(pool_.counts().states_fetched, 0);
  sand.commit();
  EXPECT_EQ(pool_.counts().states_fetched, 1);
  MemoryArchive archive;
  sand.save(archive);
  EXPECT_TRUE(archive.states("points/states").at(0)->is_here());
}

TEST_F(CellMaterialTest, EvaluateStartsFromTheCommittedState) {
  CellMaterial<2> sand = material("", 1);
  const Response<2> first = evaluate(sand, some_increment());
  evaluate(sand, Increment<2>{});
  const Response<2> second = evaluate(sand, some_increment());
  EXPECT_EQ(std::memcmp(first.stress.data(), second.stress.data(), sizeof(Vector7)), 0);
  sand.revert();
  EXPECT_EQ(evaluate(sand, Increment<2>{}).stress, testing::fake_stress(Increment<2>{}));
}

TEST_F(CellMaterialTest, ALimitOfTheCoupleStressHoldsAndItsHistoryIsKept) {
  CosseratParameters limited = kCosserat;  // couple modulus 3.2e4 N
  limited.plastic_length = 2e-3;
  CellMaterial<2> sand(pool_, pool_.define(testing::fake_definition("")), limited);
  CellMaterial<2> resumed(pool_, pool_.define(testing::fake_definition("")), limited);
  sand.allocate(1);
  resumed.allocate(1);
  Increment<2> bent;
  bent.curvature << 0.0, 0.02;
  const auto stress_after = [&](CellMaterial<2>& material, double turn) {
    bent.curvature.y() = turn;
    const Vector7 stress = evaluate(material, bent).stress;
    material.commit();
    return stress;
  };
  const Vector7 yielded = stress_after(sand, 0.02);
  const double limit = 2e-3 * -0.5 * (yielded[k11] + yielded[k22]);
  ASSERT_GT(limit, 100.0);
  ASSERT_LT(limit, 640.0);  // what it would be without
  EXPECT_DOUBLE_EQ(yielded[kCurvature2], limit);
  MemoryArchive archive;
  sand.save(archive);
  resumed.restore(archive);
  const Vector7 unloaded = stress_after(sand, -0.002);
  EXPECT_NEAR(unloaded[kCurvature2], limit - 64.0, 1e-9);
  const Vector7 again = stress_after(resumed, -0.002);
  EXPECT_EQ(std::memcmp(again.data(), unloaded.data(), sizeof(Vector7)), 0);
  EXPECT_EQ(evaluate(sand, Increment<2>{}).stress, unloaded);  // nothing happens where nothing moves
}

TEST_F(CellMaterialTest, PointsAtTheirLimitsAreCountedWhereAStepIsCommittedAndKept) {
  CosseratParameters limited = kCosserat;  // Gc 10 MPa
  limited.skew_limit = 0.5;                // 50 kPa at the pressure of the packing
  CellMaterial<2> sand(pool_, pool_.define(testing::fake_definition("")), limited);
  CellMaterial<2> resumed(pool_, pool_.define(testing::fake_definition("")), limited);
  sand.allocate(3);
  resumed.allocate(3);
  const auto figure = [&sand](const std::string& name) {
    for (const fem::Figure& each : sand.figures())
      if (each.name == name) return each.value;
    return -1.0;
  };
  const auto fields = [&sand](std::size_t point) {
    std::vector<double> values(sand.field_names().size());
    sand.fields(point, values);
    return std::vector<double>(values.end() - 3, values.end());
  };
  std::vector<Increment<2>> increments(3);
  std::vector<Response<2>> responses(3);
  increments[1].micro_rotation = 0.01;  // 400 kPa without a limit
  increments[2].displacement_gradient << 0.01, 0.0, 0.0, 0.01;
  sand.evaluate(increments, responses);
  sand.revert();  // an attempt that is given up
  EXPECT_EQ(sand.at_limits(), "");
  EXPECT_EQ(figure("at_skew_limit_most"), 0.0);
  sand.evaluate(increments, responses);
  sand.commit();
  EXPECT_DOUBLE_EQ(responses[1].stress[k21] - responses[1].stress[k12], 50e3);
  ASSERT_GT(responses[2].stress[k11], 0.0);
  const std::string now =
      "of 3 points at the end (in any step): 1 have grains that have parted (at most 1); 1 carry the largest "
      "skew stress that their grains bear (at most 1)";  // without lp couple stresses still hold their rotations
  EXPECT_EQ(sand.at_limits(), now);
  EXPECT_EQ(fields(0), (std::vector<double>{0.0, 0.0, 0.0}));
  EXPECT_EQ(fields(1), (std::vector<double>{0.0, 1.0, 0.0}));
  EXPECT_EQ(fields(2), (std::vector<double>{1.0, 0.0, 0.0}));
  MemoryArchive archive;
  sand.save(archive);
  resumed.restore(archive);
  EXPECT_EQ(resumed.at_limits(), now);
  // Turned back a little: 10 kPa are left.
  increments[1].micro_rotation = -0.001;
  increments[2] = Increment<2>{};
  for (CellMaterial<2>* const material : {&sand, &resumed}) {
    material->evaluate(increments, responses);
    material->commit();
    EXPECT_NEAR(responses[1].stress[k21] - responses[1].stress[k12], 10e3, 1e-6);
    EXPECT_NE(material->at_limits().find("; 0 carry the largest skew stress"), std::string::npos)
        << material->at_limits();
  }
  EXPECT_EQ(figure("at_skew_limit"), 0.0);
  EXPECT_EQ(figure("at_skew_limit_most"), 1.0);
  EXPECT_EQ(figure("points_parted"), 1.0);
}

TEST_F(CellMaterialTest, WithoutACosseratPartTheCellAnswersWhole) {
  CellMaterial<2> sand(pool_, pool_.define(testing::fake_definition("")), std::nullopt);
  sand.allocate(1);
  EXPECT_EQ(evaluate(sand, some_increment()).stress,
            testing::fake_stress(increment_for_cell(some_increment())));
}

TEST_F(CellMaterialTest, LargeRotationsReachTheCellWhole) {
  CellMaterial<2> sand = material("", 1);
  const double angle = 0.3;
  Increment<2> about_start;
  about_start.configuration = Configuration::start;
  about_start.displacement_gradient << std::cos(angle) - 1.0, -std::sin(angle), std::sin(angle),
      std::cos(angle) - 1.0;
  const Vector7 stress = evaluate(sand, about_start).stress;
  const Vector7 expected = testing::fake_stress(about_start);
  for (const int i : {k11, k22, k33}) EXPECT_NEAR(stress[i], expected[i], 1e-9 * std::abs(expected[i]));
}

TEST_F(CellMaterialTest, NoCallForAZeroIncrement) {
  CellMaterial<2> sand = material("", 5);
  const std::int64_t before = pool_.counts().evaluations;
  std::vector<Increment<2>> increments(5);
  increments[3] = some_increment();
  std::vector<Response<2>> responses(5);
  sand.evaluate(increments, responses);
  EXPECT_EQ(pool_.counts().evaluations - before, 1);
  EXPECT_EQ(responses[0].stress, testing::fake_stress(Increment<2>{}));
  EXPECT_NE(responses[3].stress, responses[0].stress);
}

TEST_F(CellMaterialTest, AFailedCellFailsItsPointAlone) {
  CellMaterial<2> sand = material("fail_beyond 0.1", 2);
  std::vector<Increment<2>> increments(2, some_increment());
  increments[1].displacement_gradient(0, 0) = 0.2;
  std::vector<Response<2>> responses(2);
  sand.evaluate(increments, responses);
  EXPECT_EQ(responses[0].quality, Quality::good);
  EXPECT_EQ(responses[1].quality, Quality::failed);
  EXPECT_EQ(responses[1].message, "the box collapsed");
  EXPECT_EQ(responses[1].step_factor, 0.5);
  sand.revert();
  increments.assign(2, Increment<2>{});
  sand.evaluate(increments, responses);
  for (const Response<2>& response : responses)
    EXPECT_EQ(response.stress, testing::fake_stress(Increment<2>{}));
}

}  // namespace
}  // namespace polargrain::coupler
