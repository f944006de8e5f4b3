// SPDX-License-Identifier: GPL-2.0-or-later
// Laboratory tests of closed-form laws against what the laws say in closed form (docs/element_tests.md).
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <iostream>
#include <numbers>

#include "coupler/points/law_point.hpp"
#include "element/driver.hpp"
#include "element/measures.hpp"
#include "element/named_tests.hpp"
#include "fem/material/cone_matching.hpp"
#include "fem/material/elastoplastic.hpp"
#include "fem/material/local_material.hpp"

namespace polargrain::element {
namespace {

using coupler::LawPoint;

constexpr double kPressure = 100e3;
constexpr double kYoung = 50e6;
constexpr double kPoisson = 0.3;
constexpr double kShear = kYoung / (2.0 * (1.0 + kPoisson));
/// Newton's method meets linear laws to rounding: of stresses of 1 MPa, over 100 kPa.
constexpr double kRounding = 1e-10;

fem::ElasticParameters<2> elastic() {
  fem::ElasticParameters<2> parameters;
  parameters.young_modulus = kYoung;
  parameters.poisson_ratio = kPoisson;
  parameters.cosserat_shear_modulus = 10e6;
  parameters.internal_length = 1e-3;
  return parameters;
}

LawPoint elastic_point() {
  return LawPoint(std::make_shared<fem::LocalMaterial<fem::ElasticLaw<2>>>(fem::ElasticLaw<2>(elastic())),
                  kPressure);
}

LawPoint cone_point(const fem::MohrCoulomb& strength) {
  fem::ElastoplasticParameters<2> sand;
  sand.elastic = elastic();
  for (const int place : {0, 1, 2}) sand.elastic.initial_stress[place] = -kPressure;
  const fem::FrozenCone cone = fem::cone_from_plane_strain(strength);
  sand.cone = {cone.friction, cone.dilatancy, cone.cohesion};
  return LawPoint(
      std::make_shared<fem::LocalMaterial<fem::ElastoplasticLaw<2>>>(fem::ElastoplasticLaw<2>(sand)),
      kPressure);
}

/// Grains in space that are none: Hencky's law, Kirchhoff stress from the logarithm of the stretch. Its tangent is that
/// of small strains, so that Newton's method has to do without the right one.
class HenckyPoint : public MaterialPoint {
 public:
  [[nodiscard]] Room room() const override { return Room::space; }
  [[nodiscard]] bool is_large() const override { return true; }
  CellResponse initial() override { return evaluate({}); }
  CellResponse evaluate(const CellIncrement& increment) override {
    trial_ = (Eigen::Matrix3d::Identity() + increment.displacement_gradient) * committed_;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> of(trial_ * trial_.transpose());
    const Eigen::Vector3d logarithms = 0.5 * of.eigenvalues().array().log();
    const Eigen::Matrix3d strain =
        of.eigenvectors() * logarithms.asDiagonal() * of.eigenvectors().transpose();
    const double lambda = 2.0 * kShear * kPoisson / (1.0 - 2.0 * kPoisson);
    CellResponse response;
    response.stress =
        2.0 * kShear * strain + (lambda * strain.trace() - kPressure) * Eigen::Matrix3d::Identity();
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        response.tangent(4 * i, 4 * j) += lambda;
        response.tangent(3 * i + j, 3 * i + j) += kShear;
        response.tangent(3 * i + j, 3 * j + i) += kShear;
      }
    return response;
  }
  void commit() override { committed_ = trial_; }
  [[nodiscard]] const Eigen::Matrix3d& gradient() const { return committed_; }

