// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <array>
#include <string>

#include "common/cell.hpp"
#include "dem/cell/cell_state.hpp"
#include "dem/cell/fix_cell_strain.hpp"
#include "dem/contact/contact_recorder.hpp"

namespace polargrain::dem {

/// fix ID all cell/load keyword values ...
///
/// Takes a cell along increments in a script of the user's, by the very steps that a coupled run takes. Give
/// it behind the packing, the contact models, the time step and the integrator; it looks at the packing at
/// rest at once, because damping and loading rate follow from its stiffness and pressure.
///
///   inertial_number I            loading rate (2e-4)
///   damping D                    fraction of the critical damping (0.02)
///   least_steps N                fewest DEM steps of an increment (20)
///   unbalanced F M               when the cell is at rest: force and moment ratio (5e-3 5e-3)
///   most_relaxation_steps N      then it counts as done all the same (20000)
///   rotations free|controlled    mode 1 or mode 2 of docs/theory/grains.md, C.6 (free)
///   mean_grain MASS RADIUS DENSITY   kg, m, kg/m^3; from the grains when left out, which may differ from the
///                                packing's own figures in the last bit
///   turned ANGLE                 rotation of the box against the laboratory, rad (0)
///   packing_state FILE           velocities and contact histories of the packing at rest
///   version N                    of the script (kReplayVersion); another than 1 and that one is refused
///
/// fix_modify ID state FILE                      goes on from a saved state
/// fix_modify ID increment NUMBERS               starts an increment; then `run` f_ID steps (loading) and
///                                               20 at a time with `pre no` until f_ID[10] is 1. NUMBERS: seven
///                                               in the plane, h11 h12 h21 h22 w k1 k2, or the 21 of a
///                                               CellIncrement, those out of the plane zero
/// fix_modify ID report WORD                     prints the answer under that name
///
/// f_ID: DEM steps of the loading. f_ID[1..11]: s11 s22 s33 s12 s21 (Pa), m1 m2 (N/m), unbalanced force and
/// moment ratio, 1 when the increment is done, number of contacts; of the last step with output or of the
/// last full chunk of 20 steps.
///
/// In a script of dimension 3 the same words make a FixSpaceLoad, of spheres.
class FixCellLoad final : public FixCellStrain {
 public:
  FixCellLoad(LAMMPS_NS::LAMMPS* lammps, int count, char** words);

  int setmask() override;
  void post_create() override;
  void setup_pre_force(int vflag) override;
  void setup(int vflag) override;
  void pre_force(int vflag) override;
  void post_force(int vflag) override;
  int modify_param(int count, char** words) override;
  double compute_scalar() override;
  double compute_vector(int place) override;

 private:
  /// Puts a state into the engine and the box to where it was.
  RestoredState go_on_from(StatePointer state);
  [[nodiscard]] Increment<2> read_increment(int count, char** words) const;
  void begin_increment(const Increment<2>& increment);
  void report(const char* name) const;
  void renew_weights();
  void look();
  void start_recording();

  ContactRecorder& recorder_;
  MeanGrain mean_;
  double turned_ = 0.0;
  std::string packing_state_;
  QuasiStatic protocol_;
  StatePointer restored_;  // null once forces have been computed with it
  std::array<double, 11> answer_{};
};

}  // namespace polargrain::dem
