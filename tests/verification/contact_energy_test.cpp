// SPDX-License-Identifier: GPL-2.0-or-later
// Work of the contact laws on closed cycles (docs/theory.md, D.3).
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <numbers>
#include <random>

#include "tests/verification/contact_law_support.hpp"

namespace polargrain::dem {
namespace {

using namespace test;  // NOLINT
constexpr double kStepOfContactEnergy = 1e-5;
const std::string kSymmetric =
    "tangential li_chu rolling_friction li_chu rollingFrictionForce on symmetricCoupling on";

/// Work put into a contact by turning its grains, J.
class WorkMeter {
 public:
  explicit WorkMeter(const std::string& words) : pair_(definition(model(words)), place_at(0.0)) {}
  /// Moves by du_s and du_r; the mean of the forces before and after is exact for linear laws.
  void move(double sliding, double rolling) {
    const auto spins = spins_for(sliding / kStepOfContactEnergy, rolling / kStepOfContactEnergy);
    const auto now = pair_.advance(place_at(0.0), spins);
    work_ -= 0.5 * kStepOfContactEnergy *
             ((last_.torque_first + now.torque_first).dot(spins.first) +
              (last_.torque_second + now.torque_second).dot(spins.second));
    last_ = now;
  }
  [[nodiscard]] double work() const { return work_; }
  [[nodiscard]] const Contact& contact() const { return last_.contact; }

 private:
  ContactPair pair_;
  ContactPair::Answer last_{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), {}};
  double work_ = 0.0;
};

constexpr double kAmplitude = 5e-8;  // m, in u_s and in u_r: below all limits
constexpr int kCorners = 1000;

double work_of_a_circle(const std::string& words, double direction) {
  WorkMeter meter(words);
  const auto corner = [direction](int k) {
    const double angle = direction * 2.0 * std::numbers::pi * k / kCorners;
    return Eigen::Vector2d(kAmplitude * (std::cos(angle) - 1.0), kAmplitude * std::sin(angle));
  };
  bool limited = false;
  for (int k = 1; k <= kCorners; ++k) {
    const Eigen::Vector2d by = corner(k) - corner(k - 1);
    meter.move(by.x(), by.y());
    limited |= meter.contact().sliding() || meter.contact().rolling_at_limit;
  }
  EXPECT_FALSE(limited);
  return meter.work();
}

TEST(ContactEnergy, PlainRollingForceWorksOnAClosedCycle) {
  const double area = 0.5 * kCorners * kAmplitude * kAmplitude * std::sin(2.0 * std::numbers::pi / kCorners);
  const double expected = kForceRatio * kSliding * area;
  const double one_way = work_of_a_circle(kPlain, 1.0);
  const double other_way = work_of_a_circle(kPlain, -1.0);
  std::cout << "[figure] work of a cycle / (k_r area): " << one_way / expected << ", reversed "
            << other_way / expected << "\n";
  // Trapezoids are exact for linear laws, so only round-off is left.
  EXPECT_NEAR(std::abs(one_way) / expected, 1.0, 1e-6);
  EXPECT_NEAR((one_way + other_way) / expected, 0.0, 1e-6);
}

TEST(ContactEnergy, SymmetricCouplingHasAnElasticEnergy) {
  const double scale = kForceRatio * kSliding * std::numbers::pi * kAmplitude * kAmplitude;
  for (const double direction : {1.0, -1.0}) {
    const double work = work_of_a_circle(kSymmetric, direction);
    std::cout << "[figure] symmetric, work of a cycle / (k_r area): " << work / scale << "\n";
    EXPECT_NEAR(work / scale, 0.0, 1e-6);
  }
}

TEST(ContactEnergy, SymmetricContactNeverGivesMoreThanItGot) {
  // Random cycles far beyond all limits, from an unstressed contact: at no time may the work put in be
  // negative.
  std::mt19937 random(20011);
  std::normal_distribution<double> normal;
  double lowest = 0.0;
  double total = 0.0;
  int limited = 0;
  for (int trial = 0; trial < 20; ++trial) {
    WorkMeter meter(kSymmetric);
    std::array<double, 8> waves{};
    for (double& wave : waves) wave = 6e-7 * normal(random);
    Eigen::Vector2d last = Eigen::Vector2d::Zero();
    for (int k = 1; k <= 2000; ++k) {
      const double phase = 2.0 * std::numbers::pi * k / 2000;
      const double s1 = std::sin(phase), s2 = std::sin(2 * phase), c1 = 1 - std::cos(phase),
                   c2 = 1 - std::cos(3 * phase);
      const Eigen::Vector2d at(waves[0] * s1 + waves[1] * s2 + waves[2] * c1 + waves[3] * c2,
                               waves[4] * s1 + waves[5] * s2 + waves[6] * c1 + waves[7] * c2);
      meter.move(at.x() - last.x(), at.y() - last.y());
      last = at;
      lowest = std::min(lowest, meter.work());
      limited += meter.contact().sliding() || meter.contact().rolling_at_limit;
    }
    EXPECT_GT(meter.work(), 0.0) << "a closed cycle through the limits dissipates";
    total += meter.work();
  }
  const double scale = kNormalForce * kFriction * 1e-7;
  std::cout << "[figure] lowest work / (mu f_n 1e-7 m): " << lowest / scale << ", dissipated "
            << total / scale << ", contacts at a limit " << limited / 40000.0 << "\n";
  EXPECT_GT(limited, 10000);
  EXPECT_GT(lowest / scale, -1e-9);  // round-off
}

}  // namespace
}  // namespace polargrain::dem
