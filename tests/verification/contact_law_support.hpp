// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <fmt/format.h>

#include <string>
#include <vector>

#include "dem/contact/contact_pair.hpp"

namespace polargrain::dem::test {

inline constexpr double kRadiusA = 0.010;
inline constexpr double kRadiusB = 0.006;
inline constexpr double kOverlap = 1e-6;
inline constexpr double kReduced = kRadiusA * kRadiusB / (kRadiusA + kRadiusB);
inline constexpr double kNormal = 1e6;  // contact stiffnesses, N/m
inline constexpr double kSliding = 8e5;
inline constexpr double kFriction = 0.5;
inline constexpr double kRollingFriction = 0.3;
inline constexpr double kRollingRatio = 0.6;  // k_th / (k_s R*^2)
inline constexpr double kForceRatio = 0.25;   // k_r / k_s
inline constexpr double kForceFriction = 0.2;
inline constexpr double kNormalForce = kNormal * kOverlap;

inline double distance() {
  return kRadiusA + kRadiusB - kOverlap;
}

/// Linear normal law and every property any of the laws may ask for; no damping.
inline std::vector<std::string> model(const std::string& words, double friction = kFriction,
                                      double rolling_friction = kRollingFriction,
                                      double rolling_ratio = kRollingRatio) {
  std::vector<std::string> lines;
  const auto property = [&lines](const std::string& name, double value) {
    lines.push_back(fmt::format("fix {0} all property/global {0} peratomtypepair 1 {1:.17g}", name, value));
  };
  property("contactModulus", kNormal / (2.0 * kReduced));
  property("tangentialStiffnessRatio", kSliding / kNormal);
  property("coefficientFriction", friction);
  property("coefficientRollingFriction", rolling_friction);
  property("rollingStiffnessRatio", rolling_ratio);
  property("rollingFrictionForceStiffnessRatio", kForceRatio);
  property("coefficientRollingFrictionForce", kForceFriction);
  lines.push_back("pair_style gran model hooke/radii " + words);
  lines.push_back("pair_coeff * *");
  return lines;
}

inline ContactPair::Place place_at(double angle) {
  return {Eigen::Vector3d::Zero(), distance() * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.0)};
}

inline ContactPair::Definition definition(const std::vector<std::string>& lines, int dimension = 2) {
  ContactPair::Definition made;
  made.dimension = dimension;
  made.model = lines;
  made.radius_first = kRadiusA;
  made.radius_second = kRadiusB;
  return made;
}

/// Spins that give the rates of u_s and u_r of docs/theory.md, D.1 while the centres rest. The engine's lever
/// arms reach to the middle of the overlap, its R* is that of the radii.
inline ContactPair::Spins spins_for(double sliding_rate, double rolling_rate) {
  const double arm_a = kRadiusA - 0.5 * kOverlap;
  const double arm_b = kRadiusB - 0.5 * kOverlap;
  const double relative = rolling_rate / kReduced;  // w_B - w_A
  const double spin_a = -(sliding_rate + arm_b * relative) / (arm_a + arm_b);
  return {spin_a * Eigen::Vector3d::UnitZ(), (spin_a + relative) * Eigen::Vector3d::UnitZ()};
}

inline const std::string kPlain = "tangential li_chu rolling_friction li_chu rollingFrictionForce on";
}  // namespace polargrain::dem::test