 private:
  Eigen::Matrix3d committed_ = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d trial_ = Eigen::Matrix3d::Identity();
};

NamedTest named(const std::string& name, double amount, int rows = 20) {
  NamedTest test;
  test.name = name;
  test.drive.amount = amount;
  test.rows = rows;
  return test;
}

Accuracy accuracy(double tolerance = 1e-9) {
  Accuracy made;
  made.pressure = kPressure;
  made.tolerance = tolerance;
  made.largest_increment = 1e-2;
  made.jumps = 0;
  return made;
}

std::vector<Row> rows_of(MaterialPoint& point, const NamedTest& test, const Accuracy& how = accuracy()) {
  EXPECT_FALSE(refusal(test.name, point.room()));
  const std::vector<Stage> stages{completed(stage_of(test, point.room()), point.room())};
  const Outcome outcome = follow(point, stages, how);
  EXPECT_EQ(outcome.failure, "");
  EXPECT_EQ(outcome.rows.size(), static_cast<std::size_t>(test.rows + 1));
  for (const Row& row : outcome.rows) EXPECT_LE(row.residual, how.tolerance);
  return outcome.rows;
}

#define EXPECT_STRESS(found, expected) EXPECT_NEAR((found) / kPressure, (expected) / kPressure, kRounding)

TEST(ElementLaws, OedometerHasTheLateralPressureOfElasticity) {
  LawPoint point = elastic_point();
  const std::vector<Row> rows = rows_of(point, named("oedometer", 0.01));
  const double modulus = kYoung * (1.0 - kPoisson) / ((1.0 + kPoisson) * (1.0 - 2.0 * kPoisson));
  for (const Row& row : rows) {
    const double axial = -row.strain(k22) * modulus;
    EXPECT_STRESS(-row.stress(k22) - kPressure, axial);
    EXPECT_STRESS(-row.stress(k11) - kPressure, axial * kPoisson / (1.0 - kPoisson));
    EXPECT_EQ(row.strain(k11), 0.0);
    EXPECT_EQ(row.strain(k33), 0.0);
  }
  EXPECT_DOUBLE_EQ(rows.back().strain(k22), -0.01);
}

TEST(ElementLaws, OedometerDrivenByItsStress) {
  LawPoint point = elastic_point();
  NamedTest test = named("oedometer", 400e3);
  test.drive.is_stress = true;
  const Row last = rows_of(point, test).back();
  const double modulus = kYoung * (1.0 - kPoisson) / ((1.0 + kPoisson) * (1.0 - 2.0 * kPoisson));
  EXPECT_STRESS(last.stress(k22), -400e3);
  EXPECT_NEAR(last.strain(k22), -300e3 / modulus, kRounding * kPressure / modulus);
}

TEST(ElementLaws, DrainedTriaxialCompressionAndExtension) {
  for (const double strain : {0.02, -0.001}) {
    LawPoint point = elastic_point();
    for (const Row& row : rows_of(point, named("triaxial", strain))) {
      EXPECT_STRESS(row.stress(k22), -kPressure + kYoung * row.strain(k22));
      EXPECT_STRESS(row.stress(k11), -kPressure);
      EXPECT_NEAR(row.strain(k11), -kPoisson * row.strain(k22), 1e-14);
      EXPECT_NEAR(row.strain(k33), row.strain(k11), 1e-14);
      EXPECT_EQ(row.pore_pressure, 0.0);
    }
  }
}

TEST(ElementLaws, UndrainedElasticPathKeepsTheMeanStress) {
  for (const char* const name : {"triaxial", "biaxial"}) {
    LawPoint point = elastic_point();
    NamedTest test = named(name, 0.01);
    test.undrained = true;
    for (const Row& row : rows_of(point, test)) {
      const double strain = -row.strain(k22);
      EXPECT_STRESS(measures_of(row.stress, Room::axes).p, kPressure);
      // Lateral strains are half of the axial one, or all of it where one of them is zero.
      const double lateral = std::string(name) == "triaxial" ? 0.5 * strain : strain;
      EXPECT_STRESS(row.pore_pressure, 2.0 * kShear * lateral);
      EXPECT_NEAR(row.volume, 1.0, 1e-14);
    }
  }
}

TEST(ElementLaws, ConstantMeanStressIsPureShearOfAnElasticLaw) {
  LawPoint point = elastic_point();
  for (const Row& row : rows_of(point, named("constant_p", 0.01))) {
    const StressMeasures measures = measures_of(row.stress, Room::axes);
    EXPECT_STRESS(measures.p, kPressure);
    EXPECT_STRESS(measures.q, 3.0 * kShear * -row.strain(k22));
    EXPECT_NEAR(row.volume, 1.0, 1e-14);
  }
}

TEST(ElementLaws, TrueTriaxialKeepsTheIntermediateStress) {
  for (const double b : {0.0, 0.3, 1.0}) {
    LawPoint point = elastic_point();
    NamedTest test = named("true_triaxial", 0.01);
    test.ratio = b;
    const std::vector<Row> rows = rows_of(point, test);
    EXPECT_NEAR(measures_of(rows.back().stress, Room::axes).b, b, kRounding);
    // With s11 kept: e22 = (ds22 - nu ds33) / E and ds33 = b ds22.
    EXPECT_STRESS(rows.back().stress(k22) + kPressure,
                  kYoung * rows.back().strain(k22) / (1.0 - kPoisson * b));
    // In extension the axial stress is the least, and s33 is at 1 - b between s11 and s22.
    LawPoint other = elastic_point();
    test.drive.amount = -0.001;
    const Row last = rows_of(other, test).back();
    EXPECT_NEAR(measures_of(last.stress, Room::axes).b, b, kRounding);
    EXPECT_STRESS(last.stress(k22) + kPressure, kYoung * last.strain(k22) / (1.0 - kPoisson * (1.0 - b)));
  }
  EXPECT_NEAR(ratio_of_lode_angle(std::numbers::pi / 6.0), 0.5, 1e-15);
  EXPECT_NEAR(ratio_of_lode_angle(std::numbers::pi / 3.0), 1.0, 1e-15);
}

TEST(ElementLaws, SimpleShear) {
  LawPoint point = elastic_point();
  for (const Row& row : rows_of(point, named("simple_shear", 0.02))) {
    EXPECT_STRESS(row.stress(k12), kShear * row.strain(k12));
    EXPECT_STRESS(row.stress(k22), -kPressure);
    EXPECT_STRESS(row.stress(k11), -kPressure);
  }
}

TEST(ElementLaws, RadialUnloadingShrinksTheWholeStress) {
  LawPoint point = elastic_point();
  NamedTest unloading = named("radial_unloading", 0.0);
  unloading.share = 0.25;
  const std::vector<Stage> stages{completed(stage_of(named("biaxial", 0.01), Room::axes), Room::axes),
                                  completed(stage_of(unloading, Room::axes), Room::axes)};
  const Outcome outcome = follow(point, stages, accuracy());
  ASSERT_EQ(outcome.failure, "");
  ASSERT_EQ(outcome.rows.size(), 41u);
  const Vector6 before = outcome.rows[20].stress;
  for (int place = 0; place < 6; ++place) EXPECT_STRESS(outcome.rows[40].stress(place), 0.25 * before(place));
}

TEST(ElementLaws, CyclesTurnAtTheirAmplitude) {
  LawPoint point = elastic_point();
  NamedTest test = named("triaxial", 0.002, 7 * 8);
  test.drive.cycles = 7;
  const std::vector<Row> rows = rows_of(point, test);
  for (int cycle = 0; cycle < 7; ++cycle) {
    EXPECT_DOUBLE_EQ(rows[static_cast<std::size_t>(8 * cycle + 2)].strain(k22), -0.002);
    EXPECT_DOUBLE_EQ(rows[static_cast<std::size_t>(8 * cycle + 6)].strain(k22), 0.002);
    EXPECT_NEAR(rows[static_cast<std::size_t>(8 * cycle + 8)].strain(k22), 0.0, 1e-16);
  }
  EXPECT_STRESS(rows.back().stress(k22), -kPressure);

  LawPoint other = elastic_point();
  test.drive = {true, 30e3, 7};
  const std::vector<Row> stresses = rows_of(other, test);
  EXPECT_STRESS(measures_of(stresses[2].stress, Room::axes).q, 30e3);
  EXPECT_STRESS(measures_of(stresses[54].stress, Room::axes).q, -30e3);
}

/// A change below the tolerance (100 Pa here) still moves the point: the strain is q / E within 2 %, the share of a small
/// change that counts as met.
TEST(ElementLaws, SmallStressesMoveThePoint) {
  constexpr double kShare = 0.02;
  NamedTest test = named("triaxial", 0.0, 40);
  test.drive = {true, 80.0, 1};
  LawPoint point = elastic_point();
  const double expected = 80.0 / kYoung;
  const std::vector<Row> rows = rows_of(point, test, accuracy(1e-3));
  EXPECT_NEAR(rows[10].strain(k22), -expected, kShare * expected);
  EXPECT_NEAR(rows[30].strain(k22), expected, kShare * expected);

  NamedTest isotropic = named("isotropic", 0.0, 4);
  isotropic.pressure = kPressure;
  NamedTest further = isotropic;
  further.pressure = kPressure + 80.0;
  LawPoint other = elastic_point();
  const std::vector<Stage> stages{completed(stage_of(isotropic, Room::axes), Room::axes),
                                  completed(stage_of(further, Room::axes), Room::axes)};
  const Outcome outcome = follow(other, stages, accuracy(1e-3));
  ASSERT_EQ(outcome.failure, "");
  // Each of three stresses is off by the share at most, and the volume strain is their mean over K.
  const double volume = -80.0 * 3.0 * (1.0 - 2.0 * kPoisson) / kYoung;
  EXPECT_NEAR(outcome.rows.back().volume - 1.0, volume, kShare * std::abs(volume));
}

TEST(ElementLaws, ADrainedStageHasNoPorePressure) {
  LawPoint point = elastic_point();
  NamedTest test = named("triaxial", 0.001);
  test.undrained = true;
  NamedTest drained = named("triaxial", 0.002);
  const std::vector<Stage> stages{completed(stage_of(test, Room::axes), Room::axes),
                                  completed(stage_of(drained, Room::axes), Room::axes),
                                  completed(stage_of(test, Room::axes), Room::axes)};
  const Outcome outcome = follow(point, stages, accuracy());
  ASSERT_EQ(outcome.failure, "");
  ASSERT_EQ(outcome.rows.size(), 61u);
  const double loss = kShear * 0.001;  // 2 G times half of the axial strain
  EXPECT_STRESS(outcome.rows[20].pore_pressure, loss);
  EXPECT_EQ(outcome.rows[21].pore_pressure, 0.0);
  EXPECT_EQ(outcome.rows[40].pore_pressure, 0.0);
  EXPECT_STRESS(outcome.rows[40].stress(k11), -kPressure + loss);
  EXPECT_STRESS(outcome.rows[60].pore_pressure, -loss);  // back from 0.2 to 0.1 % counts anew
}

/// q = M p + k with p = s3 + q / 3, and d eps_v = M_psi d eps_q in steady flow (docs/theory/plasticity.md, B.2).
TEST(ElementLaws, DrainedTriaxialOfTheConeReachesItsStrengthAndDilatancy) {
  const fem::MohrCoulomb strength{35.0, 10.0, 2e3};
  const fem::FrozenCone cone = fem::cone_from_plane_strain(strength);
  LawPoint point = cone_point(strength);
  const std::vector<Row> rows = rows_of(point, named("triaxial", 0.1, 100));
  const double expected = (cone.friction * kPressure + cone.cohesion) / (1.0 - cone.friction / 3.0);
  EXPECT_STRESS(measures_of(rows.back().stress, Room::axes).q, expected);
  const Vector6 change = rows[100].strain - rows[90].strain;
  const double shear = 2.0 / 3.0 * (change(k11) - change(k22));
  EXPECT_NEAR(change.head<3>().sum() / shear, cone.dilatancy, 1e-9);
}

/// The approach to the limit is exponential in the strain (as in PlaneStrainLimit of the law's own tests).
TEST(ElementLaws, DrainedBiaxialOfTheConeReachesMohrAndCoulomb) {
  const fem::MohrCoulomb strength{40.0, 10.0, 0.0};
  LawPoint point = cone_point(strength);
  const std::vector<Row> rows = rows_of(point, named("biaxial", 0.4, 400));
  const StressMeasures last = measures_of(rows.back().stress, Room::axes);
  EXPECT_NEAR(last.friction_angle * 180.0 / std::numbers::pi, 40.0, 1e-4);
  const Vector6 change = rows[400].strain - rows[399].strain;
  const double sine = (change(k11) + change(k22)) / (change(k11) - change(k22));
  EXPECT_NEAR(sine, std::sin(10.0 * std::numbers::pi / 180.0), 1e-6);
}

TEST(ElementLaws, AStressBeyondTheStrengthIsAFailureWithItsReason) {
  LawPoint point = cone_point({35.0, 10.0, 0.0});
  NamedTest test = named("triaxial", 10e6);
  test.drive.is_stress = true;
  const std::vector<Stage> stages{completed(stage_of(test, Room::axes), Room::axes)};
  const Outcome outcome = follow(point, stages, accuracy());
  EXPECT_NE(outcome.failure.find("stage 1 (triaxial), row 1 of 20: "), std::string::npos) << outcome.failure;
  EXPECT_NE(outcome.failure.find("of the pressure off"), std::string::npos) << outcome.failure;
  for (const Row& row : outcome.rows) EXPECT_LE(row.residual, 1e-9);
}

TEST(ElementLaws, LargeStrainsInSpaceWithATangentThatIsNotTheirs) {
  HenckyPoint drained;
  const std::vector<Row> rows = rows_of(drained, named("triaxial", 0.2));
  for (const Row& row : rows) {
    const double axial = std::log1p(row.strain(k22));
    // Lateral stresses are met within the tolerance: the axial one follows them by twice Poisson's ratio at most.
    EXPECT_NEAR(row.stress(k22) / kPressure, -1.0 + kYoung * axial / kPressure, 1e-9);
    EXPECT_NEAR(std::log1p(row.strain(k11)), -kPoisson * axial, 1e-11);  // the tolerance over the modulus
  }
  HenckyPoint undrained;
  NamedTest test = named("triaxial", 0.2);
  test.undrained = true;
  const Row last = rows_of(undrained, test).back();
  EXPECT_NEAR(undrained.gradient().determinant(), 1.0, 1e-12);
  EXPECT_NEAR(last.volume, 1.0, 1e-12);
  EXPECT_STRESS(last.pore_pressure, -kShear * std::log(0.8));

  // Simple shear: no gradient below the diagonal, whatever the shear.
  HenckyPoint sheared;
  rows_of(sheared, named("simple_shear", 0.3));
  EXPECT_EQ(sheared.gradient()(1, 0), 0.0);
  EXPECT_NEAR(sheared.gradient()(0, 1), 0.3, 1e-12);
}

TEST(ElementLaws, StrainsAreCountedFromTheZeroOfAStage) {
  HenckyPoint point;
  Stage first = completed(stage_of(named("triaxial", 0.1), Room::space), Room::space);
  Stage second = first;
  second.zero = true;
  const Outcome outcome = follow(point, std::vector{first, second}, accuracy());
  ASSERT_EQ(outcome.failure, "");
  ASSERT_EQ(outcome.rows.size(), 42u);
  EXPECT_EQ(outcome.rows[21].strain, Vector6::Zero());
  EXPECT_NEAR(point.gradient()(1, 1), 0.9 * 0.9, 1e-12);
  EXPECT_NEAR(outcome.rows.back().total_volume, point.gradient().determinant(), 1e-12);
}

TEST(ElementStages, SayWhatIsWrongWithThem) {
  using Kind = Constraint::Kind;
  using Way = Constraint::Way;
  Stage stage;
  stage.constraints = {component(Kind::strain, k22, Way::hold), component(Kind::stress, k22, Way::hold)};
  ASSERT_EQ(faults(stage, Room::space).size(), 1u);
  EXPECT_EQ(faults(stage, Room::space)[0],
            "s22: the component is prescribed twice, as e22 too; leave one of them out");
  stage.constraints = {component(Kind::stress, k33, Way::hold)};
  ASSERT_EQ(faults(stage, Room::discs).size(), 1u);
  EXPECT_NE(faults(stage, Room::discs)[0].find("packing of spheres"), std::string::npos);
  EXPECT_EQ(faults(stage, Room::plane_strain).size(), 1u);
  EXPECT_TRUE(faults(stage, Room::axes).empty());
  stage.constraints = {component(Kind::strain, k22, Way::hold), constant_volume()};
  EXPECT_EQ(faults(stage, Room::discs).size(), 0u);
  ASSERT_EQ(faults(stage, Room::space).size(), 1u);
  EXPECT_NE(faults(stage, Room::space)[0].find("one condition for 2 normal components"), std::string::npos)
      << faults(stage, Room::space)[0];
  EXPECT_TRUE(refusal("triaxial", Room::discs)->find("biaxial") != std::string::npos);
  EXPECT_FALSE(refusal("triaxial", Room::space));
}

TEST(ElementMeasures, OfKnownStresses) {
  Vector6 stress;
  stress << -100e3, -400e3, -160e3, 0.0, 0.0, 0.0;
  const StressMeasures space = measures_of(stress, Room::space);
  EXPECT_DOUBLE_EQ(space.p, 220e3);
  EXPECT_DOUBLE_EQ(space.ratio, 4.0);
  EXPECT_NEAR(space.b, 0.2, 1e-15);
  EXPECT_NEAR(space.friction_angle, std::asin(0.6), 1e-15);
  EXPECT_NEAR(space.q, 300e3 * std::sqrt(1.0 - 0.2 + 0.04), 1e-6);
  const StressMeasures discs = measures_of(stress, Room::discs);
  EXPECT_DOUBLE_EQ(discs.p, 250e3);
  EXPECT_DOUBLE_EQ(discs.q, 300e3);
  stress << -100e3, -60e3, 0.0, 30e3, 0.0, 0.0;  // least stress along x2: extension
  EXPECT_NEAR(measures_of(stress, Room::discs).q, -std::hypot(40e3, 60e3), 1e-6);
}

}  // namespace
}  // namespace polargrain::element
