// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <array>
#include <string>

#include "common/cell.hpp"
#include "dem/cell/cell_state.hpp"
#include "dem/cell/quasi_static.hpp"
#include "dem/contact/contact_recorder.hpp"
#include "dem/spheres/fix_space_strain.hpp"

namespace polargrain::dem {

/// fix ID all cell/load keyword values ...   in a script of dimension 3
///
/// Takes a cell of spheres along increments in a script of the user's, by the very steps that a coupled run takes. It is
/// FixCellLoad for spheres, with the words of that but these:
///
///   frame Q11 Q12 ... Q33        rotation of the box against the laboratory, in place of turned (identity)
///
/// fix_modify ID increment takes the 21 numbers of a CellIncrement. f_ID[1..11] are as of discs, m1 and m2 being m13 and
/// m23; f_ID[12..15]: s13 s31 s23 s32 (Pa); f_ID[16..22]: m11 m22 m33 m12 m21 m31 m32 (N/m). The report tells s11 s12 s13
/// s21 ... s33, and couple stresses likewise, zero where rotations are free.
class FixSpaceLoad final : public FixSpaceStrain {
 public:
  FixSpaceLoad(LAMMPS_NS::LAMMPS* lammps, int count, char** words);

  int setmask() override;
  void post_create() override;
  void setup_pre_force(int vflag) override;
  void setup(int vflag) override;
  void pre_force(int vflag) override;
  void post_force(int vflag) override;
  int modify_param(int count, char** words) override;
  double compute_scalar() override { return protocol_.loading(); }
  double compute_vector(int place) override { return answer_.at(static_cast<std::size_t>(place)); }

 private:
  /// Puts a state into the engine and the box to where it was.
  void go_on_from(StatePointer state);
  void begin_increment(const CellIncrement& increment);
  void report(const char* name) const;
  void renew_weights();
  void look();
  void start_recording();

  ContactRecorder& recorder_;
  MeanGrain mean_;
  Eigen::Matrix3d frame_ = Eigen::Matrix3d::Identity();
  std::string packing_state_;
  QuasiStatic protocol_;
  StatePointer restored_;  // null once forces have been computed with it
  Eigen::Matrix3d stress_ = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d couple_stress_ = Eigen::Matrix3d::Zero();
  std::array<double, 22> answer_{};
};

}  // namespace polargrain::dem
