// SPDX-License-Identifier: GPL-2.0-or-later
// The cone in space: tangent by complex steps, frame, plane strain against the plane's law, strengths in closed form.
#include <gtest/gtest.h>

#include <complex>
#include <numbers>
#include <random>

#include "fem/material/cone_matching.hpp"
#include "fem/material/elastoplastic.hpp"
#include "fem/material/polar_decomposition.hpp"

using namespace polargrain;
using namespace polargrain::fem;

namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

ElastoplasticParameters<3> sand(double trace = 0.0, double transpose = 0.0,
                                const InvariantWeights& weights = {}) {
  ElastoplasticParameters<3> made;
  made.elastic.young_modulus = 40e6;
  made.elastic.poisson_ratio = 0.25;
  made.elastic.cosserat_shear_modulus = 12e6;
  made.elastic.internal_length = 2e-3;
  made.elastic.couple_trace_ratio = trace;
  made.elastic.couple_transpose_ratio = transpose;
  for (int i = 0; i < 3; ++i) made.elastic.initial_stress(Cosserat<3>::stress_place(i, i)) = -100e3;
  made.weights = weights;
  made.cone = {PiecewiseLinear::ramp(0.9, 1.2, 0.05), PiecewiseLinear::ramp(0.5, 0.1, 0.05), 2e3};
  return made;
}

template <int dim>
ElastoplasticParameters<2> in_the_plane(const ElastoplasticParameters<dim>& of) {
  ElastoplasticParameters<2> made;
  made.elastic.young_modulus = of.elastic.young_modulus;
  made.elastic.poisson_ratio = of.elastic.poisson_ratio;
  made.elastic.cosserat_shear_modulus = of.elastic.cosserat_shear_modulus;
  made.elastic.internal_length = of.elastic.internal_length;
  made.elastic.initial_stress << -100e3, -100e3, -100e3, 0.0, 0.0, 0.0, 0.0;
  made.weights = of.weights;
  made.cone = of.cone;
  return made;
}

using Complex = std::complex<double>;

struct Variant {
  const char* name;
  double trace, transpose;
  InvariantWeights weights;
};
const std::vector<Variant> kVariants{{"default", 0.0, 0.0, {}},
                                     {"other weights", 0.0, 0.0, {0.5, 0.0, 1.0}},
                                     {"beta = gamma / 2", 0.1, 0.5, {0.4, 0.1, 0.7}},
                                     {"beta = gamma", 0.0, 1.0, {}},
                                     {"conformal", -2.0 / 3.0, 1.0, {0.375, 0.125, 0.25}},
                                     {"-1/4", -0.25, -0.25, {}}};

// 200 random states a variant: as exact as the return itself, on the side of the cone and at its tip.
TEST(ConeInSpace, TangentIsTheComplexStep) {
  constexpr double kStep = 1e-30;
  for (const Variant& variant : kVariants) {
    const ElastoplasticParameters<3> of = sand(variant.trace, variant.transpose, variant.weights);
    const SubspaceModuli moduli(of.elastic, of.weights);
    std::mt19937 random(11);
    std::normal_distribution<double> normal;
    int smooth = 0;
    int apex = 0;
    for (int state = 0; state < 200; ++state) {
      ScaledVector<double, 3> strain;
      for (double& e : strain) e = 4e-3 * normal(random);
      if (state % 4 == 0)
        for (int i = 0; i < 3; ++i) strain(Cosserat<3>::stress_place(i, i)) += 8e-3;
      const double scale = 1e-2 * std::abs(normal(random));
      const auto stress_of = [&](const auto& e) {
        using Scalar = typename std::decay_t<decltype(e)>::Scalar;
        ScaledVector<Scalar, 3> trial = elastic_stress(moduli, ScaledVector<Scalar, 3>(e));
        trial += of.elastic.initial_stress.template cast<Scalar>();
        return std::pair(trial, return_to_cone(trial, Scalar(scale), moduli, of.cone));
      };
      const auto [trial, end] = stress_of(strain);
      ASSERT_EQ(end.fault, ReturnFault::none);
      smooth += end.regime == Regime::smooth ? 1 : 0;
      apex += end.regime == Regime::apex ? 1 : 0;
      const auto tangent = consistent_tangent(trial, end, moduli);
      Matrix18 by_steps;
      for (int column = 0; column < 18; ++column) {
        ScaledVector<Complex, 3> stepped = strain.cast<Complex>();
        stepped(column) += Complex(0.0, kStep);
        by_steps.col(column) = stress_of(stepped).second.stress.imag() / kStep;
      }
      // The return is solved to 1e-13 of the stress, which its derivative feels once more.
      EXPECT_LT((tangent - by_steps).norm(), 1e-10 * elastic_stiffness<3>(moduli).norm())
          << variant.name << state;
    }
    EXPECT_GT(smooth, 100) << variant.name;
    EXPECT_GT(apex, 3) << variant.name;
  }
}

