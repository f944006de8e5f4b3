// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <span>
#include <vector>

#include "dem/cell/quasi_static.hpp"
#include "dem/engine/liggghts.hpp"
#include "dem/spheres/space_box.hpp"

namespace polargrain::dem {

/// fix ID all cell/space_strain
///
/// Carries the periodic box of a cell of spheres along a SpacePath, one DEM step at a time: what fix cell/strain does in
/// the plane. The grains get the change of the affine velocity and spin at the start of each step, images the velocity
/// of their face. The frame of the box turns; velocities and spins are counted from it. Viscous damping acts against
/// the affine flow: a grain of mass m and moment of inertia I that moves at v and spins at w loses rate m (v - affine
/// velocity) and rate I (w - affine spin). Rotations of the grains are free (mode 1 of docs/theory/grains.md, C.6).
///
/// Before damping, the sums of the unbalanced forces and torques of each step are kept for the read-out.
class FixSpaceStrain : public LAMMPS_NS::Fix {
 public:
  FixSpaceStrain(LAMMPS_NS::LAMMPS* lammps, int count, char** words);

  int setmask() override;
  void init() override;
  void setup(int vflag) override;
  void pre_initial_integrate() override;
  void post_integrate() override;
  void post_force(int vflag) override;

  /// Sets the path of the steps to come and puts the box at its start. Grains must be in that box already.
  /// @param damping_rate 1/s
  void begin(const SpacePath& path, double damping_rate);
  /// Folds grains that have left the box back into its reduced description, and puts that in its place. Only at rest:
  /// velocities are not changed. Neighbours are to be set up anew.
  void fold();

  /// The box that the engine has, as if its frame were the laboratory.
  [[nodiscard]] SpaceBox engine_box() const;
  [[nodiscard]] const SpaceBox& box() const { return motion_.box(); }
  [[nodiscard]] double time_step() const { return update->dt; }
  [[nodiscard]] int grains() const { return atom->nlocal; }
  /// Rotations of the grains in the laboratory, three a grain by local index, rad: their spins added up, from where
  /// they are, carried on through the steps of this and later paths; before, they count from zero.
  void set_rotations(std::span<const double> rotations) {
    rotations_.assign(rotations.begin(), rotations.end());
  }
  [[nodiscard]] std::span<const double> rotations() const { return rotations_; }
  /// Resultants of the last force pass.
  [[nodiscard]] const Imbalance& imbalance() const { return imbalance_; }

 private:
  void set_box(const SpaceBox& box);
  void accelerate();
  void sum_unbalanced();
  void damp();

  SpaceMotion motion_;
  double damping_rate_ = 0.0;
  std::vector<double> rotations_;
  Imbalance imbalance_;
};

}  // namespace polargrain::dem
