// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <optional>
#include <span>
#include <vector>

#include "dem/cell/box_motion.hpp"
#include "dem/cell/quasi_static.hpp"
#include "dem/contact/cell_loading.hpp"
#include "dem/engine/liggghts.hpp"

namespace polargrain::dem {

/// fix ID all cell/strain [damping RATE]
///
/// Carries the periodic box of a cell along a BoxPath, one DEM step at a time: the box follows the path, the
/// grains get the change of the affine velocity and spin at the start of each step (so that the assembly is
/// accelerated as a body and no wave starts at the faces), and images get the velocity of their face. The
/// affine spin is that of the continuum, or the prescribed one. When the box frame turns, spins are counted
/// from it. Rotations of the grains are free (mode 1 of docs/theory/grains.md, C.6).
///
/// damping RATE: viscous damping against the affine flow: a grain of mass m and moment of inertia I that
/// moves at v and spins at w loses RATE m (v - affine velocity) and RATE I (w - affine spin), in 1/s. Of the
/// dampings tried (local non-viscous, kinetic, viscous), it reaches a given unbalanced force with the fewest
/// steps and the smallest error (docs/performance.md).
///
/// With a RotationLoading (mode 2) the mean rotation of the grains is prescribed as well: each grain gets the
/// torque lambda W_p, with weights W_p = V w_p / sum w_p from the torque that its contacts can carry (w_p =
/// sum r_p f_n), and the multiplier lambda that makes sum W_p spin_p / V the prescribed mean spin, anew each
/// step. At rest lambda = sigma_21 - sigma_12.
///
/// Before damping, the sums of the unbalanced forces and torques of each step are kept for the read-out.
class FixCellStrain : public LAMMPS_NS::Fix {
 public:
  FixCellStrain(LAMMPS_NS::LAMMPS* lammps, int count, char** words);

  int setmask() override;
  void init() override;
  void setup(int vflag) override;
  void pre_initial_integrate() override;
  void post_integrate() override;
  void post_force(int vflag) override;

  /// Sets the path of the steps to come and puts the box at its start. Grains must be in that box already.
  /// @param rotation prescribed mean rotation; nothing leaves the rotations free (mode 1)
  void begin(const BoxPath& path, double damping_rate,
             std::optional<RotationLoading> rotation = std::nullopt);
  /// Grains, by local index, that are moved affinely and turned by the prescribed rotation and curvature
  /// instead of following their forces (mode 3); the curvature then acts through them alone. To be set after
  /// begin, with a RotationLoading.
  void hold(std::vector<bool> held) { held_ = std::move(held); }
  /// The reactions that hold them, by local index: force in the frame of the box, N, and moment, N m, at the last force
  /// pass.
  [[nodiscard]] std::span<const Eigen::Vector3d> reactions() const { return reactions_; }

  /// Rotations of the grains about e_3 in the laboratory, by local index, rad: from where they are, carried
  /// on through the steps of this and later paths; before, they count from zero.
  void set_rotations(std::span<const double> rotations) {
    rotations_.assign(rotations.begin(), rotations.end());
  }
  [[nodiscard]] std::span<const double> rotations() const { return rotations_; }
  /// Weights of the grains in the mean rotation, by local index, adding up to 1 (rotation_weights). To be set before the
  /// first force pass of a path with a RotationLoading, and as often as the forces have changed.
  void set_rotation_weights(std::span<const double> weights);
  [[nodiscard]] const Box& box() const { return motion_.box(); }
  [[nodiscard]] int grains() const { return atom->nlocal; }
  [[nodiscard]] double time_step() const { return update->dt; }

  [[nodiscard]] std::span<const double> weights() const { return weights_; }

  /// Resultants of the last force pass.
  [[nodiscard]] const Imbalance& imbalance() const { return imbalance_; }
  /// lambda of the last force pass, Pa: sigma_21 - sigma_12 that holds the mean rotation; 0 in mode 1.
  [[nodiscard]] double multiplier() const { return multiplier_; }

 private:
  void set_box(const Box& box);
  /// All grains and images get the change of the affine velocity gradient and spin of the step under way.
  void accelerate();
  void move_held_grains();
  void take_reactions();
  /// Treats the forces of a pass: sums for the read-out, damping, mean rotation.
  void balance(bool damped);
  /// The mean rotation is prescribed and there are grains to hold it with.
  [[nodiscard]] bool controlled() const { return motion_.rotation() && !weights_.empty(); }
  void sum_unbalanced_forces();
  void sum_unbalanced_moments();
  void damp();
  /// Adds lambda W to the torques; `contact_torques` are the sums of the contacts, before damping.
  void control_mean_rotation();

  CellLoading& loading_;
  BoxMotion motion_;
  double damping_rate_ = 0.0;
  double thickness_ = 0.0;
  std::vector<bool> held_;  ///< empty in modes 1 and 2
  std::vector<Eigen::Vector3d> reactions_;
  std::vector<double> weights_;          ///< W_p over the volume: they add up to 1
  std::vector<double> contact_torques_;  ///< about e_3, N m
  std::vector<double> rotations_;        ///< rad
  double multiplier_ = 0.0;
  Imbalance imbalance_;
};

}  // namespace polargrain::dem
