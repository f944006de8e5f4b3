// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <array>
#include <type_traits>

#include "common/cosserat.hpp"

namespace polargrain::dem {

/// The periodic box of a cell, of discs in the plane (2) or of spheres in space (3). The engine wants its base vectors
/// upper triangular, so the box (and the grains in it) live in a frame of their own: H_laboratory = frame() * base.
template <int dim>
struct Box {
  using Matrix = typename Cosserat<dim>::Gradient;
  using Place = typename Cosserat<dim>::Place;
  /// How the frame lies in the laboratory. In the plane an angle, counter-clockwise, which goes on beyond a whole turn, rad;
  /// in space a rotation: box frame to laboratory.
  using Orientation = std::conditional_t<dim == 2, double, Eigen::Matrix3d>;
  static Orientation upright() {
    if constexpr (dim == 2) {
      return 0.0;
    } else {
      return Eigen::Matrix3d::Identity();
    }
  }

  Matrix base = Matrix::Zero();  ///< base vectors as columns, upper triangular with a positive diagonal, m
  Orientation orientation = upright();

  /// @param base_vectors as columns, in the laboratory; their determinant must be positive.
  static Box from_base_vectors(const Matrix& base_vectors);
  [[nodiscard]] Matrix frame() const;    ///< a rotation: box frame to laboratory
  [[nodiscard]] Matrix inverse() const;  ///< of the base, upper triangular
  /// Area in the plane, m^2; volume in space, m^3.
  [[nodiscard]] double size() const;
  /// The same lattice with tilts of at most half a length, which the engine needs. Grains need only be wrapped again.
  [[nodiscard]] Box reduced() const;
  /// The image of a place that lies in the box, both in the frame of the box.
  [[nodiscard]] Place folded(Place place) const;

  /// The box as plain numbers, for states: in the plane lengths, tilt and angle, in space the upper triangle of the base and
  /// the frame, both column after column.
  using Numbers = std::array<double, dim == 2 ? 4 : 15>;
  [[nodiscard]] Numbers numbers() const;
  static Box from_numbers(const Numbers& numbers);
};

/// The frame of a box in space: e_3 of a plane one stays as it is.
template <int dim>
Eigen::Matrix3d frame_in_space(const Box<dim>& box) {
  Eigen::Matrix3d frame = Eigen::Matrix3d::Identity();
  frame.topLeftCorner<dim, dim>() = box.frame();
  return frame;
}

/// How a path is gone in time.
enum class Pace {
  smooth,  ///< starts and ends at rest and sends no waves: the fraction grows as t - sin(2 pi t) / (2 pi)
  even     ///< at one rate, for boxes that come moving and go on (ResidentBoxes)
};

/// A box carried along by a displacement gradient h of the laboratory. With the polar decomposition I + h = R
/// U and R a rotation by w, its base vectors at the fraction s of the way are
///   F(s) H_start,   F(s) = R(s w) (I + s (U - I)),
/// so that a rotation turns it and does nothing else. s grows from 0 to 1 as the pace says.
template <int dim>
class BoxPath {
 public:
  using Matrix = typename Box<dim>::Matrix;
  using Rotation = typename Cosserat<dim>::Rotation;

  BoxPath() = default;
  /// @param steps number of DEM steps; 0 stands still. @throws RunError when the box would lose its area or volume.
  BoxPath(const Box<dim>& start, const Matrix& displacement_gradient, int steps, Pace pace = Pace::smooth);
  /// A box that stands still.
  explicit BoxPath(const Box<dim>& start) : BoxPath(start, Matrix::Zero(), 0) {}
  /// The smooth way straight on, (I + s gradient) base, in a frame that does not turn: lengths and tilts without strain keep
  /// their bits. For free rotations. @param gradient in the frame of the box, upper triangular
  static BoxPath straight(const Box<dim>& start, const Matrix& gradient, int steps);

  [[nodiscard]] int steps() const { return steps_; }
  [[nodiscard]] const Rotation& rotation() const { return rotation_; }  ///< w of the whole way, rad
  [[nodiscard]] const Matrix& strain() const { return stretch_; }       ///< U - I of the whole way
  /// Box after `step` steps, 0 to steps().
  [[nodiscard]] Box<dim> at(int step) const;
  /// Part of the way that is done in this step; all steps add up to 1. Zero outside 1 .. steps().
  [[nodiscard]] double share(int step) const;
  /// F(s) after `step` steps, in the laboratory.
  [[nodiscard]] Matrix deformation(int step) const;
  /// R(s w) after `step` steps.
  [[nodiscard]] Matrix turned(int step) const;

 private:
  [[nodiscard]] double fraction(int step) const;

  Box<dim> start_;
  Rotation rotation_ = Rotation::Zero();
  Matrix stretch_ = Matrix::Zero();  // U - I, in the laboratory
  Matrix growth_ =
      Matrix::Zero();  // of the base over a straight way or one in space, in the frame of the box, m
  int steps_ = 0;
  Pace pace_ = Pace::smooth;
  bool straight_ = false;
};

/// The largest principal strain of a path, its magnitude.
template <int dim>
double largest_principal_strain(const BoxPath<dim>& path);

}  // namespace polargrain::dem
