// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "dem/engine/liggghts.hpp"

namespace polargrain::dem {

/// fix ID all layer lower GROUP upper GROUP pressure P modulus E [thickness T]
/// fix_modify ID shear RATE
///
/// A layer of discs in the x-y plane, periodic along x, between two rough plates: grains of the two groups, glued to each
/// other, that do not turn. The lower plate stays. The upper one carries the normal stress P (Pa) on the width of the box
/// and goes up and down as the layer dilates. After `fix_modify shear RATE` it moves along +x at RATE (1/s) times the
/// height it has at the start of the next run; displacements count from there. Its speed rises linearly over the first 1e-3
/// of shear, so that it starts no wave.
///
/// E    contact modulus of the grains (Pa, as of the normal model hooke/radii): the upper plate has the mass of its grains
///      and is damped against the stiffness of the layer, critically before the shear and by a twentieth of that in it
/// T    thickness of the discs, m, 1; of a layer of spheres its depth along z; stresses are forces per thickness
///
/// Vector (global): 1 shear (displacement of the upper plate over the height at the start), 2 that displacement (m), 3 shear
/// stress s21 (Pa, mean over the two plates), 4 the same over P, 5 normal stress on the lower plate over P
/// (compression positive), 6 rise of the upper plate since the start of the shear (m), 7 height between the grains of
/// the plates nearest to each other, centre to centre (m), 8 and 9 force along x on the upper and the lower plate (N), 10 mean
/// unbalanced force on a free grain over P T d, of spheres P d^2, d the mean diameter.
///
/// Restarts: speed of the plate, its mode and the references are in the restart file. One process only.
class FixLayer : public LAMMPS_NS::Fix {
 public:
  FixLayer(LAMMPS_NS::LAMMPS* lammps, int count, char** words);

  int setmask() override;
  void init() override;
  void setup(int vflag) override;
  void post_force(int vflag) override;
  double compute_vector(int index) override;
  int modify_param(int count, char** words) override;
  void write_restart(FILE* file) override;
  void restart(char* buffer) override;

 private:
  /// The content of a restart file.
  struct State {
    double velocity_x = 0.0;  ///< of the upper plate
    double velocity_y = 0.0;
    double rate = 0.0;              ///< 0: no shear
    double reference_height = 0.0;  ///< at the start of the shear; 0: not begun
    double displacement = 0.0;      ///< since then, m
    double time = 0.0;              ///< since then, s
  };

  [[nodiscard]] double height() const;
  [[nodiscard]] double width() const;
  /// Of what a grain takes up along z: a disc the thickness, a sphere a diameter, m.
  [[nodiscard]] double depth_of_grain() const;
  /// Takes the forces off the grains of the plates, which move with their plate.
  void hold_plates();
  void move_upper_plate();

  int lower_ = 0;  ///< bits of the groups
  int upper_ = 0;
  double pressure_ = 0.0;
  double modulus_ = 0.0;
  double thickness_ = 1.0;
  State state_;
  double plate_mass_ = 0.0;
  double mean_diameter_ = 0.0;
  double force_x_upper_ = 0.0;
  double force_y_upper_ = 0.0;
  double force_x_lower_ = 0.0;
  double force_y_lower_ = 0.0;
  double unbalanced_ = 0.0;
};

}  // namespace polargrain::dem
