// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "dem/engine/liggghts.hpp"

namespace polargrain::dem {

/// fix ID group grain/rotation
///
/// Adds up the spins of grains about the z axis: the angle by which each has turned since the fix was made,
/// rad, counter-clockwise. Per-atom vector `f_ID` (for dumps). Restarts carry it on.
class FixGrainRotation : public LAMMPS_NS::Fix {
 public:
  FixGrainRotation(LAMMPS_NS::LAMMPS* lammps, int count, char** words);
  ~FixGrainRotation() override;

  int setmask() override;
  void initial_integrate(int vflag) override;

  void grow_arrays(int most) override;
  void copy_arrays(int from, int to, int delete_flag) override;
  void set_arrays(int index) override;
  int pack_exchange(int index, double* buffer) override;
  int unpack_exchange(int index, double* buffer) override;
  int pack_restart(int index, double* buffer) override;
  void unpack_restart(int index, int nth) override;
  int size_restart(int index) override;
  int maxsize_restart() override;

 private:
  double* angle_ = nullptr;
};

}  // namespace polargrain::dem
