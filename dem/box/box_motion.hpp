// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <optional>

#include "common/increment.hpp"
#include "dem/box/box.hpp"

namespace polargrain::dem {

/// The addition of mode 2 to the path of a box (docs/theory/grains.md, C.6, C.9), in the laboratory.
template <int dim>
struct RotationLoading {
  using Rotation = typename Cosserat<dim>::Rotation;
  using Curvature = Eigen::Matrix<double, Cosserat<dim>::rotations, dim>;

  /// Change of the mean rotation of the grains over the path, rad; its rate follows the path's. In space it is the vector of
  /// a rotation: with R(w) of the path, grains turn against the continuum by the vector v of R(w)^T R(rotation), and after
  /// the fraction s of the way have turned by R(s w) R(s v). A rotation on top of the whole turns the grains with the box
  /// and does nothing else.
  Rotation rotation = Rotation::Zero();
  /// kappa(i,j) = d w_i / d x_j over the path, x the position at the start, w about the axes as they lie at the start: they
  /// turn with the continuum; rad/m. Contacts of `rolling_friction li_chu` see it as an eigen-rotation.
  Curvature curvature = Curvature::Zero();

  /// Of an increment, where rotations are controlled.
  static RotationLoading of(const Increment<dim>& increment);
  /// v above, rad.
  [[nodiscard]] Rotation against(const BoxPath<dim>& path) const;
};

/// A BoxPath in time, one DEM step after the other: the motion of grains that follow the box, whatever
/// loop moves them. With H_k the base vectors after step k, in the frame of the box, the affine velocity during
/// step k is A_k x with A_k = Hdot_k H^-1 and Hdot_k = (H_k - H_(k-1)) / dt, so that x_k = H_k H_0^-1 x_0
/// exactly, and two descriptions of one lattice stay one.
template <int dim>
class BoxMotion {
 public:
  using Matrix = typename Box<dim>::Matrix;
  using Rotation = typename Cosserat<dim>::Rotation;
  using Curvature = typename RotationLoading<dim>::Curvature;
  using Loading = std::optional<RotationLoading<dim>>;

  BoxMotion() = default;
  /// @param rotation prescribed mean rotation; nothing: the affine spin is that of the continuum
  BoxMotion(const BoxPath<dim>& path, const Loading& rotation, double time_step);

  /// Takes a new path from the box as it is, and keeps the rates of the step behind it.
  void go_on(const BoxPath<dim>& path, const Loading& rotation, double time_step);
  /// Gives the box, as it is, the rates of a step behind it. @param gradient Hdot H^-1, 1/s @param spin rad/s
  void set_rates(const Matrix& gradient, const Rotation& spin);
  /// Goes on by one step.
  void advance();

  [[nodiscard]] bool rotation_is_prescribed() const { return rotation_.has_value(); }
  /// The box after the steps so far.
  [[nodiscard]] const Box<dim>& box() const { return box_; }
  /// Hdot of the step under way, m/s: the velocity of the images.
  [[nodiscard]] const Matrix& rate() const { return rate_; }
  /// The change of the affine velocity gradient by the step under way, where it starts:
  /// (Hdot_k - Hdot_(k-1)) H_(k-1)^-1, 1/s.
  [[nodiscard]] const Matrix& change_of_gradient() const { return change_; }
  /// Hdot_k H_(k-1)^-1 and Hdot_k H_k^-1, 1/s: the affine velocity gradient before and after the grains have moved.
  [[nodiscard]] Matrix gradient_before() const { return rate_ * before_.inverse(); }
  [[nodiscard]] const Matrix& gradient() const { return gradient_; }
  /// Whether the box or its rotation moves in the step under way or stops with it.
  [[nodiscard]] bool moving() const { return moving_; }
  /// Rotation of the frame in the step under way, in the laboratory, rad.
  [[nodiscard]] const Rotation& turn() const { return turn_; }
  /// Affine or prescribed spin of the step under way, counted from the frame, and its change by the step, rad/s.
  [[nodiscard]] const Rotation& spin() const { return spin_; }
  [[nodiscard]] const Rotation& change_of_spin() const { return change_of_spin_; }
  /// Rate of curvature (i,j) in the position now and the frame of the box now, rad/(m s).
  [[nodiscard]] const Curvature& curvature_rate() const { return curvature_rate_; }

 private:
  [[nodiscard]] Rotation turn_between(const Box<dim>& before, const Box<dim>& after) const;
  /// Prescribes spin and curvature in the step under way.
  void turn_grains();

  BoxPath<dim> path_;
  Loading rotation_;
  Rotation against_ = Rotation::Zero();          // v of RotationLoading
  Matrix stretched_frame_ = Matrix::Identity();  // in space: R(s w)^T frame, after the steps so far
  double time_step_ = 1.0;
  int step_ = 0;
  Box<dim> box_;
  Box<dim> before_;
  Matrix rate_ = Matrix::Zero();
  Matrix change_ = Matrix::Zero();
  Matrix gradient_ = Matrix::Zero();
  Curvature curvature_rate_ = Curvature::Zero();
  bool moving_ = false;
  Rotation turn_ = Rotation::Zero();
  Rotation spin_ = Rotation::Zero();
  Rotation change_of_spin_ = Rotation::Zero();
};

}  // namespace polargrain::dem
