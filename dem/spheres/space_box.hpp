// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <optional>

#include "dem/cell/box.hpp"

namespace polargrain::dem {

/// The periodic box of a cell of spheres. The engine wants its base vectors upper triangular, so the box (and the
/// grains in it) live in a frame of their own: H_laboratory = frame * base; columns are base vectors, in m.
struct SpaceBox {
  Eigen::Matrix3d base = Eigen::Matrix3d::Zero();       ///< upper triangular, its diagonal positive
  Eigen::Matrix3d frame = Eigen::Matrix3d::Identity();  ///< a rotation: box frame to laboratory

  /// @param base_vectors as columns, in the laboratory; their determinant must be positive.
  static SpaceBox from_base_vectors(const Eigen::Matrix3d& base_vectors);
  [[nodiscard]] double volume() const { return base(0, 0) * base(1, 1) * base(2, 2); }
  [[nodiscard]] Eigen::Matrix3d inverse() const;  ///< of the base, upper triangular
  /// The same lattice with tilts of at most half a length, which the engine is made for.
  [[nodiscard]] SpaceBox reduced() const;
  /// A place of the box frame by the image that lies in the box.
  [[nodiscard]] Eigen::Vector3d folded(Eigen::Vector3d place) const;
};

/// A box carried along by a displacement gradient h of the laboratory, as BoxPath does it in the plane: with the
/// polar decomposition I + h = R U and R a rotation by the vector w, base vectors at the fraction s of the way are
///   F(s) H_start,   F(s) = R(s w) (I + s (U - I)),
/// so that a rotation turns the box and does nothing else; s grows from 0 to 1 as the pace says.
class SpacePath {
 public:
  SpacePath() = default;
  /// @param steps number of DEM steps; 0 stands still. @throws RunError when the box would lose its volume.
  SpacePath(const SpaceBox& start, const Eigen::Matrix3d& displacement_gradient, int steps,
            Pace pace = Pace::smooth);
  /// The smooth way straight on, (I + s gradient) base, in a frame that does not turn: lengths and tilts without strain keep
  /// their bits. For free rotations. @param gradient in the frame of the box, upper triangular
  static SpacePath straight(const SpaceBox& start, const Eigen::Matrix3d& gradient, int steps);

  [[nodiscard]] int steps() const { return steps_; }
  [[nodiscard]] const Eigen::Vector3d& rotation() const { return rotation_; }  ///< w of the whole way, rad
  [[nodiscard]] const Eigen::Matrix3d& strain() const { return stretch_; }     ///< U - I of the whole way
  /// Box after `step` steps, 0 to steps().
  [[nodiscard]] SpaceBox at(int step) const;
  /// Part of the way that is done in this step; all steps add up to 1. Zero outside 1 .. steps().
  [[nodiscard]] double share(int step) const;
  /// F(s) after `step` steps, in the laboratory.
  [[nodiscard]] Eigen::Matrix3d deformation(int step) const;
  /// R(s w) after `step` steps.
  [[nodiscard]] Eigen::Matrix3d turned(int step) const;

 private:
  [[nodiscard]] double fraction(int step) const;

  SpaceBox start_;
  Eigen::Vector3d rotation_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d stretch_ = Eigen::Matrix3d::Zero();          // U - I, in the laboratory
  Eigen::Matrix3d stretch_of_base_ = Eigen::Matrix3d::Zero();  // frame^T (U - I) frame base
  int steps_ = 0;
  Pace pace_ = Pace::smooth;
  bool straight_ = false;
};

/// The largest principal strain of a path, its magnitude.
double largest_principal_strain(const SpacePath& path);

/// The addition of mode 2 to a SpacePath (docs/theory/grains.md, C.9), in the laboratory.
struct SpaceRotation {
  /// The mean rotation of the grains over the path as the vector of a rotation, rad. With R(w) of the path, grains turn
  /// against the continuum by the vector v of R(w)^T R(rotation), and after the fraction s of the way have turned by
  /// R(s w) R(s v): a rotation on top of the whole turns the grains with the box and does nothing else.
  Eigen::Vector3d rotation = Eigen::Vector3d::Zero();
  /// kappa(i,j) = d w_i / d x_j over the path, x the position at the start, w about the axes as they lie at the start:
  /// they turn with the continuum; rad/m.
  Eigen::Matrix3d curvature = Eigen::Matrix3d::Zero();

