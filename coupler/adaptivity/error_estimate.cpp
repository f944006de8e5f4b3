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
constexpr double kMuchLonger = 2.0;

Eigen::Matrix2d symmetric(const Eigen::Matrix2d& offset) {
  return 0.5 * (offset + offset.transpose());
}

}  // namespace

double Curvature::over(double distance) const {
  const double x = distance / length;
  return error * (x <= 1.0 ? x * std::sqrt(x) : x * x);
}

double ErrorEstimate::of(const Response& answer, const Curvature& curvature,
                         const Eigen::Matrix2d& offset) const {
  const double distance = offset.norm();
  if (distance == 0.0) return 0.0;
  if (!curvature.known()) return HUGE_VAL;
  const Eigen::Matrix2d strain = symmetric(offset);
  const double onward = std::max(0.0, strain.cwiseProduct(curvature.direction).sum());
  const Vector7 turned = increment_of(strain - onward * curvature.direction).strain();
  const Vector7 apart = (elastic_ - answer.tangent) * turned;
  return curvature.over(distance) + kShareOfElastic * in_plane_norm(apart);
}

Curvature ErrorEstimate::learn(const Response& start, const Response& end, const Eigen::Matrix2d& offset,
                               Curvature& at_start) const {
  const double distance = offset.norm();
  const Eigen::Matrix2d strain = symmetric(offset);
  const double missed = in_plane_norm(end.stress - linearised_stress(start, offset));
  // The tangent may have turned more than the stress shows.
  const double turned = 0.5 * in_plane_norm((end.tangent - start.tangent) * increment_of(strain).strain());
  Curvature seen{std::max(missed, turned), distance, Eigen::Matrix2d::Zero()};
  if (strain.norm() > 0.0) seen.direction = strain / strain.norm();
  // What a short run has shown is mostly the cell's noise; one that is much longer replaces it.
  if (!at_start.known() || distance >= kMuchLonger * at_start.length) {
    at_start.error = missed;
    at_start.length = distance;
    return seen;
  }
  const double expected = at_start.over(distance);
  seen.error = std::max(seen.error, kMemory * expected);
  if (missed > expected) {
    at_start.error = missed;
    at_start.length = distance;
  }
  return seen;
}

}  // namespace polargrain::coupler
