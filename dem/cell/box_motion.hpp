// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <optional>

#include "dem/cell/box.hpp"

namespace polargrain::dem {

/// The addition of mode 2 to the path of the box (docs/theory/grains.md, C.6).
struct RotationLoading {
  /// Change of the mean rotation of the grains over the path, in the laboratory, rad; its rate follows the
  /// path's.
  double micro_rotation = 0.0;
  /// d(micro-rotation)/d x_i over the path, in the laboratory, x the position at the start, rad/m. Contacts
  /// of `rolling_friction li_chu` see it as an eigen-rotation.
  Eigen::Vector2d curvature = Eigen::Vector2d::Zero();
};

/// A BoxPath in time, one DEM step after the other: the motion of grains that follow the box, whatever
/// loop moves them. With H_k the base vectors after step k, in the frame of the box, the affine velocity during
/// step k is A_k x with A_k = Hdot_k H^-1 and Hdot_k = (H_k - H_(k-1)) / dt, so that x_k = H_k H_0^-1 x_0
/// exactly, and two descriptions of one lattice stay one.
class BoxMotion {
 public:
  BoxMotion() = default;
  BoxMotion(const BoxPath& path, std::optional<RotationLoading> rotation, double time_step);

  /// Takes a new path from the box as it is, and keeps the rates of the step behind it.
  void go_on(const BoxPath& path, std::optional<RotationLoading> rotation);
  /// Gives the box, as it is, the rates of a step behind it. @param gradient Hdot H^-1, 1/s @param spin rad/s
  void set_rates(const Eigen::Matrix2d& gradient, double spin);
  /// Goes on by one step.
  void advance();

  [[nodiscard]] const BoxPath& path() const { return path_; }
  [[nodiscard]] const std::optional<RotationLoading>& rotation() const { return rotation_; }
  [[nodiscard]] int step() const { return step_; }
  /// The box after the steps so far, and before the last of them.
  [[nodiscard]] const Box& box() const { return box_; }
  [[nodiscard]] const Box& box_before() const { return before_; }
  /// Hdot of the step under way, m/s: the velocity of the images.
  [[nodiscard]] const Eigen::Matrix2d& rate() const { return rate_; }
  /// The change of the affine velocity gradient by the step under way, where it starts:
  /// (Hdot_k - Hdot_(k-1)) H_(k-1)^-1, 1/s.
  [[nodiscard]] const Eigen::Matrix2d& change_of_gradient() const { return change_; }
  /// Hdot_k H_(k-1)^-1 and Hdot_k H_k^-1: the affine velocity gradient before and after the grains have moved.
  [[nodiscard]] Eigen::Matrix2d gradient_before() const;
  [[nodiscard]] const Eigen::Matrix2d& gradient() const { return gradient_; }
  /// Whether the box or its rotation moves in the step under way or stops with it.
  [[nodiscard]] bool moving() const { return moving_; }
  /// Rotation of the frame in the step under way, rad.
  [[nodiscard]] double turn() const { return turn_; }
  /// Affine spin of the step under way, counted from the frame, and its change by the step, rad/s.
  [[nodiscard]] double spin() const { return spin_; }
  [[nodiscard]] double change_of_spin() const { return change_of_spin_; }
  /// Rate of curvature in the position now and the frame of the box now, rad/(m s).
  [[nodiscard]] const Eigen::Vector2d& curvature_rate() const { return curvature_rate_; }

 private:
  [[nodiscard]] Eigen::Vector2d find_curvature_rate() const;

  BoxPath path_;
  std::optional<RotationLoading> rotation_;
  double time_step_ = 1.0;
  int step_ = 0;
  Box box_;
  Box before_;
  Eigen::Matrix2d rate_ = Eigen::Matrix2d::Zero();
  Eigen::Matrix2d change_ = Eigen::Matrix2d::Zero();
  Eigen::Matrix2d gradient_ = Eigen::Matrix2d::Zero();
  Eigen::Vector2d curvature_rate_ = Eigen::Vector2d::Zero();
  bool moving_ = false;
  double turn_ = 0.0;
  double spin_ = 0.0;
  double change_of_spin_ = 0.0;
};

}  // namespace polargrain::dem
