// SPDX-License-Identifier: GPL-2.0-or-later
// The plane of finite elements and discs within the space of cells (docs/theory/continuum.md, A.7).
#include "common/plane_in_space.hpp"

#include <gtest/gtest.h>

#include <random>

namespace polargrain {
namespace {

Increment<2> some_increment(std::mt19937_64& generator) {
  std::uniform_real_distribution<double> entry(-1.0, 1.0);
  Increment<2> increment;
  for (double& value : increment.displacement_gradient.reshaped()) value = entry(generator);
  increment.micro_rotation = entry(generator);
  for (double& value : increment.curvature) value = entry(generator);
  return increment;
}

Response<2> some_response(std::mt19937_64& generator) {
  std::uniform_real_distribution<double> entry(-1.0, 1.0);
  Response<2> response;
  for (double& value : response.stress) value = entry(generator);
  for (double& value : response.tangent.reshaped()) value = entry(generator);
  response.noise = {1.0, 2.0, 3.0};
  response.quality = Quality::unreliable;
  response.message = "words";
  response.step_factor = 0.25;
  return response;
}

/// A.7 by its indices: eps_ij = u_j,i - e_ijk w_k, then w_j,i, row by row.
Vector18 strain_of(const CellIncrement& increment) {
  const Eigen::Matrix3d& h = increment.displacement_gradient;
  Vector18 strain;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      double spin = 0.0;
      for (int k = 0; k < 3; ++k) spin += 0.5 * (i - j) * (j - k) * (k - i) * increment.rotation(k);
      strain(3 * i + j) = h(j, i) - spin;
      strain(9 + 3 * i + j) = increment.curvature(j, i);
    }
  }
  return strain;
}

TEST(PlaneInSpace, WhatGoesThereComesBack) {
  std::mt19937_64 generator(7);
  for (int repeat = 0; repeat < 20; ++repeat) {
    const Increment<2> increment = some_increment(generator);
    const Increment<2> same = in_plane(in_space(increment));
    EXPECT_EQ(same.displacement_gradient, increment.displacement_gradient);
    EXPECT_EQ(same.micro_rotation, increment.micro_rotation);
    EXPECT_EQ(same.curvature, increment.curvature);
    EXPECT_EQ(out_of_plane_fault(in_space(increment)), "");
    const Response<2> response = some_response(generator);
    const Response<2> back = in_plane(in_space(response, KnownComponents::all));
    EXPECT_EQ(back.stress, response.stress);
    EXPECT_EQ(back.tangent, response.tangent);
    EXPECT_EQ(back.noise.couple, 3.0);
    EXPECT_EQ(back.quality, response.quality);
    EXPECT_EQ(back.message, response.message);
    EXPECT_EQ(back.step_factor, response.step_factor);
  }
}

/// Components of both are conjugate in the same order, so that a tangent means the same in the plane and in space.
TEST(PlaneInSpace, WorkAndTangentAreThoseOfThePlane) {
  std::mt19937_64 generator(8);
  for (int repeat = 0; repeat < 20; ++repeat) {
    const Increment<2> increment = some_increment(generator);
    const Response<2> response = some_response(generator);
    const CellResponse cell = in_space(response, KnownComponents::all);
    const Vector18 strain = strain_of(in_space(increment));
    // Sums of some ten numbers below 3.
    EXPECT_NEAR(cell.components().dot(strain), response.stress.dot(increment.strain()), 1e-13);
    CellResponse change;
    change.set_components(cell.tangent * strain);
    EXPECT_LT((in_plane(change).stress - response.tangent * increment.strain()).cwiseAbs().maxCoeff(), 1e-13);
  }
}

TEST(PlaneInSpace, MotionsOutOfThePlaneAreNamed) {
  const auto fault = [](const auto& change) {
    CellIncrement increment;
    change(increment);
    return out_of_plane_fault(increment);
  };
  EXPECT_NE(
      fault([](CellIncrement& h) { h.displacement_gradient(2, 2) = 1e-300; }).find("displacement gradient"),
      std::string::npos);
  EXPECT_NE(fault([](CellIncrement& h) { h.rotation(1) = 1.0; }).find("rotations"), std::string::npos);
  EXPECT_NE(fault([](CellIncrement& h) { h.curvature(2, 2) = 1.0; }).find("curvatures"), std::string::npos);
  EXPECT_EQ(fault([](CellIncrement& h) { h.curvature(2, 1) = h.rotation(2) = 1.0; }), "");
}

}  // namespace
}  // namespace polargrain
