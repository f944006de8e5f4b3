// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/output/stress_measures.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "common/elementary_functions.hpp"

namespace polargrain::fem {
namespace {

/// Below this share of the stresses a sum of them is rounding.
constexpr double kRoundingOfLode = 64.0 * std::numeric_limits<double>::epsilon();

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
  if (found.pressure > kRoundingOfLode * largest) found.ratio = found.deviatoric / found.pressure;

  const double centre = 0.5 * (stress(k11) + stress(k22));
  const double radius = std::hypot(0.5 * (stress(k11) - stress(k22)), shear);
  found.principal = {centre - radius, centre + radius, stress(k33)};
  if (radius > kRoundingOfLode * largest) {
    // The angle of the least compressive one; the other is a quarter turn from it.
    const double angle = 0.5 * std::atan2(shear, 0.5 * (stress(k11) - stress(k22))) - 0.5 * std::numbers::pi;
    found.first_direction = {std::cos(angle), std::sin(angle)};
    const bool turn = found.first_direction(0) < -kRoundingOfLode ||
                      (found.first_direction(0) < kRoundingOfLode && found.first_direction(1) < 0.0);
    if (turn) found.first_direction = -found.first_direction;
  }
  found.second_direction = {-found.first_direction(1), found.first_direction(0)};
  if (-centre > kRoundingOfLode * largest)
    found.mobilised_friction = std::asin(std::min(1.0, radius / -centre)) * 180.0 / std::numbers::pi;
  return found;
}

SpaceStressMeasures measures_in_space(const Vector18& stress) {
  SpaceStressMeasures found;
  Eigen::Matrix3d symmetric;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      symmetric(i, j) =
          0.5 * (stress(Cosserat<3>::stress_place(i, j)) + stress(Cosserat<3>::stress_place(j, i)));
  const double largest = symmetric.cwiseAbs().maxCoeff();
  const double mean = symmetric.trace() / 3.0;
  const Eigen::Matrix3d deviator = symmetric - mean * Eigen::Matrix3d::Identity();
  found.pressure = -mean;
  found.deviatoric = std::sqrt(1.5) * deviator.norm();
  if (found.pressure > kRoundingOfLode * largest) found.ratio = found.deviatoric / found.pressure;
  if (!(found.deviatoric > kRoundingOfLode * largest)) {
    found.principal.setConstant(mean);
    return found;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(symmetric);
  found.principal = solver.eigenvalues();  // rising
  found.directions = solver.eigenvectors();
  for (int i = 0; i < 3; ++i) {
    Eigen::Index place = 0;
    found.directions.col(i).cwiseAbs().maxCoeff(&place);
    if (found.directions(place, i) < 0.0) found.directions.col(i) *= -1.0;
  }
  // -J3 is positive in triaxial compression, where the angle is zero.
  const double cosine =
      -13.5 * deviator.determinant() / (found.deviatoric * found.deviatoric * found.deviatoric);
  found.lode_angle = arc_cosine(std::clamp(cosine, -1.0, 1.0)) / 3.0 * 180.0 / std::numbers::pi;
  const double centre = 0.5 * (found.principal(0) + found.principal(2));
  const double radius = 0.5 * (found.principal(2) - found.principal(0));
  if (-centre > kRoundingOfLode * largest)
    found.mobilised_friction = arc_sine(std::min(1.0, radius / -centre)) * 180.0 / std::numbers::pi;
  return found;
}

}  // namespace polargrain::fem
