// SPDX-License-Identifier: GPL-2.0-or-later
// Averages over contacts against the closed forms of a hexagonal lattice (docs/theory/grains.md, E.7 a).
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "dem/cell/averages.hpp"
#include "dem/cell/tangents.hpp"

namespace polargrain::dem {
namespace {

constexpr double kNormal = 1.0;
constexpr double kTangential = 0.4;

/// The three contacts of one disc of diameter 1 in a hexagonal lattice, each half owned by two discs; the
/// area of a lattice site is sqrt(3)/2.
std::vector<Contact> lattice(double normal_force, double tangential_force = 0.0, double friction = 0.0) {
  std::vector<Contact> contacts;
  for (int k = 0; k < 3; ++k) {
    const double angle = k * std::numbers::pi / 3.0;
    Contact contact;
    contact.branch = {std::cos(angle), std::sin(angle), 0.0};
    const Eigen::Vector3d tangent(-std::sin(angle), std::cos(angle), 0.0);
    contact.force = -normal_force * contact.branch + tangential_force * tangent;
    contact.normal_stiffness = kNormal;
    contact.tangential_stiffness = kTangential;
    contact.friction = friction;
    contacts.push_back(contact);
  }
  return contacts;
}
const double kArea = std::sqrt(3.0) / 2.0;

TEST(Averages, PressureOfTheLattice) {
  const Eigen::Matrix3d stress = average_stress(lattice(0.01), kArea);
  EXPECT_NEAR(stress(0, 0), -std::sqrt(3.0) * 0.01, 1e-16);  // p = sqrt(3) f_n / d
  EXPECT_NEAR(stress(1, 1), -std::sqrt(3.0) * 0.01, 1e-16);
  EXPECT_NEAR(stress(0, 1), 0.0, 1e-16);
}

TEST(Averages, TangentialForcesMakeSkewStress) {
  // sigma_12 - sigma_21 = (1/V) sum |l| f_t (C.2)
  const Eigen::Matrix3d stress = average_stress(lattice(0.01, 0.002), kArea);
  EXPECT_NEAR(stress(0, 1) - stress(1, 0), 3.0 * 0.002 / kArea, 1e-16);
}

TEST(Averages, VoigtTangentIsExactForTheLattice) {
  const Matrix7 tangent = voigt_tangent(lattice(0.01), Eigen::Matrix2d::Identity(), kArea);
  const double lambda = std::sqrt(3.0) / 4.0 * (kNormal - kTangential);
  const double shear = std::sqrt(3.0) / 4.0 * (kNormal + kTangential);
  EXPECT_NEAR(tangent(k11, k11), lambda + 2.0 * shear, 1e-15);
  EXPECT_NEAR(tangent(k11, k22), lambda, 1e-15);
  EXPECT_NEAR(tangent(k12, k12), shear, 1e-15);
  EXPECT_NEAR(tangent(k12, k21), shear, 1e-15);
  EXPECT_NEAR(tangent(k11, k12), 0.0, 1e-15);
}

TEST(Averages, CosseratVoigtTangentIsExactForTheLattice) {
  std::vector<Contact> contacts = lattice(0.01);
  for (Contact& contact : contacts) contact.rolling_stiffness = 0.02;
  const Matrix7 tangent = voigt_cosserat_tangent(contacts, Eigen::Matrix2d::Identity(), kArea);
  const double shear = std::sqrt(3.0) / 4.0 * (kNormal + kTangential);
  const double cosserat = std::sqrt(3.0) / 2.0 * kTangential;
  EXPECT_NEAR(tangent(k12, k12), shear + cosserat, 1e-15);
  EXPECT_NEAR(tangent(k12, k21), shear - cosserat, 1e-15);
  EXPECT_NEAR(tangent(kCurvature1, kCurvature1), std::sqrt(3.0) * 0.02, 1e-15);
  EXPECT_NEAR(tangent(kCurvature2, kCurvature2), std::sqrt(3.0) * 0.02, 1e-15);
  EXPECT_NEAR(tangent(kCurvature1, kCurvature2), 0.0, 1e-15);
  EXPECT_EQ(tangent.topRightCorner(5, 2).norm(), 0.0);
}

TEST(Averages, RollingContactAtItsLimitFollowsTheNormalForce) {
  // One contact along x, M = limit * f_n with limit 0.1: opening by e11 = e takes k_n e from f_n and 0.1 k_n
  // e from M.
  std::vector<Contact> contacts = lattice(0.01);
  contacts.resize(1);
  contacts[0].moment.z() = 0.1 * 0.01;
  contacts[0].rolling_stiffness = 0.02;
  contacts[0].rolling_at_limit = true;
  const Matrix7 tangent = voigt_cosserat_tangent(contacts, Eigen::Matrix2d::Identity(), 1.0);
  EXPECT_NEAR(tangent(kCurvature1, k11), -0.1 * kNormal, 1e-15);
  EXPECT_EQ(tangent(kCurvature1, kCurvature1), 0.0);
  EXPECT_NEAR(average_couple_stress(contacts, 1.0)(0, 2), 1e-3, 1e-18);
}

TEST(Averages, FabricOfTheLatticeIsIsotropic) {
  std::vector<Contact> contacts = lattice(0.01);
  const Eigen::Matrix3d exact = Eigen::Vector3d(0.5, 0.5, 0.0).asDiagonal();
  EXPECT_LT((fabric_tensor(contacts) - exact).norm(), 1e-15);
  contacts.resize(1);
  EXPECT_NEAR(fabric_tensor(contacts)(0, 0), 1.0, 1e-15);
}

TEST(Averages, TangentTurnsWithTheFrame) {
  std::vector<Contact> contacts = lattice(0.01);
  contacts.pop_back();  // anisotropic now
  Eigen::Matrix2d quarter;
  quarter << 0.0, -1.0, 1.0, 0.0;
  const Matrix7 straight = voigt_tangent(contacts, Eigen::Matrix2d::Identity(), kArea);
  const Matrix7 turned = voigt_tangent(contacts, quarter, kArea);
  EXPECT_NEAR(turned(k11, k11), straight(k22, k22), 1e-15);
  EXPECT_NEAR(turned(k22, k11), straight(k11, k22), 1e-15);
  EXPECT_NEAR(turned(k12, k11), -straight(k12, k22), 1e-15);
}

TEST(Averages, SlidingContactKeepsItsFrictionRatio) {
  // One contact along x at its limit, f_t = +mu f_n. Opening by e11 = e: f_n falls by k_n e, f_t by mu k_n e.
  const double mu = 0.5;
  std::vector<Contact> contacts = lattice(0.01, mu * 0.01, mu);
  contacts.resize(1);
  ASSERT_TRUE(contacts[0].sliding());
  const Matrix7 tangent = voigt_tangent(contacts, Eigen::Matrix2d::Identity(), 1.0);
  EXPECT_NEAR(tangent(k11, k11), kNormal, 1e-15);
  EXPECT_NEAR(tangent(k12, k11), -0.5 * mu * kNormal, 1e-15);  // symmetrised: half of d sigma_12
  EXPECT_NEAR(tangent(k12, k12), 0.0, 1e-15);                  // no tangential spring left
}

}  // namespace
}  // namespace polargrain::dem
