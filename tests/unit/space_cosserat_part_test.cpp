// SPDX-License-Identifier: GPL-2.0-or-later
// Skew stress and couple stresses of a point in space: frame, limits, tangent, and the plane's part in the plane.
#include <gtest/gtest.h>

#include <random>

#include "coupler/cells/cosserat_part.hpp"
#include "fem/material/polar_decomposition.hpp"
#include "fem/material/rotation.hpp"

namespace polargrain::coupler {
namespace {

constexpr CosseratParameters kLimitedOfSpaceCosseratPart{10e6, 5e6, 3e-3, 4e-3, 0.8};

/// A cell that follows the symmetric strain elastically.
Response<3> cell(const Increment<3>& increment) {
  Response<3> made;
  Eigen::Matrix<double, 9, 9> stiffness = 20e6 * Eigen::Matrix<double, 9, 9>::Identity();
  for (const int i : {0, 4, 8})
    for (const int j : {0, 4, 8}) stiffness(i, j) += 8e6;
  made.tangent.topLeftCorner<9, 9>() = stiffness;
  made.stress.head<9>() = stiffness * increment.strain().head<9>();
  for (const int i : {0, 4, 8}) made.stress(i) -= 1e5;
  return made;
}

/// A cell with free rotations feels the symmetric gradient alone.
Increment<3> felt(const Increment<3>& increment) {
  Increment<3> made;
  made.displacement_gradient =
      0.5 * (increment.displacement_gradient + increment.displacement_gradient.transpose());
  return made;
}

Increment<3> drawn(std::mt19937& random, double size) {
  std::normal_distribution<double> normal;
  Increment<3> made;
  for (int i = 0; i < 3; ++i) {
    made.rotation(i) = 4.0 * size * normal(random);
    for (int j = 0; j < 3; ++j) {
      made.displacement_gradient(i, j) = size * normal(random);
      made.curvature(i, j) = 400.0 * size * normal(random);
    }
  }
  return made;
}

Response<3> answer(const Increment<3>& increment, const CosseratPart<3>& from) {
  CosseratPart<3> part = from;
  return part.follow(increment, cell(felt(increment)), kLimitedOfSpaceCosseratPart, 1.0);
}

TEST(SpaceCosseratPart, TangentIsTheDerivativeInsideAndAtTheLimits) {
  std::mt19937 random(4);
  int at_skew = 0;
  int at_couple = 0;
  int inside = 0;
  for (int state = 0; state < 60; ++state) {
    const Increment<3> increment = drawn(random, state % 3 == 0 ? 1e-4 : 2e-3);
    CosseratPart<3> part;
    part.pressures = 1e5 * Eigen::Matrix3d::Identity();
    CosseratPart<3> end = part;
    const Response<3> here = end.follow(increment, cell(felt(increment)), kLimitedOfSpaceCosseratPart, 1.0);
    const LimitsReached reached = end.reached(kLimitedOfSpaceCosseratPart, 1.0);
    at_skew += reached.skew ? 1 : 0;
    at_couple += reached.couple ? 1 : 0;
    inside += reached.skew || reached.couple ? 0 : 1;
    // Columns by the gradient alone and by curvature: a strain eps_ij is a gradient h_ji.
    Matrix18 expected = Matrix18::Zero();
    const double step = 1e-7;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        Increment<3> more = increment;
        Increment<3> less = increment;
        more.displacement_gradient(j, i) += step;
        less.displacement_gradient(j, i) -= step;
        expected.col(3 * i + j) = (answer(more, part).stress - answer(less, part).stress) / (2.0 * step);
        more = less = increment;
        more.curvature(j, i) += 1e3 * step;
        less.curvature(j, i) -= 1e3 * step;
        expected.col(9 + 3 * i + j) = (answer(more, part).stress - answer(less, part).stress) / (2e3 * step);
      }
    }
    Matrix18 found = here.tangent;
    // The holds are in the tangent alone.
    Eigen::Matrix<double, 3, 9> skew = Eigen::Matrix<double, 3, 9>::Zero();
    for (int k = 0; k < 3; ++k) {
      const int i = (k + 1) % 3;
      const int j = (k + 2) % 3;
      skew(k, 3 * j + i) = 1.0;
      skew(k, 3 * i + j) = -1.0;
    }
    const Pressures<3> pressures = pressures_of<3>(here.stress);
    const Vector18 strain = increment.strain();
    const Eigen::Vector3d turning = 1e7 * skew * strain.head<9>();
    double pressure = std::max(0.0, pressure_about<3>(pressures, turning));
    if (const double trial = turning.norm(); trial > 0.8 * pressure)
      found.topLeftCorner<9, 9>() -= share_held(trial, 0.8 * pressure) * 5e6 * skew.transpose() * skew;
    const double modulus = kLimitedOfSpaceCosseratPart.couple_modulus();
    const Eigen::Matrix<double, 9, 1> couple = modulus * strain.tail<9>();
    pressure = std::max(0.0, pressure_about_couples<3>(pressures, couple));
    if (const double trial = couple.norm(); trial > 4e-3 * pressure)
      found.bottomRightCorner<9, 9>() -=
          share_held(trial, 4e-3 * pressure) * modulus / (trial * trial) * couple * couple.transpose();
    EXPECT_LT((found - expected).topRows<9>().norm(), 1e-6 * expected.topRows<9>().norm()) << state;
    EXPECT_LT((found - expected).bottomRows<9>().norm(), 1e-6 * expected.bottomRows<9>().norm() + 1e-9)
        << state;
  }
  EXPECT_GT(at_skew, 10);
  EXPECT_GT(at_couple, 10);
  EXPECT_GT(inside, 5);
}

