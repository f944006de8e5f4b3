// SPDX-License-Identifier: GPL-2.0-or-later
// Functions of our own against those of the system, and their bits against those of another processor.
#include "common/elementary_functions.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>
#include <random>

using namespace polargrain;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

using Function = std::function<double(double)>;

double uniform(std::mt19937_64& random) {
  return static_cast<double>(random() >> 11) * 0x1p-53;
}

/// Units in the last place between two doubles of one sign.
std::int64_t units_apart(double a, double b) {
  return std::abs(std::bit_cast<std::int64_t>(a) - std::bit_cast<std::int64_t>(b));
}

/// The system's functions err by less than one unit, so that a right function is at most one unit away, and
/// that seldom.
void expect_same(const char* name, const Function& own, const Function& system, double from, double to,
                 double seldom = 0.1) {
  std::mt19937_64 random(1);
  std::int64_t largest = 0;
  int differing = 0;
  constexpr int kArguments = 100000;
  for (int k = 0; k < kArguments; ++k) {
    const double x = from + (to - from) * uniform(random);
    const std::int64_t apart = units_apart(own(x), system(x));
    largest = std::max(largest, apart);
    if (apart > 0) ++differing;
  }
  EXPECT_LE(largest, 1) << name << " from " << from << " to " << to;
  EXPECT_LT(differing, seldom * kArguments) << name << " from " << from << " to " << to;
}

TEST(elementary_functions, are_those_of_the_system_to_the_last_place) {
  for (const double range : {1e-3, 1.0, 10.0, 1e5, 1e9}) {
    expect_same(
        "sin", sine, [](double x) { return std::sin(x); }, -range, range);
    expect_same(
        "cos", cosine, [](double x) { return std::cos(x); }, -range, range);
    expect_same(
        "atan", [](double x) { return arc_tangent(x); }, [](double x) { return std::atan(x); }, -range,
        range);
    expect_same(
        "atan2", [](double x) { return arc_tangent(x, -3.0); }, [](double x) { return std::atan2(x, -3.0); },
        -range, range);
    expect_same(
        "log", logarithm, [](double x) { return std::log(x); }, 0.0, range);
  }
  expect_same(
      "log", logarithm, [](double x) { return std::log(x); }, 0.99, 1.01);
  for (const double range : {1e-3, 1.0, 50.0, 700.0})
    expect_same(
        "exp", exponential, [](double x) { return std::exp(x); }, -range, range);
  expect_same(
      "asin", arc_sine, [](double x) { return std::asin(x); }, -1.0, 1.0);
  expect_same(
      "acos", arc_cosine, [](double x) { return std::acos(x); }, -1.0, 1.0);
  for (const double exponent : {0.2, -1.0, 2.0, -0.5, 30.0})
    expect_same(
        "pow", [=](double x) { return power(x, exponent); }, [=](double x) { return std::pow(x, exponent); },
        0.0, 10.0);
}

TEST(elementary_functions, complementary_error_function_is_right) {
  for (double x = -6.0; x < 25.0; x += 0.0137)
    EXPECT_NEAR(complementary_error_function(x) / std::erfc(x), 1.0, 1e-14) << x;
  EXPECT_EQ(complementary_error_function(0.0), 1.0);
  EXPECT_EQ(complementary_error_function(100.0), 0.0);
  EXPECT_EQ(complementary_error_function(-kInfinity), 2.0);
}

TEST(elementary_functions, hard_and_special_arguments) {
  // The double nearest to a multiple of pi / 2: almost all bits of the argument cancel.
  for (const double quarters : {1.0, 2.0, 1e3, 12345.0, 63661.0, 6e8}) {
    const double x = quarters * std::numbers::pi / 2.0;
    EXPECT_LE(units_apart(sine(x), std::sin(x)), 1) << x;
    EXPECT_LE(units_apart(cosine(x), std::cos(x)), 1) << x;
  }
  for (const double x : {0.0, -0.0, 1e-310, -5e-324}) {
    EXPECT_EQ(std::bit_cast<std::uint64_t>(sine(x)), std::bit_cast<std::uint64_t>(x));
    EXPECT_EQ(std::bit_cast<std::uint64_t>(arc_tangent(x)), std::bit_cast<std::uint64_t>(x));
    EXPECT_EQ(std::bit_cast<std::uint64_t>(arc_sine(x)), std::bit_cast<std::uint64_t>(x));
    EXPECT_EQ(exponential(x), 1.0);
  }
  EXPECT_TRUE(std::isnan(sine(kInfinity)) && std::isnan(cosine(kNotANumber)) &&
              std::isnan(exponential(kNotANumber)));
  EXPECT_EQ(exponential(1000.0), kInfinity);
  EXPECT_EQ(exponential(-kInfinity), 0.0);
  EXPECT_EQ(exponential(-740.0), std::exp(-740.0));  // subnormal
  EXPECT_EQ(logarithm(0.0), -kInfinity);
  EXPECT_EQ(logarithm(1.0), 0.0);
  EXPECT_EQ(logarithm(kInfinity), kInfinity);
  EXPECT_TRUE(std::isnan(logarithm(-1.0)) && std::isnan(arc_sine(1.1)) && std::isnan(arc_cosine(-1.1)));
  EXPECT_EQ(arc_cosine(1.0), 0.0);
  EXPECT_EQ(arc_cosine(-1.0), std::numbers::pi);
}

TEST(elementary_functions, corners_are_those_of_the_system) {
  const double corners[] = {0.0,  -0.0, 1.0,  -1.0, 2.0,       -2.0,       0.5,
                            -0.5, 3.0,  -3.0, 7.0,  kInfinity, -kInfinity, kNotANumber};
  for (const double a : corners)
    for (const double b : corners) {
      if (const double expected = std::pow(a, b); std::isnan(expected))
        EXPECT_TRUE(std::isnan(power(a, b))) << a << "^" << b;
      else
        EXPECT_EQ(std::bit_cast<std::uint64_t>(power(a, b)), std::bit_cast<std::uint64_t>(expected))
            << a << "^" << b;
      if (std::isnan(a) || std::isnan(b) || (std::isinf(a) && std::isinf(b))) continue;
      EXPECT_EQ(std::bit_cast<std::uint64_t>(arc_tangent(a, b)),
                std::bit_cast<std::uint64_t>(std::atan2(a, b)))
          << a << ", " << b;
    }
}

/// Folds the bits of every result into one number. The expected one was computed on an AMD EPYC of 2023.
TEST(elementary_functions, have_the_bits_of_every_processor) {
  std::mt19937_64 random(7);
  std::uint64_t folded = 0;
  const auto fold = [&folded](double value) {
    folded = (folded ^ std::bit_cast<std::uint64_t>(value)) * 0x100000001b3;
  };
  for (int k = 0; k < 100000; ++k) {
    const double x = 20.0 * uniform(random) - 10.0;
    const double y = uniform(random);
    const auto [sine, cosine] = sine_and_cosine(x);
    for (const double value :
         {sine, cosine, arc_tangent(x), arc_tangent(x, y - 0.5), arc_sine(y), arc_cosine(y), exponential(x),
          logarithm(y), power(y, x), complementary_error_function(x)})
      fold(value);
  }
  EXPECT_EQ(folded, 4287232211931986474u);
}

}  // namespace
