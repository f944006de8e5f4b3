// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "dem/engine/engine.hpp"
#include "dem/engine/liggghts.hpp"

namespace polargrain::dem {

/// fix ID all pack/gravity
///
/// Lets the grains of a box fall along -x2 onto a smooth floor at x2 = 0, with the local damping of Cundall and Strack
/// (1979): each component of the force on a grain is less by a share of its magnitude where it drives the motion, and
/// more where it brakes it; torques alike. Unlike a viscous one it does not hold up grains that fall freely. Not for
/// scripts.
class FixGravity : public LAMMPS_NS::Fix {
 public:
  FixGravity(LAMMPS_NS::LAMMPS* lammps, int count, char** words);

  int setmask() override;
  void setup(int vflag) override { post_force(vflag); }
  void post_force(int vflag) override;
  /// As post_force, on spheres that the loop over spheres steps. @param grains, forces rows of SpherePass
  void act_on_rows(const double* grains, double* forces);

  /// @param acceleration m/s^2 @param floor_stiffness normal force of the floor over its overlap, N/m
  /// @param damping the share, 0 to 1
  void begin(double acceleration, double floor_stiffness, double damping);
  /// Sum of the magnitudes of the resultants of the last step, before damping, over the weight of all grains: 1 for
  /// grains that fall freely.
  [[nodiscard]] double unrest() const { return unrest_; }

 private:
  /// @param grain grain(k) is the k-th one, with pointers to its vectors
  template <typename GrainOf>
  void act(GrainOf grain);

  double acceleration_ = 0.0;
  double floor_stiffness_ = 0.0;
  double damping_ = 0.0;
  double unrest_ = 1.0;
};

/// Adds one to an engine whose grains have been read. It lives as long as the engine.
FixGravity& add_gravity(Engine& engine);

}  // namespace polargrain::dem
