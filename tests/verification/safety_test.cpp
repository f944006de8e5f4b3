// SPDX-License-Identifier: GPL-2.0-or-later
// Factor of safety by strength reduction against closed forms.
#include "app/safety/safety.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <iostream>
#include <numbers>

#include "common/error.hpp"

namespace polargrain::app {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

class SafetyOfCase : public ::testing::Test {
 protected:
  SafetyOfCase()
      : directory_(std::filesystem::temp_directory_path() / ("safety_test." + std::to_string(getpid()))) {
    std::filesystem::create_directories(directory_);
  }
  ~SafetyOfCase() override { std::filesystem::remove_all(directory_); }

  Safety of(const std::string& text) {
    SafetyOptions options;
    options.case_file = directory_ / "case.yaml";
    std::ofstream(options.case_file) << text;
    return factor_of_safety(coupler::read_case(options.case_file), options);
  }

 private:
  std::filesystem::path directory_;
};

/// A slope that goes on for ever, in axes along it and across.
struct InfiniteSlope {
  double beta, phi, psi, cohesion;
  double height = 4.0;
  double unit_weight = 20e3;

  /// Davis (1968): shear strength on planes along the slope with the flow rule of psi.
  [[nodiscard]] double exact() const {
    const auto margin = [&](double factor) {
      const double tan_phi = std::tan(phi * kDegree) / factor;
      const double angle = std::atan(tan_phi);
      const double dilatancy = std::min(psi * kDegree, angle);
      const double share =
          std::cos(angle) * std::cos(dilatancy) / (1.0 - std::sin(angle) * std::sin(dilatancy));
      const double normal = unit_weight * height * std::cos(beta * kDegree) * std::cos(beta * kDegree);
      return share * (cohesion / factor + normal * tan_phi) - normal * std::tan(beta * kDegree);
    };
    double low = 0.5;
    double high = 5.0;
    while (high - low > 1e-9) (margin(0.5 * (low + high)) > 0.0 ? low : high) = 0.5 * (low + high);
    return low;
  }

