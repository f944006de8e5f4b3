// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <utility>
#include <vector>

#include "dem/engine/liggghts.hpp"
#include "dem/specimen/further_springs.hpp"
#include "dem/specimen/membrane_chain.hpp"

namespace polargrain::dem {

/// fix ID all biaxial pressure P modulus E [damping Z] [thickness T] [probe R] [every N]
/// fix_modify ID compress RATE
///
/// A biaxial apparatus around discs in the x-y plane: two rigid smooth platens, across y, and on either side
/// a flexible membrane with the pressure P (Pa) on it. Made, it keeps P on the platens too: isotropic
/// compression. After `fix_modify compress RATE` the upper platen goes down at RATE (1/s) of the height it
/// has at the start of the next run; strains count from there. Its speed rises linearly over the first 1e-3
/// of strain, so that it starts no wave.
///
/// E    contact modulus of the platens (Pa): stiffness 2 E r against a disc of radius r, as a wall of the
///      normal model hooke/radii. The platens are smooth: no tangential force.
/// Z    damping ratio of the platens' contacts, 0.2; a grain that a membrane has left is braked as by one of
/// them
///      for 50 searches
/// T    thickness of the discs, m, 1; stresses are forces per thickness
/// R    radius of the probe that finds the grains under the membrane (dem/specimen/membrane_chain.hpp), m;
///      twice the greatest radius
/// N    steps between two searches for those grains, 20; their forces follow the grains every step. A grain
/// that
///      the membrane holds is let go when it has sunk in by 5 % of its radius
///
/// The platens start at the outermost grains. The lower one stays. While P is on the upper one it is a plate
/// of a tenth of the grains' mass with critical damping against the stiffness of the specimen.
///
/// Vector (global): 1 axial strain, 2 axial stress (Pa: P and the push of the platens beyond it, mean of both,
/// over the mean width; as a laboratory counts piston and cell pressure), 3 the same over P (stress ratio), 4
/// volume strain (dilation positive), 5 mean width (area / height, m), 6 height (m), 7 and 8 force of the
/// upper and the lower platen (N, as compression), 9 mean unbalanced force on a grain over P T d, d the mean
/// diameter, 10 grains under both membranes, 11 and 12 sum of the x forces of the left and the right membrane
/// (N). Compression of stress and strain is positive here, as in the laboratory.
///
/// Restarts: position and speed of the platen, its mode, the references and the grains under the membranes
/// are in the restart file. One process only.
class FixBiaxial : public LAMMPS_NS::Fix, public FurtherSprings {
 public:
  FixBiaxial(LAMMPS_NS::LAMMPS* lammps, int count, char** words);

  int setmask() override;
  void init() override;
  void setup(int vflag) override;
  void initial_integrate(int vflag) override;
  void post_force(int vflag) override;
  void end_of_step() override;
  double compute_vector(int index) override;
  int modify_param(int count, char** words) override;
  void write_restart(FILE* file) override;
  void restart(char* buffer) override;
  /// Contacts of the platens; the membranes as springs of P T in all directions, which is more than a
  /// pressure that follows its grains can do. The upper platen is a body of its mass while the pressure is on
  /// it.
  void add_springs(std::vector<Contact>& contacts, Inertia& inertia) const override;

 private:
  /// The content of a restart file.
  struct State {
    double bottom = 0.0;
    double top = 0.0;
    double top_velocity = 0.0;
    double rate = 0.0;  ///< 0: the pressure is on the platen
    double reference_height = 0.0;
    double reference_area = 0.0;
    double time = 0.0;    ///< since the start of the compression, s
    double placed = 0.0;  ///< whether the platens stand
  };

  void place_platens();
  void find_chains();
  void push_platens();
  void push_membrane();
  void brake_freed();
  void measure_unbalanced();
  [[nodiscard]] std::vector<Eigen::Vector2d> centres(const std::vector<int>& tags) const;
  [[nodiscard]] double height() const { return state_.top - state_.bottom; }
  [[nodiscard]] double area() const;
  /// Force of the upper and of the lower platen beyond the pressure on the width between the membranes there,
  /// N. At rest the two are equal, and each section of the specimen carries as much beyond the pressure.
  [[nodiscard]] std::pair<double, double> excess_forces() const;
  void move_under_pressure();

  double pressure_ = 0.0;
  double modulus_ = 0.0;
  double damping_ = 0.2;
  double thickness_ = 1.0;
  double probe_ = 0.0;
  int every_ = 20;
  State state_;
  std::vector<int> left_;  ///< tags of the grains under the membrane, bottom first
  std::vector<int> right_;
  std::vector<int> freed_;          ///< tags of those it has left lately, the earliest first
  std::vector<int> searches_left_;  ///< for which they are still braked
  double mean_diameter_ = 0.0;
  double grain_mass_ = 0.0;  ///< of all
  double top_force_ = 0.0;
  double bottom_force_ = 0.0;
  double left_force_ = 0.0;
  double right_force_ = 0.0;
  double unbalanced_ = 0.0;
};

}  // namespace polargrain::dem