  /// v above.
  [[nodiscard]] Eigen::Vector3d against(const SpacePath& path) const;
};

/// A SpacePath in time, one DEM step after the other (BoxMotion in the plane). With H_k the base vectors after step
/// k, in the frame of the box, the affine velocity during step k is Hdot_k H^-1 x with Hdot_k = (H_k - H_(k-1)) / dt,
/// so that x_k = H_k H_0^-1 x_0 exactly.
class SpaceMotion {
 public:
  SpaceMotion() = default;
  /// @param rotation prescribed mean rotation; nothing: the affine spin is that of the continuum
  SpaceMotion(const SpacePath& path, const std::optional<SpaceRotation>& rotation, double time_step);

  /// Takes a new path from the box as it is, and keeps the rates of the step behind it.
  void go_on(const SpacePath& path, const std::optional<SpaceRotation>& rotation, double time_step);
  /// Gives the box, as it is, the rates of a step behind it. @param gradient Hdot H^-1, 1/s @param spin rad/s
  void set_rates(const Eigen::Matrix3d& gradient, const Eigen::Vector3d& spin);
  /// Goes on by one step.
  void advance();

  [[nodiscard]] const SpacePath& path() const { return path_; }
  /// The box after the steps so far.
  [[nodiscard]] const SpaceBox& box() const { return box_; }
  /// Hdot of the step under way, m/s: the velocity of the images.
  [[nodiscard]] const Eigen::Matrix3d& rate() const { return rate_; }
  /// (Hdot_k - Hdot_(k-1)) H_(k-1)^-1, 1/s: the change of the affine velocity gradient by the step, where it starts.
  [[nodiscard]] const Eigen::Matrix3d& change_of_gradient() const { return change_; }
  /// Hdot_k H_k^-1: the affine velocity gradient after the grains have moved, 1/s.
  [[nodiscard]] const Eigen::Matrix3d& gradient() const { return gradient_; }
  /// Whether the box moves in the step under way or stops with it.
  [[nodiscard]] bool moving() const { return moving_; }
  /// Rotation of the frame in the step under way, in the laboratory, rad.
  [[nodiscard]] const Eigen::Vector3d& turn() const { return turn_; }
  [[nodiscard]] bool rotation_is_prescribed() const { return rotation_.has_value(); }
  /// Affine or prescribed spin of the step under way, counted from the frame, and its change by the step, rad/s.
  [[nodiscard]] const Eigen::Vector3d& spin() const { return spin_; }
  [[nodiscard]] const Eigen::Vector3d& change_of_spin() const { return change_of_spin_; }
  /// Rate of curvature (i,j) in the position now and the frame of the box now, rad/(m s).
  [[nodiscard]] const Eigen::Matrix3d& curvature_rate() const { return curvature_rate_; }

 private:
  /// Prescribes the spins in the step under way.
  void turn_grains();

  SpacePath path_;
  std::optional<SpaceRotation> rotation_;
  Eigen::Vector3d against_ = Eigen::Vector3d::Zero();              // v of SpaceRotation
  Eigen::Matrix3d stretched_frame_ = Eigen::Matrix3d::Identity();  // R(s w)^T frame, after the steps so far
  double time_step_ = 1.0;
  int step_ = 0;
  SpaceBox box_;
  Eigen::Matrix3d rate_ = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d change_ = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d gradient_ = Eigen::Matrix3d::Zero();
  bool moving_ = false;
  Eigen::Vector3d turn_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d spin_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d change_of_spin_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d curvature_rate_ = Eigen::Matrix3d::Zero();
};

}  // namespace polargrain::dem
