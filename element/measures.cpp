// SPDX-License-Identifier: GPL-2.0-or-later
#include "element/measures.hpp"

#include <Eigen/Eigenvalues>

#include <cmath>
#include <limits>

#include "common/elementary_functions.hpp"

namespace polargrain::element {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// The measures that depend on the largest and the least principal stress alone.
void take_extremes(StressMeasures& measures, double largest, double least) {
  measures.largest = largest;
  measures.least = least;
  const bool compressed = least > 0.0;
  measures.ratio = compressed ? largest / least : std::numeric_limits<double>::infinity();
  measures.friction_angle = compressed ? arc_sine((largest - least) / (largest + least)) : kNone;
}

}  // namespace

StressMeasures measures_of(const Vector6& stress, Room room) {
  StressMeasures measures;
  const Vector6 s = -stress;
  if (!tells_stress(room, k33)) {
    const double radius = std::hypot(0.5 * (s(k22) - s(k11)), s(k12));
    measures.p = 0.5 * (s(k11) + s(k22));
    measures.q = std::copysign(2.0 * radius, s(k22) - s(k11));
    measures.b = kNone;
    take_extremes(measures, measures.p + radius, measures.p - radius);
    return measures;
  }
  Eigen::Matrix3d tensor;
  tensor << s(k11), s(k12), s(k13), s(k12), s(k22), s(k23), s(k13), s(k23), s(k33);
  measures.p = tensor.trace() / 3.0;
  const Eigen::Matrix3d deviator = tensor - measures.p * Eigen::Matrix3d::Identity();
  measures.q = std::copysign(std::sqrt(1.5) * deviator.norm(), s(k22) - 0.5 * (s(k11) + s(k33)));
  const Eigen::Vector3d principal =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(tensor, Eigen::EigenvaluesOnly).eigenvalues();
  take_extremes(measures, principal(2), principal(0));
  const double range = principal(2) - principal(0);
  measures.b = range > 1e-12 * std::abs(measures.p) ? (principal(1) - principal(0)) / range : kNone;
  return measures;
}

}  // namespace polargrain::element
