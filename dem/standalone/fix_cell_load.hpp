// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <array>
#include <string>

#include "common/cell.hpp"
#include "dem/cell/cell_state.hpp"
#include "dem/cell/fix_cell_strain.hpp"
#include "dem/cell/quasi_static.hpp"
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
///   turned ANGLE                 of discs: rotation of the box against the laboratory, rad (0)
///   frame Q11 Q12 ... Q33        of spheres: the same as a matrix (identity)
///   packing_state FILE           velocities and contact histories of the packing at rest
///   version N                    of the script (kReplayVersion); another than 1 and that one is refused
///
/// fix_modify ID state FILE                      goes on from a saved state
/// fix_modify ID increment NUMBERS               starts an increment; then `run` f_ID steps (loading) and
///                                               20 at a time with `pre no` until f_ID[10] is 1. NUMBERS: seven
///                                               in the plane, h11 h12 h21 h22 w k1 k2, or the 21 of a
///                                               CellIncrement, of discs those out of the plane zero
/// fix_modify ID report WORD                     prints the answer under that name: of discs s11 s22 s33 s12 s21 and
///                                               m1 m2, of spheres s11 s12 s13 s21 ... s33 and m11 ... m33
///
/// f_ID: DEM steps of the loading. f_ID[1..11]: s11 s22 s33 s12 s21 (Pa), m1 m2 (m13 m23; N/m), unbalanced force and
/// moment ratio, 1 when the increment is done, number of contacts; of spheres f_ID[12..15]: s13 s31 s23 s32 (Pa);
/// f_ID[16..22]: m11 m22 m33 m12 m21 m31 m32 (N/m). Of the last step with output or of the last full chunk of 20 steps;
/// couple stresses are zero where rotations are free.
///
/// The dimension of the script says whether the grains are discs (2) or spheres (3).
template <int dim>
class FixCellLoad final : public FixCellStrain<dim> {
 public:
  FixCellLoad(LAMMPS_NS::LAMMPS* lammps, int count, char** words);

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
  [[nodiscard]] Increment<dim> read_increment(int count, char** words) const;
  void begin_increment(const Increment<dim>& increment);
  void report(const char* name) const;
  void renew_weights();
  void look();
  void start_recording();
  [[nodiscard]] double pressure() const;

  using LAMMPS_NS::Pointers::atom;
  using LAMMPS_NS::Pointers::domain;
  using LAMMPS_NS::Pointers::error;
  using LAMMPS_NS::Pointers::force;
  using LAMMPS_NS::Pointers::lmp;
  using LAMMPS_NS::Pointers::output;
  using LAMMPS_NS::Pointers::update;

  ContactRecorder& recorder_;
  MeanGrain mean_;
  typename Box<dim>::Orientation orientation_ = Box<dim>::upright();
  std::string packing_state_;
  QuasiStatic protocol_;
  StatePointer restored_;  // null once forces have been computed with it
  QuasiStatic::ReadOut found_;
  std::array<double, 22> answer_{};
};

}  // namespace polargrain::dem
