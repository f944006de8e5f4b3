// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/output/stress_measures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace polargrain::fem {
namespace {

/// Below this share of the stresses a sum of them is rounding.
constexpr double kRounding = 64.0 * std::numeric_limits<double>::epsilon();

}  // namespace

StressMeasures measures_of(const Vector7& stress) {
  StressMeasures found;
  const double shear = 0.5 * (stress(k12) + stress(k21));
  const double largest = std::max(stress.head<3>().cwiseAbs().maxCoeff(), std::abs(shear));
  const double mean = (stress(k11) + stress(k22) + stress(k33)) / 3.0;
  found.pressure = -mean;
  double square = 2.0 * shear * shear;
  for (const int i : {k11, k22, k33}) square += (stress(i) - mean) * (stress(i) - mean);
  found.deviatoric = std::sqrt(1.5 * square);
  if (found.pressure > kRounding * largest) found.ratio = found.deviatoric / found.pressure;

  const double centre = 0.5 * (stress(k11) + stress(k22));
  const double radius = std::hypot(0.5 * (stress(k11) - stress(k22)), shear);
  found.principal = {centre - radius, centre + radius, stress(k33)};
  if (radius > kRounding * largest) {
    // The angle of the least compressive one; the other is a quarter turn from it.
    const double angle = 0.5 * std::atan2(shear, 0.5 * (stress(k11) - stress(k22))) - 0.5 * std::numbers::pi;
    found.first_direction = {std::cos(angle), std::sin(angle)};
    const bool turn = found.first_direction(0) < -kRounding ||
                      (found.first_direction(0) < kRounding && found.first_direction(1) < 0.0);
    if (turn) found.first_direction = -found.first_direction;
  }
  found.second_direction = {-found.first_direction(1), found.first_direction(0)};
  if (-centre > kRounding * largest)
    found.mobilised_friction = std::asin(std::min(1.0, radius / -centre)) * 180.0 / std::numbers::pi;
  return found;
}

}  // namespace polargrain::fem