TEST(ConeInSpace, TurnsWithItsFrame) {
  const ElastoplasticLaw<3> law(sand(0.1, 0.5));
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (int state = 0; state < 50; ++state) {
    Vector18 strain;
    for (int i = 0; i < 18; ++i) strain(i) = (i < 9 ? 4e-3 : 2.0) * normal(random);
    const Eigen::Matrix3d turn = rotation_by(Eigen::Vector3d(normal(random), normal(random), normal(random)));
    ElastoplasticLaw<3>::State end;
    ElastoplasticLaw<3>::State turned_end;
    const Response<3> here = rotated<3>(law.integrate(law.initial_state(), strain, end), turn);
    const Response<3> there = law.integrate(law.initial_state(), rotated(strain, turn), turned_end);
    EXPECT_LT((here.stress - there.stress).norm(), 1e-12 * here.stress.norm());
    EXPECT_LT((here.tangent - there.tangent).norm(), 1e-11 * here.tangent.norm());
  }
}

// m_3i = beta kappa_i does no work in the plane, and the measure of couples is made so that it does not count.
TEST(ConeInSpace, IsThePlanesLawInPlaneStrain) {
  constexpr std::array<int, 7> places{0, 4, 8, 1, 3, 11, 14};
  for (const Variant& variant : kVariants) {
    const ElastoplasticParameters<3> of = sand(variant.trace, variant.transpose, variant.weights);
    const ElastoplasticLaw<3> space(of);
    const ElastoplasticLaw<2> plane(in_the_plane(of));
    std::mt19937 random(5);
    std::normal_distribution<double> normal;
    for (int path = 0; path < 40; ++path) {
      auto in_space = space.initial_state();
      auto in_plane = plane.initial_state();
      for (int step = 0; step < 5; ++step) {
        Vector7 strain;
        for (int i = 0; i < 7; ++i) strain(i) = i == k33 ? 0.0 : (i < 5 ? 1e-3 : 0.5) * normal(random);
        Vector18 embedded = Vector18::Zero();
        embedded(places) = strain;
        const auto from_space = in_space;
        const auto from_plane = in_plane;
        const Response<3> a = space.integrate(from_space, embedded, in_space);
        const Response<2> b = plane.integrate(from_plane, strain, in_plane);
        ASSERT_EQ(a.quality, b.quality);
        EXPECT_LT((Vector7(a.stress(places)) - b.stress).norm(), 1e-11 * b.stress.norm()) << variant.name;
        EXPECT_LT((Matrix7(a.tangent(places, places)) - b.tangent).norm(), 1e-9 * b.tangent.norm())
            << variant.name;
      }
    }
  }
}

/// Friction angle (degrees) that a perfectly plastic cone without dilatancy and cohesion shows behind a long strain path that
/// keeps the mean stress.
double angle_along(const FrozenCone& cone, const Eigen::Vector3d& direction) {
  ElastoplasticParameters<3> of = sand();
  of.cone = {cone.friction, 0.0, 0.0};
  const ElastoplasticLaw<3> law(of);
  auto state = law.initial_state();
  Response<3> answer;
  for (int step = 0; step < 40; ++step) {
    Vector18 strain = Vector18::Zero();
    for (int i = 0; i < 3; ++i) strain(Cosserat<3>::stress_place(i, i)) = 5e-3 * direction(i);
    const auto from = state;
    answer = law.integrate(from, strain, state);
  }
  const Eigen::Vector3d s(answer.stress(0), answer.stress(4), answer.stress(8));
  return std::asin((s.maxCoeff() - s.minCoeff()) / -(s.maxCoeff() + s.minCoeff())) * kDegrees;
}

TEST(ConeInSpace, HasTheStrengthItWasMatchedTo) {
  const Eigen::Vector3d compression(-1.0, 0.5, 0.5);
  const Eigen::Vector3d extension(1.0, -0.5, -0.5);
  const Eigen::Vector3d plane(-1.0, 1.0, 0.0);
  for (const double angle : {15.0, 25.0, 30.0, 36.0}) {
    const MohrCoulomb strength{angle, 0.0, 0.0};
    EXPECT_NEAR(angle_along(cone_from_triaxial_compression(strength), compression), angle, 1e-8);
    EXPECT_NEAR(angle_along(cone_from_triaxial_extension(strength), extension), angle, 1e-8);
    EXPECT_NEAR(angle_along(cone_from_plane_strain(strength), plane), angle, 1e-8);
  }
  // A compression cone of 30 degrees has 48.6 degrees in extension and 43.9 in plane strain.
  const FrozenCone cone = cone_from_triaxial_compression({30.0, 0.0, 0.0});
  EXPECT_NEAR(angle_along(cone, extension), 48.59, 0.01);
  EXPECT_NEAR(angle_along(cone, plane), 43.9, 0.05);
}

}  // namespace
