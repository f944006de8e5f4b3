// SPDX-License-Identifier: GPL-2.0-or-later
// Cells with controlled rotations tell a law their limits of skew and couple stress (docs/theory/plasticity.md, B.9): cells
// whose law is a Cosserat cone of known weights.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iostream>
#include <numbers>
#include <string>
#include <vector>

#include "common/error.hpp"
#include "common/memory_archive.hpp"
#include "coupler/cells/cell_limits.hpp"
#include "coupler/cells/informed_material.hpp"
#include "fem/material/elastoplastic.hpp"

namespace polargrain::coupler {
namespace {

constexpr double kPressureOfInformedCosserat = 100e3;
constexpr double kDiameterOfInformedCosserat = 0.01;
constexpr double kFriction = 0.9;

/// With a couple modulus of 215 N, as packings at rest have: lc = 2.8 mm.
fem::ElasticParameters<2> informed_elasticity() {
  fem::ElasticParameters<2> elastic;
  elastic.young_modulus = 2.0 * 13.4e6 * 1.2;
  elastic.poisson_ratio = 0.2;
  elastic.cosserat_shear_modulus = 10e6;
  elastic.internal_length = 2.8e-3;
  elastic.initial_stress << -kPressureOfInformedCosserat, -kPressureOfInformedCosserat,
      -kPressureOfInformedCosserat, 0.0, 0.0, 0.0, 0.0;
  return elastic;
}

/// Cells that obey a perfectly plastic cone without dilatancy, in small steps.
class ConeCells {
 public:
  explicit ConeCells(const fem::InvariantWeights& weights)
      : law_({informed_elasticity(),
              weights,
              {fem::PiecewiseLinear(kFriction), fem::PiecewiseLinear(0.0), fem::PiecewiseLinear(1.0)}}) {}

  [[nodiscard]] PlaneReply initial() const {
    return reply(law_.initial_state(), informed_elasticity().initial_stress);
  }
  [[nodiscard]] PlaneReply evaluate(const PlaneRequest& request) const {
    constexpr int kParts = 20;
    fem::ElastoplasticState<2> state;
    std::memcpy(static_cast<void*>(&state), request.state->bytes().data(), sizeof state);
    Increment<2> part = request.increment;
    part.displacement_gradient /= kParts;
    part.micro_rotation /= kParts;
    part.curvature /= kParts;
    Response<2> response;
    for (int i = 0; i < kParts; ++i) {
      const fem::ElastoplasticState<2> before = state;
      response = law_.integrate(before, part, state);
      EXPECT_EQ(response.quality, Quality::good) << response.message;
    }
    return reply(state, response.stress);
  }
  [[nodiscard]] CellCalls<2> calls() const {
    return {[this] { return initial(); },
            [this](std::span<const PlaneRequest> requests, std::span<const std::size_t>) {
              std::vector<PlaneReply> replies;
              for (const PlaneRequest& request : requests) replies.push_back(evaluate(request));
              return replies;
            }};
  }

