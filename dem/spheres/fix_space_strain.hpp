// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "common/cell_increment.hpp"
#include "dem/cell/quasi_static.hpp"
#include "dem/contact/cell_loading.hpp"
#include "dem/engine/liggghts.hpp"
#include "dem/spheres/space_box.hpp"

namespace polargrain::dem {

/// The prescribed part of an increment: a path, and rotations where they are controlled.
struct SpaceLead {
  SpacePath path;
  std::optional<SpaceRotation> rotation;
};
/// Begins an increment of a box, of as many steps as the protocol says.
/// @throws RunError when the box would lose its volume, or the protocol takes no increment of that size
SpaceLead lead_along(QuasiStatic& protocol, const SpaceBox& box, const CellIncrement& increment,
                     double time_step);

/// fix ID all cell/space_strain
///
/// Carries the periodic box of a cell of spheres along a SpacePath, one DEM step at a time, as fix cell/strain does in
/// the plane. The grains get the change of the affine velocity and spin at the start of each step, images the velocity
/// of their face. The frame of the box turns; velocities and spins are counted from it. Viscous damping acts against
/// the affine flow: a grain of mass m and moment of inertia I that moves at v and spins at w loses rate m (v - affine
/// velocity) and rate I (w - affine spin). Rotations of the grains are free (mode 1 of docs/theory/grains.md, C.6), or,
/// with a SpaceRotation, their mean is prescribed (mode 2) as in FixCellStrain: torques lambda V weight on the grains,
/// lambda a vector anew each step. At rest lambda_k = - e_kij sigma_ij.
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
  /// @param damping_rate 1/s @param rotation prescribed mean rotation; nothing leaves the rotations free (mode 1)
  void begin(const SpacePath& path, double damping_rate,
             const std::optional<SpaceRotation>& rotation = std::nullopt);
  /// Begins an increment from the box as it is (lead_along).
  void lead(QuasiStatic& protocol, const CellIncrement& increment);
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
  /// Weights of the grains in the mean rotation, by local index, adding up to 1 (rotation_weights). To be set before the
  /// first force pass of a path with a SpaceRotation, and as often as the forces have changed.
  void set_rotation_weights(std::span<const double> weights) {
    weights_.assign(weights.begin(), weights.end());
  }
  /// lambda of the last force pass in the laboratory, Pa; zero in mode 1.
  [[nodiscard]] Eigen::Vector3d multiplier() const { return motion_.box().frame * multiplier_; }
  /// Resultants of the last force pass.
  [[nodiscard]] const Imbalance& imbalance() const { return imbalance_; }

 private:
  void set_box(const SpaceBox& box);
  void accelerate();
  /// Treats the forces of a pass: sums for the read-out, damping, mean rotation.
  void balance(bool damped);
  void damp();
  /// Adds lambda V weight to the torques.
  void control_mean_rotation();

  CellLoading& loading_;
  SpaceMotion motion_;
  double damping_rate_ = 0.0;
  std::vector<double> rotations_;
  std::vector<double> weights_;
  std::vector<Eigen::Vector3d> contact_torques_;          // before damping, N m
  Eigen::Vector3d multiplier_ = Eigen::Vector3d::Zero();  // in the frame of the box, Pa
  Imbalance imbalance_;
};

}  // namespace polargrain::dem
