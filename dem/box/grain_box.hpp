// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <functional>
#include <optional>
#include <span>

#include "common/state.hpp"
#include "dem/box/box_motion.hpp"
#include "dem/box/contact_sums.hpp"
#include "dem/box/state_bounds.hpp"
#include "dem/contact/contact_recorder.hpp"

namespace polargrain::dem {

/// Resultants of the contacts of the grains, and of the reaction that holds their mean rotation, before damping.
struct Imbalance {
  double force = 0.0;   ///< sum over grains of its magnitude, N
  double moment = 0.0;  ///< the same, N m
  int grains = 0;
};

/// Grains in a periodic box that can be carried along a path: the box that a cell drives. Order of calls: restore,
/// begin, set_up, then run as often as wanted; the rest tells of the last force pass. Vectors of the grains lie one behind
/// the other: `dim` numbers a place, one rotation a disc and three a sphere.
template <int dim>
class GrainBox {
 public:
  using Loading = typename BoxMotion<dim>::Loading;
  GrainBox() = default;
  GrainBox(const GrainBox&) = delete;  // boxes may share their records
  GrainBox& operator=(const GrainBox&) = delete;
  virtual ~GrainBox() = default;

  /// Replaces the state. @throws RunError when it does not fit these grains and models
  virtual void restore(const State& state) = 0;
  /// The grains as they are, in their box, folded back into it (Box::reduced).
  [[nodiscard]] virtual StatePointer save() = 0;

  /// Sets the path of the steps to come; the box is at its start. Nothing leaves the rotations free (mode 1).
  /// @param damping_rate of the viscous damping against the affine flow, 1/s @param time_step s
  virtual void begin(const BoxPath<dim>& path, double damping_rate, const Loading& rotation,
                     double time_step) = 0;
  /// Contacts and forces at the positions as they are. No step.
  virtual void set_up() = 0;
  /// DEM steps, at least 1.
  virtual void run(int steps) = 0;
  /// Called now and then while it runs; may be empty.
  std::function<void()> progress;

  /// Weights of the grains in the mean rotation, adding up to 1 (mode 2; rotation_weights). Before the first step
  /// `hold_rotation` puts the torques that hold the mean to the forces of set_up.
  virtual void set_rotation_weights(std::span<const double> weights) = 0;
  virtual void hold_rotation() = 0;
  /// W_p over the volume: they add up to 1; empty without them.
  [[nodiscard]] virtual std::span<const double> weights() const = 0;
  /// Of the last force pass in the laboratory, Pa; zero in mode 1 (FixCellStrain::multiplier).
  [[nodiscard]] virtual typename Cosserat<dim>::Rotation multiplier() const = 0;

  [[nodiscard]] virtual const Box<dim>& box() const = 0;
  /// Of the last force pass; grains are counted from 0 as in the packing.
  [[nodiscard]] virtual std::span<const Contact> contacts() const = 0;
  /// Of the same contacts, without a list of them where the loop can do without.
  [[nodiscard]] virtual ContactSums<dim> contact_sums() const = 0;
  /// Resultants of the last force pass.
  [[nodiscard]] virtual Imbalance imbalance() const = 0;
  /// Rotations in the laboratory since the packing, rad.
  [[nodiscard]] virtual std::span<const double> rotations() const = 0;
  /// Places in the frame of the box, m.
  [[nodiscard]] virtual std::span<const double> places() const = 0;
  /// Of one grain, in the frame of the box; without its rotation.
  [[nodiscard]] virtual GrainMotion<dim> motion(int grain) const = 0;
};

}  // namespace polargrain::dem
