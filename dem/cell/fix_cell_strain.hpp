// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <span>
#include <vector>

#include "dem/box/grain_box.hpp"
#include "dem/contact/cell_loading.hpp"
#include "dem/engine/liggghts.hpp"

namespace polargrain::dem {

/// fix ID all cell/strain [damping RATE]
///
/// Carries the periodic box of a cell along a BoxPath, one DEM step at a time: the box follows the path, the
/// grains get the change of the affine velocity and spin at the start of each step (so that the assembly is
/// accelerated as a body and no wave starts at the faces), and images get the velocity of their face. The
/// affine spin is that of the continuum, or the prescribed one. When the box frame turns, velocities and spins are
/// counted from it. Rotations of the grains are free (mode 1 of docs/theory/grains.md, C.6).
///
/// damping RATE: viscous damping against the affine flow: a grain of mass m and moment of inertia I that
/// moves at v and spins at w loses RATE m (v - affine velocity) and RATE I (w - affine spin), in 1/s. Of the
/// dampings tried (local non-viscous, kinetic, viscous), it reaches a given unbalanced force with the fewest
/// steps and the smallest error (docs/performance.md).
///
/// With a RotationLoading (mode 2) the mean rotation of the grains is prescribed as well: each grain gets the
/// torque lambda W_p, with weights W_p = V w_p / sum w_p from the torque that its contacts can carry (w_p =
/// sum r_p f_n), and the multiplier lambda that makes sum W_p spin_p / V the prescribed mean spin, anew each
/// step. At rest lambda_k = - e_kij sigma_ij: in the plane sigma_21 - sigma_12.
///
/// Before damping, the sums of the unbalanced forces and torques of each step are kept for the read-out.
template <int dim>
class FixCellStrain : public LAMMPS_NS::Fix {
 public:
  using Place = typename Box<dim>::Place;
  using Rotation = typename Cosserat<dim>::Rotation;
  using Loading = typename BoxMotion<dim>::Loading;

  FixCellStrain(LAMMPS_NS::LAMMPS* lammps, int count, char** words);

  int setmask() override;
  void init() override;
  void setup(int vflag) override;
  void pre_initial_integrate() override;
  void post_integrate() override;
  void post_force(int vflag) override;

  /// Sets the path of the steps to come and puts the box at its start. Grains must be in that box already.
  /// @param damping_rate 1/s @param rotation prescribed mean rotation; nothing leaves the rotations free (mode 1)
  void begin(const BoxPath<dim>& path, double damping_rate, const Loading& rotation = std::nullopt);
  /// Folds grains that have left the box back into its reduced description, and puts that in its place. Only at rest:
  /// velocities are not changed. Neighbours are to be set up anew.
  void fold();

  /// Rotations of the grains in the laboratory by local index, one a disc, three a sphere, rad: their spins added up from
  /// where they are, carried on through the steps of this and later paths; before, they count from zero.
  void set_rotations(std::span<const double> rotations) {
    rotations_.assign(rotations.begin(), rotations.end());
  }
  [[nodiscard]] std::span<const double> rotations() const { return rotations_; }
  /// Weights of the grains in the mean rotation, by local index, adding up to 1 (rotation_weights). To be set before the
  /// first force pass of a path with a RotationLoading, and as often as the forces have changed.
  void set_rotation_weights(std::span<const double> weights) {
    weights_.assign(weights.begin(), weights.end());
  }
  [[nodiscard]] std::span<const double> weights() const { return weights_; }
  [[nodiscard]] const Box<dim>& box() const { return motion_.box(); }
  /// The box that the engine has, as if its frame were the laboratory.
  [[nodiscard]] Box<dim> engine_box() const;
  /// Of the box, m^3.
  [[nodiscard]] double volume() const { return box().size() * depth_; }
  [[nodiscard]] int grains() const { return atom->nlocal; }
  [[nodiscard]] double time_step() const { return update->dt; }

  /// Resultants of the last force pass.
  [[nodiscard]] const Imbalance& imbalance() const { return imbalance_; }
  /// lambda of the last force pass in the laboratory, Pa; zero in mode 1.
  [[nodiscard]] Rotation multiplier() const;

 private:
  using ThisPlace = Eigen::Map<Place>;
  using ThisRotation = Eigen::Map<Rotation>;
  [[nodiscard]] ThisPlace place(int k) const { return ThisPlace(atom->x[k]); }
  [[nodiscard]] ThisPlace velocity(int k) const { return ThisPlace(atom->v[k]); }
  [[nodiscard]] ThisPlace force_on(int k) const { return ThisPlace(atom->f[k]); }
  [[nodiscard]] ThisRotation spin(int k) const { return about_axes(atom->omega[k]); }
  [[nodiscard]] ThisRotation torque_on(int k) const { return about_axes(atom->torque[k]); }
  /// The components of three that discs or spheres turn by.
  static ThisRotation about_axes(double* three) { return ThisRotation(three + Cosserat<dim>::axis(0)); }
  [[nodiscard]] double inertia(int k) const {
    constexpr double over_m_r2 = dim == 2 ? 0.5 : 0.4;  // disc, sphere
    return over_m_r2 * atom->rmass[k] * atom->radius[k] * atom->radius[k];
  }

  void set_box(const Box<dim>& box);
  /// All grains and images get the change of the affine velocity gradient and spin of the step under way.
  void accelerate();
  /// Treats the forces of a pass: sums for the read-out, damping, mean rotation.
  void balance(bool damped);
  /// The mean rotation is prescribed and there are grains to hold it with.
  [[nodiscard]] bool controlled() const { return motion_.rotation_is_prescribed() && !weights_.empty(); }
  void damp();
  /// Adds lambda W to the torques.
  void control_mean_rotation();

  CellLoading& loading_;
  BoxMotion<dim> motion_;
  double damping_rate_ = 0.0;
  double depth_ = 1.0;                      // of a plane box along x3, m; 1 in space
  std::vector<double> weights_;             // W_p over the volume: they add up to 1
  std::vector<double> rotations_;           // rad
  std::vector<Rotation> contact_torques_;   // before damping, N m
  Rotation multiplier_ = Rotation::Zero();  // in the frame of the box, Pa
  Imbalance imbalance_;
};

}  // namespace polargrain::dem
