// SPDX-License-Identifier: GPL-2.0-or-later
// The laws of Li and Chu along prescribed paths of two grains (docs/theory.md, D.1, D.2, D.5, C.6).
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <iostream>
#include <numbers>

#include "tests/verification/contact_law_support.hpp"

namespace polargrain::dem {
namespace {

using namespace test;  // NOLINT
constexpr double kStep = 1e-5;

TEST(ContactLaw, RigidRotationOfAPairChangesNothing) {
  ContactPair pair(definition(model("tangential li_chu rolling_friction li_chu rollingFrictionForce on")),
                   place_at(0.0));
  // Springs loaded to about half of each limit, then one full turn of both grains as one body.
  for (int k = 0; k < 100; ++k) pair.advance(place_at(0.0), spins_for(2e-9 / kStep, 3e-9 / kStep));
  const auto before = pair.advance(place_at(0.0), {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()});
  ASSERT_FALSE(before.contact.sliding());
  ASSERT_FALSE(before.contact.rolling_at_limit);
  const int steps = 62832;  // 1e-4 rad each
  const double turn = 2.0 * std::numbers::pi / steps;
  const Eigen::Vector3d spin = turn / kStep * Eigen::Vector3d::UnitZ();
  ContactPair::Answer after;
  for (int k = 1; k <= steps; ++k) after = pair.advance(place_at(k * turn), {spin, spin});
  const double force_drift =
      (after.force - before.force).norm() / std::abs(before.contact.tangential_force());
  const double moment_drift =
      std::abs(after.contact.moment.z() - before.contact.moment.z()) / std::abs(before.contact.moment.z());
  std::cout << "[figure] drift over a turn: tangential force " << force_drift << ", moment " << moment_drift
            << "\n";
  // Mechanics asks for 1e-3. Springs that keep their length leave what a chord misses of its arc: turn^2 / 24
  // of the distance travelled, 1e-8 of the spring's own scale here.
  EXPECT_LT(force_drift, 1e-3);
  EXPECT_LT(moment_drift, 1e-6);
}

TEST(ContactLaw, TwirlingPairOfSpheresTurnsItsForce) {
  auto lines = model("tangential li_chu rolling_friction li_chu");
  ContactPair pair(definition(lines, 3), place_at(0.0));
  for (int k = 0; k < 100; ++k) pair.advance(place_at(0.0), spins_for(2e-9 / kStep, 3e-9 / kStep));
  const auto before = pair.advance(place_at(0.0), {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()});
  const int steps = 15708;  // a quarter turn about the normal, 1e-4 rad each
  const double turn = 0.5 * std::numbers::pi / steps;
  const Eigen::Vector3d spin = turn / kStep * Eigen::Vector3d::UnitX();
  ContactPair::Answer after;
  for (int k = 0; k < steps; ++k) after = pair.advance(place_at(0.0), {spin, spin});
  const Eigen::Matrix3d turned =
      Eigen::AngleAxisd(0.5 * std::numbers::pi, Eigen::Vector3d::UnitX()).toRotationMatrix();
  const double drift = (after.force - turned * before.force).norm() / std::abs(before.force.y());
  const double moment_drift =
      (after.torque_first - turned * before.torque_first).norm() / before.torque_first.norm();
  std::cout << "[figure] drift over a quarter twirl: force " << drift << ", torque " << moment_drift << "\n";
  // Exact turning up to the third order of a step's angle: N turn^3 / 3.
  EXPECT_LT(drift, 1e-6);
  EXPECT_LT(moment_drift, 1e-6);
}

TEST(ContactLaw, PureRollingMeetsOnlyTheMoment) {
  ContactPair pair(definition(model("tangential li_chu rolling_friction li_chu")), place_at(0.0));
  const double stiffness = kRollingRatio * kSliding * kReduced * kReduced;
  const double limit = kRollingFriction * kReduced * kNormalForce;
  const double arm_a = kRadiusA - 0.5 * kOverlap;
  const double arm_b = kRadiusB - 0.5 * kOverlap;
  const double full =
      limit / stiffness * arm_b / (arm_a + arm_b);  // angle of the normal where the limit is met
  const int steps = 2000;
  double worst_moment = 0.0;
  double worst_force = 0.0;
  for (int k = 1; k <= steps; ++k) {
    const double angle = 2.0 * full * k / steps;
    const double rate = 2.0 * full / steps / kStep;
    const Eigen::Vector3d spin = (arm_a + arm_b) / arm_b * rate * Eigen::Vector3d::UnitZ();
    const auto answer = pair.advance(place_at(angle), {Eigen::Vector3d::Zero(), spin});
    const double exact = std::min(stiffness * angle * (arm_a + arm_b) / arm_b, limit);
    worst_moment = std::max(worst_moment, std::abs(answer.contact.moment.z() - exact) / limit);
    worst_force = std::max(worst_force, std::abs(answer.contact.tangential_force()) / kNormalForce);
    if (std::abs(k - steps / 2) > 2) {
      EXPECT_EQ(answer.contact.rolling_at_limit, k > steps / 2);
    }
  }
  std::cout << "[figure] pure rolling: moment error " << worst_moment << ", tangential force / f_n "
            << worst_force << "\n";
  // The overlap is the difference of lengths 1.6e4 times as large: nine digits are left of the normal force.
  EXPECT_LT(worst_moment, 1e-9);
  EXPECT_LT(worst_force, 1e-9);
}

TEST(ContactLaw, AgreesWithTheStockLawsWhereTheyOverlap) {
  // `history` and `epsd2` are the undamped springs with k_th = k_s R*^2 and the limit mu R* f_n. Written by
  // others.
  ContactPair ours(definition(model("tangential li_chu rolling_friction li_chu", 0.5, 0.3, 1.0)),
                   place_at(0.0));
  ContactPair stock(definition(model("tangential history rolling_friction epsd2")), place_at(0.0));
  double worst = 0.0;
  bool slid = false;
  bool rolled = false;
  for (int k = 0; k < 4000; ++k) {
    const auto spins = spins_for(1e-8 * std::cos(0.01 * k) / kStep, 1.2e-8 * std::cos(0.017 * k) / kStep);
    const auto place = place_at(1e-7 * k);
    const auto mine = ours.advance(place, spins);
    const auto theirs = stock.advance(place, spins);
    worst =
        std::max({worst, (mine.force - theirs.force).norm() / kNormalForce,
                  (mine.torque_first - theirs.torque_first).norm() / (kReduced * kNormalForce),
                  std::abs(mine.contact.moment.z() - theirs.contact.moment.z()) / (kReduced * kNormalForce)});
    slid |= mine.contact.sliding();
    rolled |= mine.contact.rolling_at_limit;
  }
  EXPECT_TRUE(slid && rolled);  // else the limits have not been compared
  std::cout << "[figure] li_chu against history + epsd2: " << worst << "\n";
  // They differ by the length that projection loses: 4000 turns of 1e-7 rad.
  EXPECT_LT(worst, 1e-9);
}

TEST(ContactLaw, TotalTangentialForceNeverExceedsSlidingFriction) {
  ContactPair pair(definition(model(kPlain)), place_at(0.0));
  double largest = 0.0;
  double other_way = 0.0;
  for (int k = 0; k < 2000; ++k) {
    const double sign = k < 1000 ? 1.0 : -1.0;
    const auto answer = pair.advance(place_at(0.0), spins_for(sign * 2e-9 / kStep, 3e-9 / kStep));
    largest = std::max(largest, std::abs(answer.contact.tangential_force()) / kNormalForce);
    if (k == 1999) other_way = answer.contact.tangential_force() / kNormalForce;
  }
  std::cout << "[figure] largest f_t / f_n " << largest << "\n";
  EXPECT_NEAR(largest, kFriction, 1e-9);
  // The rolling part stands at +mu_r, the sliding part at its own limit -mu_s: the sum is smaller.
  EXPECT_NEAR(other_way, kForceFriction - kFriction, 1e-9);
}

TEST(ContactLaw, OpeningForgetsTheSprings) {
  ContactPair pair(definition(model(kPlain)), place_at(0.0));
  for (int k = 0; k < 100; ++k) pair.advance(place_at(0.0), spins_for(2e-9 / kStep, 3e-9 / kStep));
  const ContactPair::Spins still{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  EXPECT_GT(pair.advance(place_at(0.0), still).force.norm(), kNormalForce);
  const auto apart =
      pair.advance({Eigen::Vector3d::Zero(), 1.005 * distance() * Eigen::Vector3d::UnitX()}, still);
  EXPECT_EQ(apart.force.norm(), 0.0);
  const auto again = pair.advance(place_at(0.0), still);
  EXPECT_NEAR(again.force.x(), -kNormalForce, 1e-9);
  EXPECT_EQ(again.force.y(), 0.0);
  EXPECT_EQ(again.torque_second.z(), 0.0);
}

TEST(ContactLaw, CurvatureOfTheCellTurnsAndSlidesTheGrains) {
  ContactPair pair(definition(model("tangential li_chu rolling_friction li_chu")), place_at(0.3));
  const double stiffness = kRollingRatio * kSliding * kReduced * kReduced;
  const std::array<double, 2> curvature{3e-4, -1e-4};  // rad/m over 10 steps, below the limit
  pair.bend({curvature[0] / (10 * kStep), curvature[1] / (10 * kStep)});
  ContactPair::Answer answer;
  for (int k = 0; k < 10; ++k)
    answer = pair.advance(place_at(0.3), {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()});
  const Eigen::Vector3d branch = place_at(0.3).second;
  const double exact = stiffness * (curvature[0] * branch.x() + curvature[1] * branch.y());
  EXPECT_NEAR(answer.contact.moment.z() / exact, 1.0, 1e-9);  // round-off of torque minus arm times force
  EXPECT_NEAR(answer.contact.rolling_stiffness / stiffness, 1.0, 1e-12);
  // Unequal radii slide (C.8): du_s = -(r_B - r_A) kappa . l / 2.
  const double slip = -0.5 * (answer.contact.arm_second - answer.contact.arm_first) *
                      (curvature[0] * branch.x() + curvature[1] * branch.y());
  EXPECT_NEAR(answer.contact.tangential_force() / (kSliding * slip), 1.0, 1e-9);
}

}  // namespace
}  // namespace polargrain::dem
