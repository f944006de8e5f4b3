// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <span>
#include <vector>

#include "dem/box/box_motion.hpp"
#include "dem/contact/contact_recorder.hpp"

namespace polargrain::dem {

/// How far the springs of a contact have given way over an increment: the relative motion of its grains less the change
/// of the spring. Zero: nothing is known, or nothing gave way.
struct SpaceSlip {
  double sliding = 0.0;  ///< m
  double bending = 0.0;  ///< rad
  double torsion = 0.0;  ///< rad
};

/// Part of an elastic spring that answers along the way on which it has given way by `slip` and then, by `unloaded`, come
/// back from its limit: the share of its last piece in a change of the whole way. 1 without slip, 0 at the limit.
double spring_left_along(double slip, double unloaded);

/// Part of it that answers across that way: while it slides, the spring turns towards the way with the length `limit`
/// that it has at its limit, so that a change of the way's direction arrives with (1 - exp(-x)) / x, x = slip / limit.
double spring_left_across(double slip, double limit);

/// Places and rotations of grains, and springs of contacts, where an increment starts; at its end they tell how far each
/// contact has slid on the way (docs/theory/grains.md, C.9). Springs count as force over stiffness, as all models of the
/// engine keep them that have a limit. A contact that has closed on the way has moved since by the share of its overlap in
/// the approach of the grains.
class IncrementSlip {
 public:
  /// @param positions three a grain, in the frame of the box, m @param rotations three a grain, in the laboratory, rad,
  /// or empty: they count from zero
  void start(std::span<const Contact> contacts, const double* positions, std::span<const double> rotations,
             const Box<3>& box, int grains);
  /// One a contact. @param rotations as in start(), at the end @param curvature of the increment, in the laboratory, rad/m
  [[nodiscard]] std::vector<SpaceSlip> until(std::span<const Contact> contacts,
                                             std::span<const double> rotations, const Box<3>& box,
                                             const Eigen::Matrix3d& curvature) const;

 private:
  struct Springs {
    int first = 0;
    int second = 0;
    Eigen::Vector3d branch;    // m
    Eigen::Vector3d sliding;   // m
    Eigen::Vector3d rotation;  // bending and torsion, rad
  };
  static Springs springs_of(const Contact& contact, const Eigen::Matrix3d& frame);
  /// Of the same pair of grains, by the same of its images; null when they did not touch.
  [[nodiscard]] const Springs* found(const Contact& contact, const Eigen::Vector3d& branch) const;

  Box<3> box_;
  std::vector<Eigen::Vector3d> places_;  // in the laboratory, m
  std::vector<Eigen::Vector3d> turns_;   // in the laboratory, rad
  std::vector<Springs> springs_;         // by the pair of grains
};

}  // namespace polargrain::dem
