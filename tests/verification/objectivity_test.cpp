// SPDX-License-Identifier: GPL-2.0-or-later
// Large deformation is objective: a body that is turned while it is strained ends with the stress of the straight one,
// turned. Every model and every element, in steps of 1.5 to 72 degrees.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "coupler/adaptivity/adaptive_material.hpp"
#include "coupler/cells/informed_material.hpp"
#include "fem/material/elastic.hpp"
#include "fem/material/elastoplastic.hpp"
#include "fem/material/local_material.hpp"
#include "tests/support/turned_block.hpp"

namespace polargrain::fem {
namespace {

using testing::Path;
using testing::TurningSand;

/// @param limited skew and couple stress have the limits of a packing
std::shared_ptr<Material<2>> material_of(const std::string& model, const TurningSand& sand,
                                         bool limited = false) {
  ElasticParameters<2> elastic = testing::elasticity();
  elastic.internal_length = 0.02;
  if (model == "elastic") return std::make_shared<LocalMaterial<ElasticLaw<2>>>(ElasticLaw<2>(elastic));
  if (model == "elastoplastic")
    return std::make_shared<LocalMaterial<ElastoplasticLaw<2>>>(
        ElastoplasticLaw<2>({elastic, {}, testing::micro_strength()}));
  const double g = elastic.young_modulus / (2.0 * (1.0 + elastic.poisson_ratio));
  coupler::CosseratParameters cosserat{g, elastic.cosserat_shear_modulus, elastic.internal_length};
  if (limited) {
    cosserat.plastic_length = 0.004;
    cosserat.skew_limit = 1.0;
  }
  if (model == "adaptive, a cell a point") {
    coupler::AdaptivityOptions options;
    options.tolerance = 0.0;
    return std::make_shared<coupler::AdaptiveMaterial<2>>(sand.calls(), cosserat, options);
  }
  coupler::InformedParameters<2> informed;
  informed.elastic = elastic;
  informed.plastic_length = cosserat.plastic_length;
  informed.skew_limit = cosserat.skew_limit;
  informed.mobilisation.cohesion = testing::kCohesion;
  informed.mobilisation.initial_friction = 0.4;
  informed.mismatch_limit = 10.0;
  if (model == "informed, fixed point") informed.update = coupler::InformedUpdate::fixed_point;
  if (model == "informed, left") {
    informed.mismatch_limit = 0.02;
    informed.beyond_mismatch = coupler::BeyondMismatch::cell;
  }
  return std::make_shared<coupler::InformedMaterial<2>>(sand.calls(), informed, "", sand.calls());
}

const std::vector<std::string> kModels{
    "elastic",          "elastoplastic",         "adaptive, a cell a point",
    "informed, frozen", "informed, fixed point", "informed, left"};

double error_of_turning(const std::string& model, const std::string& element, const Path& path, double angle,
                        int steps) {
  const TurningSand sand;
  const auto run = [&](double turn) {
    return testing::turned_block(material_of(model, sand), {element}, path, turn, steps);
  };
  const std::vector<Response<2>> straight = run(0.0);
  return testing::error_of_turning(straight, run(angle), angle);
}

Path sheared() {
  Path path;
  path.gradient << 0.01, 0.015, -0.005, -0.02;
  path.bulge = 0.05;
  path.relative_rotation = 0.01;
  return path;
}

/// The error within the tolerance of the balance; before, a quarter turn in 20 steps was off by 2e-2.
constexpr double kExact = 1e-7;

TEST(Objectivity, EveryModelAndEveryElementTurnedByAQuarterIn20Steps) {
  for (const std::string& model : kModels) {
    for (const std::string& element : element_names<2>()) {
      const double error = error_of_turning(model, element, sheared(), 0.5 * M_PI, 20);
      std::cout << "[figure] " << model << ", " << element << ", 90 degrees in 20 steps: " << error << '\n';
      EXPECT_LT(error, kExact) << model << ' ' << element;
    }
  }
}

TEST(Objectivity, TurnsOf30To360DegreesInSteps) {
  struct Turn {
    double degrees;
    int steps;
  };
  for (const std::string& model : kModels) {
    for (const Turn& turn : {Turn{30.0, 5}, Turn{30.0, 20}, Turn{90.0, 5}, Turn{360.0, 20}}) {
      const double error = error_of_turning(model, "Q8R", sheared(), turn.degrees * M_PI / 180.0, turn.steps);
      std::cout << "[figure] " << model << ", " << turn.degrees << " degrees in " << turn.steps
                << " steps: " << error << '\n';
      EXPECT_LT(error, kExact) << model << ' ' << turn.degrees << ' ' << turn.steps;
    }
  }
  // 72 degrees a step: beyond elasticity Newton's method does not get there in one go.
  EXPECT_LT(error_of_turning("elastic", "Q8R", sheared(), 2.0 * M_PI, 5), kExact);
}

/// One element strained until points are at the limits of skew and couple stress, and one nearly parts, while it turns.
/// Only its displacements are given.
double error_with_free_rotations(const std::string& model, const std::string& element, bool limited,
                                 double degrees, int steps, const Path& path) {
  const TurningSand sand;
  const auto run = [&](double turn) {
    return testing::turned_block(material_of(model, sand, limited), {element, 1, 1e-10, true}, path, turn,
                                 steps);
  };
  const double angle = degrees * M_PI / 180.0;
  const double error = testing::error_of_turning(run(0.0), run(angle), angle);
  std::cout << "[figure] " << model << ", " << element << (limited ? ", limited" : "") << ", free rotations, "
            << degrees << " degrees in " << steps << " steps: " << error << '\n';
  return error;
}

Path towards_the_limits() {
  Path path;
  path.gradient << 0.004, 0.003, 0.003, -0.01;
  path.bulge = 0.05;
  return path;
}

// Before, an element at its limits turned by 6 degrees a step ended with 0.37 of the stress off, and no word of it: the
// rotations had gone to 1e13 rad, at whose rounding any imbalance passed.
TEST(Objectivity, FreeRotationsAtTheLimitsOfTheGrains) {
  for (const std::string& model : kModels) {
    for (const bool limited : {false, true}) {
      for (const double degrees : {30.0, 90.0, 360.0}) {
        for (const int steps : {5, 10, 20, 40, 80}) {
          if (degrees / steps > 20.0) continue;  // refused, or not reached: below
          EXPECT_LT(error_with_free_rotations(model, "Q8R", limited, degrees, steps, towards_the_limits()),
                    kExact)
              << model << ' ' << limited << ' ' << degrees << ' ' << steps;
        }
      }
    }
  }
}

// At 4.5 degrees a step. A point that leaves its law does so where a mismatch passes its limit: a step earlier or later.
TEST(Objectivity, FreeRotationsOfEveryElement) {
  Path other = towards_the_limits();
  other.gradient << -0.012, -0.004, 0.002, 0.005;
  other.bulge = -0.03;
  for (const std::string& model : kModels) {
    const double bound = model == "informed, left" ? 1e-3 : kExact;
    for (const std::string& element : element_names<2>())
      for (const Path& path : {towards_the_limits(), other})
        for (const int steps : {20, 80})
          EXPECT_LT(error_with_free_rotations(model, element, true, 4.5 * steps, steps, path), bound)
              << model << ' ' << element << ' ' << steps;
  }
}

// A law far from its skew strain has other balances: 0.43 of the stress was off at 72 degrees a step.
TEST(Objectivity, InformedRefusesToTurnByMoreThanHalfARadian) {
  const TurningSand sand;
  const std::shared_ptr<Material<2>> material = material_of("informed, frozen", sand);
  material->allocate(1);
  Increment<2> turn;
  std::vector<Response<2>> answer(1);
  for (const double angle : {0.49, 0.51}) {
    turn.configuration = Configuration::start;
    turn.displacement_gradient << std::cos(angle) - 1.0, -std::sin(angle), std::sin(angle),
        std::cos(angle) - 1.0;
    turn.micro_rotation = angle;
    material->evaluate(std::vector<Increment<2>>{turn}, answer);
    EXPECT_EQ(answer[0].quality, angle < 0.5 ? Quality::good : Quality::failed) << answer[0].message;
  }
  EXPECT_EQ(answer[0].message, "the step turns the point by 0.51 rad at once; at most 0.5 is taken");
}

// Against the rate itself, in which nothing is assumed of how a step is split: Jaumann's rate of an elastic law. Simple
// shear has a closed form (Dienes 1979): s12 = G sin(shear), s11 = -s22 = G (1 - cos(shear)).
TEST(Objectivity, SimpleShearIsOfSecondOrderAgainstTheRate) {
  const ElasticParameters<2> parameters{1e6, 0.3, 1e5, 0.01};
  const double g = 1e6 / 2.6;
  constexpr double kShear = 1.5;
  double before = 0.0;
  for (const int steps : {10, 20, 40, 80}) {
    LocalMaterial<ElasticLaw<2>> material{ElasticLaw<2>(parameters)};
    material.allocate(1);
    Increment<2> increment;  // about the start of the step: simple shear over simple shear adds up
    increment.displacement_gradient << 0.0, kShear / steps, 0.0, 0.0;
    increment.configuration = Configuration::start;
    increment.micro_rotation = std::atan2(-kShear / steps, 2.0);  // with the continuum: no skew strain
    std::vector<Response<2>> answer(1);
    for (int step = 0; step < steps; ++step) {
      material.evaluate(std::vector<Increment<2>>{increment}, answer);
      material.commit();
    }
    const Vector7& s = answer[0].stress;
    Eigen::Matrix2d error;
    error << s(k11) - g * (1.0 - std::cos(kShear)), s(k12) - g * std::sin(kShear),
        s(k21) - g * std::sin(kShear), s(k22) + g * (1.0 - std::cos(kShear));
    const double relative = error.norm() / g;
    std::cout << "[figure] simple shear of " << kShear << " in " << steps << " steps: error " << relative
              << " of G\n";
    if (before > 0.0) {
      EXPECT_NEAR(before / relative, 4.0, 0.1);
    }
    before = relative;
  }
  EXPECT_LT(before, 1e-4);
}

}  // namespace
}  // namespace polargrain::fem
