// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/adaptivity/error_estimate.hpp"

#include <algorithm>
#include <cmath>

#include "coupler/adaptivity/linearised.hpp"

namespace polargrain::coupler {
namespace {

/// Of the stress between the tangents of sliding and of sticking contacts, what a change of direction was
/// measured to make (docs/adaptivity.md, 2).
constexpr double kShareOfElastic = 0.5;
/// What a cell has shown is forgotten by half at each new run.
constexpr double kMemory = 0.5;
/// Weight of a volume change; the square root of its share of the curvature in shear.
constexpr double kVolume = 0.35;

Eigen::Matrix2d symmetric(const Eigen::Matrix2d& offset) {
  return 0.5 * (offset + offset.transpose());
}

Vector7 strain_of(const Eigen::Matrix2d& symmetric_strain) {
  return increment_of(symmetric_strain).strain();
}

/// The part of a strain that goes on along the last loading.
double onward_of(const Eigen::Matrix2d& strain, const Curvature& curvature) {
  return std::max(0.0, strain.cwiseProduct(curvature.direction).sum());
}

}  // namespace

double Curvature::over(double size) const {
  const double x = size / length;
  return error * (x <= 1.0 ? x * std::sqrt(x) : x * x);
}

double size_of(const Eigen::Matrix2d& offset) {
  const Eigen::Matrix2d strain = symmetric(offset);
  const Eigen::Matrix2d volume = 0.5 * strain.trace() * Eigen::Matrix2d::Identity();
  return std::sqrt((strain - volume).squaredNorm() + kVolume * kVolume * volume.squaredNorm());
}

double ErrorEstimate::of(const Response& answer, const Curvature& curvature,
                         const Eigen::Matrix2d& offset) const {
  const double size = size_of(offset);
  if (size == 0.0) return 0.0;
  if (!curvature.known()) return HUGE_VAL;
  const Eigen::Matrix2d strain = symmetric(offset);
  const Eigen::Matrix2d onward = onward_of(strain, curvature) * curvature.direction;
  const Vector7 apart = (elastic_ - answer.tangent) * strain_of(strain - onward);
  return curvature.over(size) + kShareOfElastic * in_plane_norm(apart);
}

Curvature ErrorEstimate::learn(const Response& start, const Response& end, const Eigen::Matrix2d& offset,
                               Curvature& at_start) const {
  const double size = size_of(offset);
  const Eigen::Matrix2d strain = symmetric(offset);
  const double missed = in_plane_norm(end.stress - linearised_stress(start, offset));
  Curvature seen;
  // The tangent may have turned more than the stress shows.
  seen.error = std::max(missed, 0.5 * in_plane_norm((end.tangent - start.tangent) * strain_of(strain)));
  seen.length = size;
  if (strain.norm() > 0.0) seen.direction = strain / strain.norm();
  const bool replaces = !at_start.known() || (at_start.length < noise_length_ && size > at_start.length);
  const double expected = replaces ? 0.0 : at_start.over(size);
  seen.error = std::max(seen.error, kMemory * expected);
  if (replaces || missed > expected) {
    at_start.error = missed;
    at_start.length = size;
  }
  return seen;
}

}  // namespace polargrain::coupler
