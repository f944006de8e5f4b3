// SPDX-License-Identifier: GPL-2.0-or-later
// The isotropic moduli of a Cosserat tangent.
#include <gtest/gtest.h>

#include "coupler/cells/network_moduli.hpp"

namespace polargrain::coupler {
namespace {

/// Plane strain, in the order of common/increment.hpp (docs/theory.md, A.4).
Matrix7 isotropic(double lambda, double shear, double cosserat_shear, double couple) {
  Matrix7 c = Matrix7::Zero();
  c(k11, k11) = c(k22, k22) = lambda + 2.0 * shear;
  c(k11, k22) = c(k22, k11) = lambda;
  c(k12, k12) = c(k21, k21) = shear + cosserat_shear;
  c(k12, k21) = c(k21, k12) = shear - cosserat_shear;
  c(kCurvature1, kCurvature1) = c(kCurvature2, kCurvature2) = couple;
  return c;
}

TEST(NetworkModuli, AreThoseThatTheTangentWasMadeOf) {
  const NetworkModuli moduli = network_moduli(isotropic(12e6, 20e6, 7e6, 300.0));
  EXPECT_DOUBLE_EQ(moduli.shear, 20e6);
  EXPECT_DOUBLE_EQ(moduli.cosserat_shear, 7e6);
  EXPECT_DOUBLE_EQ(moduli.couple, 300.0);
  EXPECT_DOUBLE_EQ(moduli.poisson, 12.0 / 64.0);
  EXPECT_DOUBLE_EQ(moduli.length(), std::sqrt(300.0 / 40e6));
}

TEST(NetworkModuli, ShearIsTheMeanOverAllDirections) {
  // G = 20 MPa along the axes and 30 MPa at 45 degrees to them.
  Matrix7 c = isotropic(12e6, 20e6, 7e6, 300.0);
  c(k11, k11) += 10e6;
  c(k22, k22) += 10e6;
  c(k11, k22) -= 10e6;
  c(k22, k11) -= 10e6;
  EXPECT_DOUBLE_EQ(network_moduli(c).shear, 25e6);
  EXPECT_DOUBLE_EQ(network_moduli(c).cosserat_shear, 7e6);
}

}  // namespace
}  // namespace polargrain::coupler
