// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include "common/cell.hpp"
#include "common/increment.hpp"
#include "dem/box/grain_box.hpp"
#include "dem/contact/contact_recorder.hpp"

namespace polargrain::dem {

/// Weights of the grains in the mean rotation (mode 2), W_p over the volume: the torque that the contacts of each
/// can carry, up to the coefficient of friction, over the sum of all. Zero with fewer than two contacts, or the
/// multiplier would spin up the grains that nothing holds. Empty when nothing carries any.
std::vector<double> rotation_weights(std::span<const Contact> contacts, int grains);

/// How far grains are from rest; see CellDiagnostics.
struct Unbalanced {
  double force_ratio = 0.0;   ///< 0 without contacts
  double moment_ratio = 0.0;  ///< 0 without contacts
  double carrying = 0.0;      ///< number of grains that touch others
};

/// Of the last force pass. @param mean_radius m
/// @param least_force the ratios are to the mean contact force, and to this when that is less, N
Unbalanced unbalanced(const Imbalance& imbalance, std::span<const Contact> contacts, double mean_radius,
                      double least_force);

/// How near a packing is to rest, and how its grains touch.
struct Equilibrium {
  /// Mean unbalanced force on the grains that touch others, over the mean contact force; 0 without contacts.
  double unbalanced_force_ratio = 0.0;
  /// The same for moments, over the mean contact force times the mean radius.
  double unbalanced_moment_ratio = 0.0;
  double void_ratio = 0.0;
  double coordination_number = 0.0;  ///< 2 contacts / grains
  double rattlers = 0.0;             ///< grains without a contact / grains
};

/// @param least_force see unbalanced @param box size of the box @param grain_sizes sum over the grains: m^2 in the
/// plane, m^3 in space
Equilibrium equilibrium_of(std::span<const Contact> contacts, const Imbalance& imbalance, double mean_radius,
                           double least_force, double box, double grain_sizes);

/// The prescribed part of an increment: a path, and rotations where they are controlled.
template <int dim>
struct Lead {
  BoxPath<dim> path;
  typename BoxMotion<dim>::Loading rotation;
};

/// The mean of the grains of a packing.
struct MeanGrain {
  double mass = 0.0;     ///< kg
  double radius = 0.0;   ///< m
  double density = 0.0;  ///< of the matter that grains are made of, kg/m^3
};

/// The quasi-static protocol of an increment (docs/theory/grains.md, G.3): load, relax, read out. It takes no steps: who
/// takes them, a cell that runs its grains or a fix in whose engine a script does, asks how many come next, says that
/// they are done, and looks at the contacts when told to, so that all take the same steps to the bit.
///
///     begin;  until loaded: steps_to_next_look, advance;  until ended: steps_to_next_look, advance;  read_out
///
/// With controlled rotations the weights of the mean rotation are renewed at every look.
class QuasiStatic {
 public:
  explicit QuasiStatic(const CellControl& control) : control_(control) {}

  /// How fast grains may be led and how they are damped follows from the packing at rest; before anything is begun.
  /// @param at_rest its contacts @param pressure that it carries, positive, Pa
  void take_scales(const MeanGrain& grain, std::span<const Contact> at_rest, double pressure);
  [[nodiscard]] double damping_rate() const { return damping_rate_; }  ///< against the affine flow, 1/s
  [[nodiscard]] double least_force() const {
    return least_force_;
  }  ///< see unbalanced(), N; 0 before take_scales

  /// Begins an increment of a box. @returns its path, of as many steps as the loading has, and the rotations
  /// @throws RunError when that is more than 1e9 steps, or the box would lose its area or volume
  template <int dim>
  Lead<dim> begin(const Box<dim>& box, const Increment<dim>& increment, double time_step);
  /// The rotations prescribed; empty where they are free.
  template <int dim>
  [[nodiscard]] typename BoxMotion<dim>::Loading rotation_of(const Increment<dim>& increment) const {
    if (!controlled()) return std::nullopt;
    return RotationLoading<dim>::of(increment);
  }
  [[nodiscard]] bool controlled() const { return control_.rotations == CellRotations::controlled; }

  [[nodiscard]] int steps_to_next_look() const;
  void advance(int steps) { done_ += steps; }
  /// Whether the steps done so far end with a look at the contacts.
  [[nodiscard]] bool looks_now() const;
  /// Of the increment: the largest of its principal strain, turn and curvature times mean diameter.
  [[nodiscard]] double size() const { return size_; }
  [[nodiscard]] int loading() const { return loading_; }  ///< DEM steps
  [[nodiscard]] int done() const { return done_; }        ///< DEM steps of this increment
  [[nodiscard]] int relaxed() const { return std::max(0, done_ - loading_); }
  [[nodiscard]] bool loaded() const { return done_ >= loading_; }
  [[nodiscard]] bool at_rest(double unbalanced_force_ratio, double unbalanced_moment_ratio) const {
    return unbalanced_force_ratio <= control_.unbalanced_force_ratio &&
           unbalanced_moment_ratio <= control_.unbalanced_moment_ratio;
  }
  /// At rest, or given up.
  [[nodiscard]] bool ended(double unbalanced_force_ratio, double unbalanced_moment_ratio) const {
    return loaded() && (at_rest(unbalanced_force_ratio, unbalanced_moment_ratio) ||
                        relaxed() >= control_.most_relaxation_steps);
  }

  /// Stress and couple stress of the contacts in the laboratory; no couple stress where rotations are free.
  /// @param frame of the box (frame_in_space) @param volume of the box, m^3
  struct ReadOut {
    Eigen::Matrix3d stress = Eigen::Matrix3d::Zero();         ///< Pa
    Eigen::Matrix3d couple_stress = Eigen::Matrix3d::Zero();  ///< N/m
  };
  [[nodiscard]] ReadOut read_out(std::span<const Contact> contacts, const Eigen::Matrix3d& frame,
                                 double volume) const;

 private:
  /// @param strain largest principal one, its magnitude @param turn of the grains against the continuum, rad
  /// @param curvature rad/m; where rotations are free neither it nor `turn` counts
  void begin(double strain, double turn, double curvature, double time_step);

  CellControl control_;
  double mean_radius_ = 0.0;
  double time_of_grain_ = 0.0;  // mean diameter * sqrt(density / pressure), s; inertial number = rate * this
  double damping_rate_ = 0.0;
  double least_force_ = 0.0;
  double size_ = 0.0;
  int loading_ = 0;
  int done_ = 0;
};

}  // namespace polargrain::dem
