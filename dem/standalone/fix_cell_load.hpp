// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <array>
#include <string>

#include "common/cell.hpp"
#include "dem/cell/cell_state.hpp"
#include "dem/cell/fix_cell_strain.hpp"

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
///
/// fix_modify ID state FILE                      goes on from a saved state
/// fix_modify ID increment h11 h12 h21 h22 w k1 k2    starts an increment; then `run` f_ID steps (loading)
/// and
///                                               20 at a time with `pre no` until f_ID[10] is 1
/// fix_modify ID report WORD                     prints the answer under that name
///
/// f_ID: DEM steps of the loading. f_ID[1..11]: s11 s22 s33 s12 s21 (Pa), m1 m2 (N/m), unbalanced force and
/// moment ratio, 1 when the increment is done, number of contacts; of the last step with output or of the
/// last full chunk of 20 steps.
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
  void read(int count, char** words);
  void find_mean_grain();
  /// Puts a state into the engine and the box to where it was.
  RestoredState go_on_from(StatePointer state);
  void begin_increment(const Increment& increment);
  void report(const char* name) const;
  [[nodiscard]] bool controlled() const { return control_.rotations == CellRotations::controlled; }
  /// A step after which a cell looks at its contacts.
  [[nodiscard]] bool ends_chunk() const;
  void renew_weights();
  void look();
  void start_recording();

  CellControl control_;
  double mean_mass_ = 0.0;
  double mean_radius_ = 0.0;
  double density_ = 0.0;
  double turned_ = 0.0;
  std::string packing_state_;
  double time_of_grain_ = 0.0;
  double rate_ = 0.0;         // of the damping, 1/s
  double least_force_ = 0.0;  // see unbalanced(), N
  StatePointer restored_;     // null once forces have been computed with it
  int loading_ = 0;
  int done_ = 0;  // steps of the increment
  std::array<double, 11> answer_{};
};

/// Makes the fixes for scripts of users known to the engine.
void register_standalone_fixes(LAMMPS_NS::Modify& modify);

}  // namespace polargrain::dem
