// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <functional>
#include <optional>
#include <span>

#include "common/state.hpp"
#include "dem/cell/quasi_static.hpp"
#include "dem/cell/state_bounds.hpp"
#include "dem/contact/contact_recorder.hpp"
#include "dem/spheres/space_box.hpp"

namespace polargrain::dem {

/// Spheres in a box that is periodic in space and can be carried along a path: the box that a cell of spheres drives, as
/// GrainBox is in the plane. Order of calls: restore, begin, set_up, then run as often as wanted; the rest tells of the
/// last force pass.
class SpaceGrainBox {
 public:
  virtual ~SpaceGrainBox() = default;

  /// Puts a state in place of the present one. @throws RunError when it is not one of these spheres and models
  virtual void restore(const State& state) = 0;
  /// The spheres as they are, in their box, folded back into it (SpaceBox::reduced).
  [[nodiscard]] virtual StatePointer save() = 0;

  /// Sets the path of the steps to come; the box is at its start. Nothing leaves the rotations free (mode 1).
  /// @param damping_rate of the viscous damping against the affine flow, 1/s @param time_step s
  virtual void begin(const SpacePath& path, double damping_rate, const std::optional<SpaceRotation>& rotation,
                     double time_step) = 0;
  /// Contacts and forces at the places as they are. No step.
  virtual void set_up() = 0;
  /// DEM steps, at least 1.
  virtual void run(int steps) = 0;
  /// Called now and then while it runs; may be empty.
  std::function<void()> progress;

  /// Weights of the spheres in the mean rotation, adding up to 1 (mode 2; rotation_weights). Before the first step
  /// `hold_rotation` puts the torques that hold the mean to the forces of set_up.
  virtual void set_rotation_weights(std::span<const double> weights) = 0;
  virtual void hold_rotation() = 0;
  /// Of the last force pass in the laboratory, Pa; zero in mode 1 (FixSpaceStrain::multiplier).
  [[nodiscard]] virtual Eigen::Vector3d multiplier() const = 0;

  [[nodiscard]] virtual const SpaceBox& box() const = 0;
  /// Of the last force pass; spheres are counted from 0 as in the packing.
  [[nodiscard]] virtual std::span<const Contact> contacts() const = 0;
  /// Resultants of the last force pass.
  [[nodiscard]] virtual const Imbalance& imbalance() const = 0;
  /// Rotations in the laboratory since the packing, three a sphere, rad.
  [[nodiscard]] virtual std::span<const double> rotations() const = 0;
  /// Places in the frame of the box, three a sphere, m.
  [[nodiscard]] virtual std::span<const double> places() const = 0;
  /// Of one sphere, in the frame of the box; without its rotation.
  [[nodiscard]] virtual SpaceMotionOfGrain motion(int sphere) const = 0;
};

}  // namespace polargrain::dem