 private:
  static PlaneReply reply(const fem::ElastoplasticState<2>& state, const Vector7& stress) {
    PlaneReply reply;
    reply.response.stress = stress;
    const auto bytes = std::as_bytes(std::span(&state, 1));
    reply.state = std::make_shared<const State>(std::vector<std::byte>(bytes.begin(), bytes.end()));
    return reply;
  }
  fem::ElastoplasticLaw<2> law_;
};

constexpr fem::InvariantWeights kWeights{0.45, 0.05, 0.8};

TEST(CellLimits, WeightsYieldAtTheClosedFormLimitsOfDiscs) {
  // C.6: skew alone yields at 2 mu p, couple alone at (4/pi) mu_th r p.
  constexpr double kMu = 0.5;
  constexpr double kCouple = 4.0 / std::numbers::pi * 0.2 * 5e-3;
  constexpr double kLength = 2.8e-3;
  const fem::InvariantWeights weights = CellLimits{kFriction, 2.0 * kMu, kCouple}.weights(kLength);
  EXPECT_DOUBLE_EQ(weights.a1 + weights.a2, 0.5);
  EXPECT_NEAR(weights.a1 - weights.a2, kFriction * kFriction / (6.0 * kMu * kMu), 1e-15);
  EXPECT_NEAR(std::sqrt(3.0 * weights.a3) / kLength, kFriction / kCouple, 1e-9 * kFriction / kCouple);
  // The invariant itself, at those stresses under the pressure of one.
  fem::ElasticParameters<2> elastic = informed_elasticity();
  elastic.internal_length = kLength;
  const fem::SubspaceModuli moduli(elastic, weights);
  fem::ScaledVector<double> stress = fem::ScaledVector<double>::Zero();
  stress(k21) = kMu;  // s21 - s12 = 2 mu
  stress(k12) = -kMu;
  EXPECT_NEAR(fem::deviatoric_stress(fem::Split<double>(stress), moduli), kFriction, 1e-14);
  stress.setZero();
  stress(kCurvature2) = kCouple / kLength;
  EXPECT_NEAR(fem::deviatoric_stress(fem::Split<double>(stress), moduli), kFriction, 1e-14);
  // Elastic and plastic length are two.
  EXPECT_NEAR((CellLimits{kFriction, 1.0, kCouple}.plastic_length()), kLength / std::sqrt(2.0 * weights.a3),
              1e-15);
}

TEST(CellLimits, TheWeightsOfAConeAreFoundAgain) {
  const ConeCells cells(kWeights);
  const CellLimits limits = limits_of(cells.calls(), cells.initial(), kDiameterOfInformedCosserat);
  const fem::InvariantWeights found = limits.weights(informed_elasticity().internal_length);
  std::cout << "[figure] " << limits.text() << "; weights " << found.a1 << ", " << found.a2 << ", "
            << found.a3 << '\n';
  // Reached along an asymptote: within 1e-3 after a shear of 4 %; weights go with the square of the limits.
  EXPECT_NEAR(limits.friction / kFriction, 1.0, 2e-3);
  EXPECT_NEAR(found.a1, kWeights.a1, 4e-3 * kWeights.a1);
  EXPECT_NEAR(found.a3, kWeights.a3, 8e-3 * kWeights.a3);
}

TEST(CellLimits, GrainsThatResistNothingAreNamed) {
  const ConeCells cells(kWeights);
  CellCalls<2> calls = cells.calls();
  calls.evaluate = [&cells](std::span<const PlaneRequest> requests, std::span<const std::size_t>) {
    return std::vector<PlaneReply>(requests.size(), cells.initial());
  };
  try {
    limits_of(calls, cells.initial(), kDiameterOfInformedCosserat);
    FAIL();
  } catch (const RunError& error) {
    EXPECT_NE(std::string(error.what()).find("sheared it resists nothing"), std::string::npos)
        << error.what();
  }
}

InformedParameters<2> parameters(InformedUpdate update) {
  InformedParameters<2> made;
  made.elastic = informed_elasticity();
  made.update = update;
  made.mean_diameter = kDiameterOfInformedCosserat;
  made.mobilisation.cohesion = 1.0;
  made.mobilisation.initial_friction = 0.09;
  return made;
}

/// Compression, then shear with bending and grains that turn.
Increment<2> increment_of_path(int step, int steps) {
  Increment<2> increment;
  const double size = 20e-3 / steps;
  increment.displacement_gradient << 0.9 * size, 0.3 * size, 0.3 * size, -size;
  if (2 * step > steps) {
    increment.micro_rotation = 0.6 * size;
    increment.curvature << 0.8 * size / kDiameterOfInformedCosserat,
        -0.2 * size / kDiameterOfInformedCosserat;
  }
  return increment;
}

/// The largest difference of the law's stress from its cell's beyond the first fifth of the path, with couple stresses
/// over lc, as a share of the pressure. @param free_weights the standard ones in place of the cell's
double error_of(InformedUpdate update, int steps, bool standard) {
  const ConeCells cells(kWeights);
  InformedParameters<2> given = parameters(update);
  if (standard) given.weights = fem::InvariantWeights{};
  InformedMaterial<2> law(cells.calls(), given);
  law.allocate(1);
  PlaneReply cell = cells.initial();
  double largest = 0.0;
  for (int step = 1; step <= steps; ++step) {
    const Increment<2> increment = increment_of_path(step, steps);
    Response<2> response;
    law.evaluate({&increment, 1}, {&response, 1});
    EXPECT_EQ(response.quality, Quality::good) << response.message;
    law.commit();
    cell = cells.evaluate({cell.state, increment});
    Vector7 difference = response.stress - cell.response.stress;
    difference.tail<2>() /= informed_elasticity().internal_length;
    if (5 * step > steps) largest = std::max(largest, difference.norm() / kPressureOfInformedCosserat);
  }
  return largest;
}

TEST(InformedCosserat, BendingAndTurningFollowTheCellWithItsOwnWeights) {
  const double coarse = error_of(InformedUpdate::fixed_point, 40, false);
  const double fine = error_of(InformedUpdate::fixed_point, 160, false);
  const double frozen = error_of(InformedUpdate::frozen, 160, false);
  const double standard = error_of(InformedUpdate::fixed_point, 160, true);
  std::cout << "[figure] fixed point " << coarse << " (40 steps), " << fine << " (160), frozen " << frozen
            << " (160); with standard weights " << standard << " of the pressure\n";
  EXPECT_LT(fine, 0.02);
  EXPECT_LT(frozen, 0.06);
  EXPECT_GT(standard, 10.0 * fine) << "the weights make no difference, the test shows nothing";
}

TEST(InformedCosserat, GoesOnFromAnArchiveBitForBit) {
  const ConeCells cells(kWeights);
  for (const InformedUpdate update : {InformedUpdate::frozen, InformedUpdate::fixed_point}) {
    InformedMaterial<2> whole(cells.calls(), parameters(update));
    InformedMaterial<2> other(cells.calls(), parameters(update));
    whole.allocate(1);
    other.allocate(1);
    Response<2> a, b;
    for (int step = 1; step <= 20; ++step) {
      const Increment<2> increment = increment_of_path(step, 20);
      whole.evaluate({&increment, 1}, {&a, 1});
      whole.commit();
      if (step == 12) {
        MemoryArchive archive;
        whole.save(archive);
        other.restore(archive);
      } else if (step > 12) {
        other.evaluate({&increment, 1}, {&b, 1});
        other.commit();
      }
    }
    EXPECT_EQ(a.stress, b.stress);
    EXPECT_EQ(a.tangent, b.tangent);
    EXPECT_GT(std::abs(a.stress(kCurvature1)), 1.0);
  }
}

TEST(InformedCosserat, APointThatHasLeftItsLawTakesTheWholeAnswerOfItsCell) {
  const ConeCells cells(kWeights);
  InformedParameters<2> given = parameters(InformedUpdate::frozen);
  given.weights = fem::InvariantWeights{};  // not the cell's, so that they part
  given.mismatch_limit = 0.05;
  given.beyond_mismatch = BeyondMismatch::cell;
  given.mobilisation.drift_shear = 1e-3;
  InformedMaterial<2> law(cells.calls(), given, "", cells.calls());
  law.allocate(1);
  PlaneReply cell = cells.initial();
  Response<2> response;
  for (int step = 1; step <= 40; ++step) {
    const Increment<2> increment = increment_of_path(step, 40);
    law.evaluate({&increment, 1}, {&response, 1});
    law.commit();
    cell = cells.evaluate({cell.state, increment});
  }
  EXPECT_EQ(law.figures().at(4).value, 1.0);
  EXPECT_EQ(response.stress, cell.response.stress);
  EXPECT_GT(std::abs(response.stress(kCurvature1)), 1.0);
}

TEST(InformedCosserat, TellsWhatItFoundAndMeasuresMomentsByTheGrains) {
  const ConeCells cells(kWeights);
  InformedMaterial<2> law(cells.calls(), parameters(InformedUpdate::frozen));
  law.allocate(1);
  const std::vector<std::string> notes = law.take_notes();
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_NE(notes.front().find("limits of the packing: M "), std::string::npos) << notes.front();
  EXPECT_NE(notes.front().find("invariants [0.4"), std::string::npos) << notes.front();
  EXPECT_EQ(law.moment_length(), kDiameterOfInformedCosserat);
}

/// Cells whose grains turn freely, of a law that has a plastic length.
InformedParameters<2> with_plastic_length(double length, double initial_friction) {
  InformedParameters<2> made = parameters(InformedUpdate::frozen);
  made.mean_diameter = 0.0;
  made.mobilisation.initial_friction = initial_friction;
  // As a case hands it over.
  made.set_moduli({13.4e6, made.elastic.cosserat_shear_modulus, made.elastic.internal_length, length});
  return made;
}

TEST(InformedPlasticLength, CoupleStressIsLimitedToItTimesThePressureWhateverTheFriction) {
  const ConeCells cells(fem::InvariantWeights{});
  constexpr double kLength = 7e-3;
  for (const double friction : {0.05, 0.3}) {
    InformedMaterial<2> law(cells.calls(), with_plastic_length(kLength, friction));
    law.allocate(1);
    Response<2> response;
    for (int step = 0; step < 60;
         ++step) {  // bent about one axis, then about the other: elastic to 2 G lc^2 kappa = 10 lp p
      Increment<2> increment;
      increment.curvature(step < 30 ? 0 : 1) = 1.1;
      law.evaluate({&increment, 1}, {&response, 1});
      ASSERT_EQ(response.quality, Quality::good) << response.message;
      law.commit();
      if (step != 29 && step != 59) continue;
      // The cohesion of 1 Pa raises the limit by 1e-4 and less of itself.
      const double moment = response.stress.tail<2>().norm();
      EXPECT_NEAR(moment / (kLength * kPressureOfInformedCosserat), 1.0, 2e-4)
          << "friction " << friction << ", step " << step;
    }
    EXPECT_GT(response.stress(kCurvature2), 0.99 * response.stress.tail<2>().norm());
  }
}

TEST(InformedPlasticLength, ShearAndBendingShareAnEllipse) {
  const ConeCells cells(fem::InvariantWeights{});
  constexpr double kLength = 7e-3;
  InformedMaterial<2> law(cells.calls(), with_plastic_length(kLength, 0.09));
  law.allocate(1);
  std::vector<double> fields(law.field_names().size());
  Response<2> response;
  double least_share = 1.0;
  for (int step = 0; step < 80; ++step) {
    law.fields(0, fields);
    const double friction = fields[0];  // of the step that comes
    Increment<2> increment;
    increment.displacement_gradient << 5e-4, 0.0, 0.0, -5e-4;
    if (step >= 40) increment.curvature << 0.05, 0.0;
    law.evaluate({&increment, 1}, {&response, 1});
    ASSERT_EQ(response.quality, Quality::good) << response.message;
    // Without dilatancy s33 stays in the middle in the end, and the deviator is sqrt(3) times the shear in the plane.
    const double pressure = -(response.stress(k11) + response.stress(k22) + response.stress(k33)) / 3.0;
    const double shear = std::numbers::sqrt3 * 0.5 * (response.stress(k11) - response.stress(k22));
    const double bent = response.stress.tail<2>().norm() / (kLength * pressure);
    if (step >= 60) {
      EXPECT_NEAR(std::hypot(shear / (friction * pressure), bent), 1.0, 2e-3) << "step " << step;
      least_share = std::min(least_share, bent);
    }
    law.commit();
  }
  EXPECT_GT(least_share, 0.05) << "it is not bent enough to show anything";
}

TEST(InformedPlasticLength, TheTangentIsThatOfTheStep) {
  const ConeCells cells(fem::InvariantWeights{});
  InformedMaterial<2> law(cells.calls(), with_plastic_length(7e-3, 0.3));
  law.allocate(1);
  Increment<2> step;
  step.displacement_gradient << 8e-4, 2e-4, -1e-4, -9e-4;
  step.curvature << 1.0, -0.4;
  Response<2> response;
  for (int k = 0; k < 3; ++k) {
    law.evaluate({&step, 1}, {&response, 1});
    ASSERT_EQ(response.quality, Quality::good);
    if (k < 2) law.commit();
  }
  for (int axis = 0; axis < 2; ++axis) {
    constexpr double kShift = 1e-6;
    Response<2> more, less;
    Increment<2> shifted = step;
    shifted.curvature(axis) += kShift;
    law.evaluate({&shifted, 1}, {&more, 1});
    shifted.curvature(axis) -= 2.0 * kShift;
    law.evaluate({&shifted, 1}, {&less, 1});
    const Vector7 slope = (more.stress - less.stress) / (2.0 * kShift);
    EXPECT_LT((slope - response.tangent.col(5 + axis)).norm(), 1e-5 * response.tangent.col(5 + axis).norm());
  }
}

/// The skew stress of such a law is at most this share of its pressure in the plane.
constexpr double kSkewShare = 0.5;

InformedParameters<2> with_skew_limit(InformedUpdate update) {
  InformedParameters<2> made = parameters(update);
  made.mean_diameter = 0.0;
  // As a case hands it over.
  made.set_moduli(
      {13.4e6, made.elastic.cosserat_shear_modulus, made.elastic.internal_length, {}, kSkewShare});
  return made;
}

/// Grains turned by w against the continuum: eps21 - eps12 = 2 w.
Increment<2> turned_of_informed_cosserat(double w) {
  Increment<2> increment;
  increment.micro_rotation = w;
  return increment;
}

double skew_of_informed(const Response<2>& response) {
  return response.stress(k21) - response.stress(k12);
}

double figure(const InformedMaterial<2>& law, const std::string& name) {
  for (const fem::Figure& each : law.figures())
    if (each.name == name) return each.value;
  ADD_FAILURE() << "no figure " << name;
  return -1.0;
}

TEST(InformedSkewLimit, TurningYieldsUnloadsElasticallyAndIsCountedAndKept) {
  const ConeCells cells(fem::InvariantWeights{});
  constexpr double kStep = 7e-4;  // 2.8e4 Pa; the limit is at 5e4 Pa
  for (const InformedUpdate update : {InformedUpdate::frozen, InformedUpdate::fixed_point}) {
    InformedMaterial<2> law(cells.calls(), with_skew_limit(update));
    InformedMaterial<2> resumed(cells.calls(), with_skew_limit(update));
    law.allocate(1);
    resumed.allocate(1);
    std::vector<double> fields(law.field_names().size());
    double expected = 0.0;
    Response<2> response;
    Response<2> again;
    for (int step = 0; step < 20; ++step) {
      const Increment<2> increment = turned_of_informed_cosserat(step < 10 ? kStep : -kStep);
      // An attempt that is given up counts for nothing.
      const Increment<2> too_far = turned_of_informed_cosserat(1.0);
      law.evaluate({&too_far, 1}, {&response, 1});
      law.revert();
      law.evaluate({&increment, 1}, {&response, 1});
      ASSERT_EQ(response.quality, Quality::good) << response.message;
      const double limit = -0.5 * kSkewShare * (response.stress(k11) + response.stress(k22));
      ASSERT_NEAR(limit, kSkewShare * kPressureOfInformedCosserat, 1e-3) << step;
      expected = std::clamp(expected + 4.0 * 10e6 * increment.micro_rotation, -limit, limit);
      ASSERT_NEAR(skew_of_informed(response), expected, 1e-6) << step;
      if (step >= 10) {
        resumed.evaluate({&increment, 1}, {&again, 1});
        resumed.commit();
        ASSERT_EQ(again.stress, response.stress) << step;
      }
      law.commit();
      law.fields(0, fields);
      EXPECT_NEAR(fields[fields.size() - 2], std::abs(expected) / limit, 1e-9) << step;
      EXPECT_EQ(figure(law, "at_skew_limit"), std::abs(expected) == limit ? 1.0 : 0.0) << step;
      EXPECT_EQ(figure(law, "at_skew_limit_most"), step < 1 ? 0.0 : 1.0) << step;
      if (step == 9) {
        EXPECT_EQ(law.at_limits(),
                  "of 1 points at the end (in any step): 1 carry the largest skew stress that their grains "
                  "bear (at most 1)");
        MemoryArchive archive;
        law.save(archive);
        resumed.restore(archive);
        EXPECT_EQ(resumed.at_limits(), law.at_limits());
      }
    }
    EXPECT_NEAR(expected, -kSkewShare * kPressureOfInformedCosserat, 1e-3)
        << "it has not been turned back to the other limit";
    EXPECT_EQ(resumed.at_limits(), law.at_limits());
  }
}

TEST(InformedSkewLimit, TheTangentIsThatOfTheStepButForWhatHoldsTheRotation) {
  const ConeCells cells(fem::InvariantWeights{});
  InformedMaterial<2> law(cells.calls(), with_skew_limit(InformedUpdate::frozen));
  law.allocate(1);
  Increment<2> step = turned_of_informed_cosserat(2e-3);
  step.displacement_gradient << 8e-4, 2e-4, -1e-4, -9e-4;
  Response<2> response;
  for (int k = 0; k < 3; ++k) {
    law.evaluate({&step, 1}, {&response, 1});
    ASSERT_EQ(response.quality, Quality::good) << response.message;
    if (k < 2) law.commit();
    if (k == 1) step.displacement_gradient *= 0.7;  // away from the end of what a step takes up
  }
  ASSERT_NEAR(skew_of_informed(response), -0.5 * kSkewShare * (response.stress(k11) + response.stress(k22)),
              1e-6);
  Matrix7 expected = response.tangent;
  const double hold = CosseratPart<2>::kHold * 10e6;
  expected(k12, k12) -= hold;
  expected(k21, k21) -= hold;
  expected(k12, k21) += hold;
  expected(k21, k12) += hold;
  for (const int column : {k11, k22, k12, k21}) {
    constexpr double kShift = 1e-8;
    Vector7 strain = Vector7::Zero();
    strain(column) = kShift;
    Eigen::Matrix2d shift;
    shift << strain(k11), strain(k21), strain(k12), strain(k22);
    Response<2> more, less;
    Increment<2> shifted = step;
    shifted.displacement_gradient += shift;
    law.evaluate({&shifted, 1}, {&more, 1});
    shifted.displacement_gradient -= 2.0 * shift;
    law.evaluate({&shifted, 1}, {&less, 1});
    const Vector7 slope = (more.stress - less.stress) / (2.0 * kShift);
    EXPECT_LT((slope - expected.col(column)).norm(), 1e-5 * 13.4e6) << column;
  }
}

TEST(InformedSkewLimit, WithoutOneNothingChanges) {
  const ConeCells cells(fem::InvariantWeights{});
  InformedParameters<2> given = with_skew_limit(InformedUpdate::frozen);
  given.skew_limit.reset();
  InformedMaterial<2> law(cells.calls(), given);
  law.allocate(1);
  const Increment<2> far = turned_of_informed_cosserat(0.01);
  Response<2> response;
  law.evaluate({&far, 1}, {&response, 1});
  law.commit();
  EXPECT_NEAR(skew_of_informed(response), 4.0 * 10e6 * 0.01, 1e-6);
  EXPECT_EQ(law.at_limits(), "");
}

}  // namespace
}  // namespace polargrain::coupler
