// SPDX-License-Identifier: GPL-2.0-or-later
// A single point driven to collapse in plane strain must show the Mohr-Coulomb strength it was matched to
// (docs/theory/plasticity.md, B.3).
#include <gtest/gtest.h>

#include <iostream>
#include <numbers>

#include "fem/material/cone_matching.hpp"
#include "fem/material/elastoplastic.hpp"
#include "fem/material/mobilised.hpp"
#include "tests/verification/elastoplastic_biaxial.hpp"

namespace polargrain::fem::test {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kLateralStress = -100e3;

struct Strength {
  MohrCoulomb mohr_coulomb;
  InvariantWeights weights;
};

class PlaneStrainLimit : public ::testing::TestWithParam<Strength> {};

TEST_P(PlaneStrainLimit, CollapsesAtTheMatchedAngles) {
  const auto& [strength, weights] = GetParam();
  const FrozenCone cone = cone_from_plane_strain(strength);
  ElastoplasticParameters<2> sand;
  sand.elastic.young_modulus = 50e6;
  sand.elastic.poisson_ratio = 0.3;
  sand.elastic.cosserat_shear_modulus = 10e6;
  sand.elastic.internal_length = 1e-3;
  sand.elastic.initial_stress << kLateralStress, kLateralStress, kLateralStress, 0.0, 0.0, 0.0, 0.0;
  sand.weights = weights;
  sand.cone = {cone.friction, cone.dilatancy, cone.cohesion};
  const ElastoplasticLaw<2> law(sand);

  ElastoplasticState<2> state = law.initial_state();
  ElastoplasticState<2> trial;
  Increment<2> increment;
  Response<2> response;
  for (int step = 0; step < 400; ++step) {
    increment = biaxial_step(-1e-3, kLateralStress, [&](const Increment<2>& guess) {
      response = law.integrate(state, guess, trial);
      return response;
    });
    state = trial;
  }
  const Vector7& s = response.stress;
  const double sin_phi = std::sin(strength.friction_angle * kDegree);
  const double cos_phi = std::cos(strength.friction_angle * kDegree);
  // Vertical stress at collapse: -s22 (1 - sin) = -s11 (1 + sin) + 2 c cos.
  const double expected =
      (kLateralStress * (1.0 + sin_phi) - 2.0 * strength.cohesion * cos_phi) / (1.0 - sin_phi);
  const double stress_error = std::abs(s(k22) / expected - 1.0);
  // In the plane: d eps_v / d gamma_max of the last increment, all plastic when the stress stands still.
  const auto& h = increment.displacement_gradient;
  const double sin_psi = (h(0, 0) + h(1, 1)) / (h(0, 0) - h(1, 1));
  const double dilatancy_error = std::abs(sin_psi - std::sin(strength.dilatancy_angle * kDegree));
  const double q = cone.cohesion - cone.friction * s.head<3>().sum() / 3.0;
  const double out_of_plane = std::abs(s(k33) - s.head<3>().sum() / 3.0 + 2.0 / 9.0 * cone.dilatancy * q) / q;
  std::cout << "[figure] phi " << strength.friction_angle << " psi " << strength.dilatancy_angle << " c "
            << strength.cohesion << ": s22 error " << stress_error << ", sin psi error " << dilatancy_error
            << ", s33 error " << out_of_plane << '\n';
  // The out-of-plane stress approaches its limit exponentially in the strain; 40 % leave less than this.
  EXPECT_LE(stress_error, 1e-6);
  EXPECT_LE(dilatancy_error, 1e-6);
  EXPECT_LE(out_of_plane, 1e-6);

  // The plastic strain that a cell of discs would show of this state gives the cone back.
  const ScaledVector<double> plastic = increment.strain();
  const auto read = mobilised_in_plane(state.scaled_stress, plastic);
  ASSERT_TRUE(read);
  if (strength.cohesion == 0.0) {
    EXPECT_NEAR(read->friction, cone.friction, 1e-5);
    EXPECT_NEAR(read->dilatancy, cone.dilatancy, 1e-5);
    EXPECT_FALSE(read->clipped);
  }
}

INSTANTIATE_TEST_SUITE_P(Strengths, PlaneStrainLimit,
                         ::testing::Values(Strength{{40.0, 10.0, 0.0}, {}}, Strength{{30.0, 0.0, 0.0}, {}},
                                           Strength{{35.0, 35.0, 0.0}, {}}, Strength{{30.0, -10.0, 0.0}, {}},
                                           Strength{{25.0, 5.0, 20e3}, {}}, Strength{{0.0, 0.0, 50e3}, {}},
                                           Strength{{48.0, 15.0, 1e3}, {0.75, -0.25, 0.125}}),
                         [](const auto& info) { return "case" + std::to_string(info.index); });

}  // namespace
}  // namespace polargrain::fem::test