  [[nodiscard]] std::string text() const {
    const double normal = height * std::cos(beta * kDegree);
    return "title: A slope without an end\n"
           "continuum: cauchy\n"
           "mesh: {rectangle: {size: [0.5 m, " +
           std::to_string(normal) +
           " m], elements: [1, 8]}}\n"
           "materials:\n"
           "  soil: {model: elastoplastic, E: 20 MPa, nu: 0.3, friction_angle: " +
           std::to_string(phi) + " deg, dilatancy_angle: " + std::to_string(psi) +
           " deg, cohesion: " + std::to_string(cohesion) +
           " Pa}\n"
           "regions: {all: soil}\n"
           "boundary:\n"
           "  - {on: left, tie: right}\n"
           "  - {on: bottom, fix: [u1, u2]}\n"
           "body: [{force: [" +
           std::to_string(unit_weight * std::sin(beta * kDegree)) + " N/m3, " +
           std::to_string(-unit_weight * std::cos(beta * kDegree)) +
           " N/m3], factor: [[0, 0], [1, 1]]}]\n"
           "steps: {count: 10, tolerance: 1e-6, iterations: 40}\n";
  }
};

class EverySlope : public SafetyOfCase, public testing::WithParamInterface<InfiniteSlope> {};

TEST_P(EverySlope, fails_at_the_factor_of_davis) {
  const double exact = GetParam().exact();
  const Safety found = of(GetParam().text());
  std::cout << "[figure] infinite slope: exact " << exact << ", between " << found.stands << " and "
            << found.fails << '\n';
  ASSERT_GT(found.fails, 0.0);
  EXPECT_LE(found.fails - found.stands, 0.01);
  // The bracket of 0.01, and 0.5 % for the column of eight elements.
  EXPECT_GT(found.fails, exact * (1 - 0.005));
  EXPECT_LT(found.stands, exact * (1 + 0.005));
}

INSTANTIATE_TEST_SUITE_P(Slopes, EverySlope,
                         ::testing::Values(InfiniteSlope{20, 30, 0, 1e3}, InfiniteSlope{20, 30, 30, 1e3},
                                           InfiniteSlope{20, 30, 10, 4e3}));

TEST(InfiniteSlope, has_the_factors_of_an_independent_program) {
  EXPECT_NEAR((InfiniteSlope{20, 30, 0, 1e3}.exact()), 1.519138, 1e-6);
  EXPECT_NEAR((InfiniteSlope{20, 30, 90, 1e3}.exact()), 1.625150, 1e-6);
  EXPECT_NEAR((InfiniteSlope{20, 30, 10, 4e3}.exact()), 1.721381, 1e-6);
}

// A strong block, or one without any limit, that slides on its base: 200 kN tan(20 deg) / 36.4 kN. The strong one alone would
// bear twice as much.
TEST_F(SafetyOfCase, of_a_block_is_that_of_the_interface_below_it) {
  const double exact = 200.0 * std::tan(20.0 * kDegree) / 36.4;
  for (const std::string model :
       {"elastoplastic, friction_angle: 35 deg, dilatancy_angle: 0 deg, cohesion: 200 kPa", "elastic"}) {
    const Safety found =
        of("title: A block on a rough floor\n"
           "continuum: cauchy\n"
           "mesh: {rectangle: {size: [2 m, 1 m], elements: [4, 2]}}\n"
           "materials: {clay: {E: 50 MPa, nu: 0.3, model: " +
           model +
           "}}\n"
           "regions: {all: clay}\n"
           "interfaces: {base: {on: bottom, friction: 20 deg}}\n"
           "boundary:\n"
           "  - {on: base, fix: [u1, u2]}\n"
           "  - {on: top, traction: {u2: -80 kPa}}\n"
           "body: [{force: [3.64 kN/m3, 0], factor: [[0, 0], [1, 5]]}, {unit_weight: 20 kN/m3}]\n"
           "steps: {count: 4, tolerance: 1e-5}\n");
    std::cout << "[figure] block on an interface, " << model << ": exact " << exact << ", between "
              << found.stands << " and " << found.fails << '\n';
    EXPECT_LE(found.stands, exact * 1.005) << model;
    EXPECT_GE(found.fails, exact * 0.995) << model;
  }
}

// A footing that is pushed down holds the ground below it, which then stands at any strength.
TEST_F(SafetyOfCase, of_a_body_that_a_movement_holds_is_refused) {
  const std::string footing =
      "title: A footing pushed down\n"
      "continuum: cauchy\n"
      "mesh: {rectangle: {size: [4 m, 2 m], elements: [4, 2], lines: {footing: [0, 2 m, 1 m, 2 m]}}}\n"
      "materials: {soil: {model: elastoplastic, E: 20 MPa, nu: 0.3, friction_angle: 25 deg, dilatancy_angle: 0 deg, "
      "cohesion: 10 kPa}}\n"
      "regions: {all: soil}\n"
      "boundary:\n"
      "  - {on: [left, right], fix: [u1]}\n"
      "  - {on: bottom, fix: [u1, u2]}\n"
      "  - {on: footing, move: {u2: -2 mm}}\n"
      "steps: {count: 1, tolerance: 1e-4}\n";
  try {
    (void)of(footing);
    FAIL() << "a footing that is held has a factor of safety";
  } catch (const InputError& error) {
    ASSERT_EQ(error.faults().size(), 1U);
    EXPECT_EQ(error.faults().front().message.substr(0, 60),
              "boundary: 'footing' is moved, and would hold the body while ");
  }
}

TEST_F(SafetyOfCase, of_grains_is_refused_by_name) {
  // Without strength, and without anything that could fail.
  std::string text = InfiniteSlope{20, 30, 0, 1e3}.text();
  const std::size_t begin = text.find("{model");
  text.replace(begin, text.find('}', begin) - begin + 1, "{model: elastic, E: 20 MPa, nu: 0.3}");
  try {
    (void)of(text);
    FAIL() << "an elastic slope has a factor of safety";
  } catch (const InputError& error) {
    EXPECT_EQ(error.faults().front().message,
              "no material or interface of the case has a strength that could be reduced");
  }
}

}  // namespace
}  // namespace polargrain::app
