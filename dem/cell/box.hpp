// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>

namespace polargrain::dem {

/// The periodic box of a cell. The engine wants the first base vector along x, so the box (and the grains in
/// it) live in a frame of their own that is turned by `rotation` against the laboratory:
///   H_laboratory = R(rotation) [[length_x, tilt], [0, length_y]],  columns are base vectors, in m.
struct Box {
  double length_x = 0.0;
  double length_y = 0.0;
  double tilt = 0.0;      ///< x component of the second base vector, m
  double rotation = 0.0;  ///< rad, counter-clockwise, laboratory against box frame

  /// @param base_vectors as columns, in the laboratory frame; their determinant must be positive.
  static Box from_base_vectors(const Eigen::Matrix2d& base_vectors);
  [[nodiscard]] Eigen::Matrix2d base_vectors() const;  ///< in the box frame (upper triangular)
  [[nodiscard]] Eigen::Matrix2d frame() const;         ///< R(rotation): box frame to laboratory
  [[nodiscard]] double area() const { return length_x * length_y; }
  /// The same lattice with |tilt| <= length_x / 2, which the engine needs. Grains need only be wrapped again.
  [[nodiscard]] Box reduced() const;
  /// The image of a place that lies in the box, in the box frame.
  [[nodiscard]] Eigen::Vector2d folded(Eigen::Vector2d place) const;
};

/// How a path is gone in time.
enum class Pace {
  smooth,  ///< starts and ends at rest and sends no waves: the fraction grows as t - sin(2 pi t) / (2 pi)
  even     ///< at one rate, for boxes that come moving and go on (ResidentBoxes)
};

/// A box carried along by a displacement gradient h of the laboratory. With the polar decomposition I + h = R
/// U and R a rotation by w, its base vectors at the fraction s of the way are
///   F(s) H_start,   F(s) = R(s w) (I + s (U - I)),
/// so that a rotation turns it and does nothing else. s grows from 0 to 1 as the pace says.
class BoxPath {
 public:
  BoxPath() = default;
  /// @param steps number of DEM steps, at least 1. @throws RunError when the box would lose its area.
  BoxPath(const Box& start, const Eigen::Matrix2d& displacement_gradient, int steps,
          Pace pace = Pace::smooth);

  [[nodiscard]] int steps() const { return steps_; }
  [[nodiscard]] double rotation() const { return rotation_; }               ///< w of the whole way, rad
  [[nodiscard]] const Eigen::Matrix2d& strain() const { return stretch_; }  ///< U - I of the whole way
  /// Box after `step` steps, 0 to steps(); continuous rotation angle.
  [[nodiscard]] Box at(int step) const;

  /// Part of the way that is done in this step; all steps add up to 1. Zero outside 1 .. steps().
  [[nodiscard]] double share(int step) const;

  /// F(s) after `step` steps, in the laboratory.
  [[nodiscard]] Eigen::Matrix2d deformation(int step) const;

 private:
  [[nodiscard]] double fraction(int step) const;

  Box start_;
  double rotation_ = 0.0;                              // w, rad
  Eigen::Matrix2d stretch_ = Eigen::Matrix2d::Zero();  // U - I, in the laboratory
  int steps_ = 0;
  Pace pace_ = Pace::smooth;
};

}  // namespace polargrain::dem