TEST(SpaceCosseratPart, StressesStayWithinTheLimits) {
  std::mt19937 random(9);
  CosseratPart<3> part;
  for (int step = 0; step < 200; ++step) {
    const Increment<3> increment = drawn(random, 2e-3);
    const Response<3> response =
        part.follow(increment, cell(felt(increment)), kLimitedOfSpaceCosseratPart, 1.0);
    // The mean pressure of the plane that the stress turns in, by its two axes.
    const Eigen::Matrix3d s = Eigen::Map<const Eigen::Matrix3d>(response.stress.data());
    const auto pressure = [&s](const Eigen::Vector3d& axis) {
      const Eigen::Vector3d one = axis.unitOrthogonal();
      const Eigen::Vector3d two = axis.cross(one).normalized();
      return std::max(0.0, -0.5 * (one.dot(s * one) + two.dot(s * two)));
    };
    const Eigen::Vector3d turning = 2.0 * fem::axial(s);
    if (turning.norm() > 0.0) {
      EXPECT_LE(turning.norm(), 0.8 * pressure(turning.normalized()) * (1.0 + 1e-9) + 1e-6);
    }
    double squares = 0.0;
    double weighted = 0.0;
    for (int face = 0; face < 3; ++face) {
      const Eigen::Vector3d moments = response.stress.segment<3>(9 + 3 * face);
      squares += moments.squaredNorm();
      if (moments.norm() > 0.0) weighted += moments.squaredNorm() * pressure(moments.normalized());
    }
    if (squares > 0.0) {
      EXPECT_LE(std::sqrt(squares), 4e-3 * weighted / squares * (1.0 + 1e-9) + 1e-9);
    }
  }
}

TEST(SpaceCosseratPart, TurnsWithTheBody) {
  std::mt19937 random(12);
  const Eigen::Matrix3d turn = fem::rotation_by(Eigen::Vector3d(0.4, -0.7, 0.3));
  for (int state = 0; state < 20; ++state) {
    const Increment<3> increment = drawn(random, 1e-3);
    Increment<3> turned;
    turned.displacement_gradient = turn * increment.displacement_gradient * turn.transpose();
    turned.rotation = turn * increment.rotation;
    turned.curvature = turn * increment.curvature * turn.transpose();
    const Vector18 here = answer(increment, {}).stress;
    const Vector18 there = answer(turned, {}).stress;
    EXPECT_LT((fem::rotated(here, turn) - there).norm(), 1e-10 * here.norm());
  }
}

TEST(SpaceCosseratPart, IsThePlanesPartInPlaneStrainBelowAndAtTheLimits) {
  for (const double size : {1.0, 20.0, 100.0}) {
    Increment<3> increment;
    increment.displacement_gradient << 1e-4, 2e-4, 0, -1e-4, -2e-4, 0, 0, 0, 0;
    increment.rotation(2) = 5e-4 * size;
    increment.curvature(2, 0) = 0.02 * size;
    increment.curvature(2, 1) = -0.03 * size;
    Increment<2> plane;
    plane.displacement_gradient = increment.displacement_gradient.topLeftCorner<2, 2>();
    plane.micro_rotation = 5e-4 * size;
    plane.curvature << 0.02 * size, -0.03 * size;
    CosseratPart<3> in_space;
    CosseratPart<2> in_plane;
    Response<3> of_cell = cell(felt(increment));
    of_cell.stress(8) *= 0.7;  // the third stress has no part in the limits
    Response<2> of_plane_cell;
    constexpr std::array<int, 7> places{0, 4, 8, 1, 3, 11, 14};
    of_plane_cell.stress = of_cell.stress(places);
    of_plane_cell.tangent = of_cell.tangent(places, places);
    const Response<3> a = in_space.follow(increment, of_cell, kLimitedOfSpaceCosseratPart, 1.0);
    const Response<2> b = in_plane.follow(plane, of_plane_cell, kLimitedOfSpaceCosseratPart, 1.0);
    EXPECT_LT((Vector7(a.stress(places)) - b.stress).norm(), 1e-12 * b.stress.norm());
    EXPECT_LT((Matrix7(a.tangent(places, places)) - b.tangent).norm(), 1e-12 * b.tangent.norm());
    const LimitsReached reached = in_plane.reached(kLimitedOfSpaceCosseratPart, 1.0);
    EXPECT_EQ(reached.skew, size > 1.0);
    EXPECT_EQ(reached.couple, size > 20.0);
    EXPECT_NEAR(in_space.skew_mobilisation(kLimitedOfSpaceCosseratPart),
                in_plane.skew_mobilisation(kLimitedOfSpaceCosseratPart), 1e-12);
    EXPECT_NEAR(in_space.couple_mobilisation(kLimitedOfSpaceCosseratPart),
                in_plane.couple_mobilisation(kLimitedOfSpaceCosseratPart), 1e-12);
  }
}

}  // namespace
}  // namespace polargrain::coupler
