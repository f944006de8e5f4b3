// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <functional>
#include <span>
#include <string>

#include "common/packing.hpp"
#include "dem/cell/fix_cell_strain.hpp"
#include "dem/contact/contact_recorder.hpp"
#include "dem/engine/engine.hpp"

namespace polargrain::dem {

/// How near a packing is to rest, and how its grains touch.
struct Equilibrium {
  /// Mean unbalanced force on the grains that touch others, over the mean contact force; 0 without contacts.
  double unbalanced_force_ratio = 0.0;
  /// The same for moments, over the mean contact force times the mean radius.
  double unbalanced_moment_ratio = 0.0;
  double void_ratio = 0.0;           ///< in plane
  double coordination_number = 0.0;  ///< 2 contacts / grains
  double rattlers = 0.0;             ///< grains without a contact / grains
};

/// One engine with one packing in a periodic box that follows a path: what cells and the making of packings
/// share. DEM steps are taken without the engine's own run, which prints and looks for lost grains only then.
class Driver {
 public:
  /// Reads the packing through the user's script and starts the engine; the box is the packing's, at rest. No
  /// forces are computed yet.
  /// @param script_file for messages only
  /// @param after_script called before the contact models read their parameters
  Driver(const Packing& packing, const std::string& script, const std::string& script_file,
         const std::function<void(Engine&)>& after_script = {});

  Engine& engine() { return engine_; }
  LAMMPS_NS::LAMMPS& lammps() { return engine_.lammps(); }
  FixCellStrain& strain() { return *strain_; }
  [[nodiscard]] const FixCellStrain& strain() const { return *strain_; }

  /// Neighbours and forces at the positions as they are; contacts are recorded. No step.
  void set_up();
  /// Called every few DEM steps of a run; may be empty.
  std::function<void()> progress;
  /// DEM steps, at least 1; the contacts of the last force pass are recorded. Ends the process in the
  /// engine's words when a grain was lost.
  void run(int steps);
  [[nodiscard]] std::span<const Contact> contacts() const { return contact_recorder().contacts; }
  /// Mean contact force below which unbalanced forces are compared with this one instead, N (kLeastForce); 0
  /// until it is set.
  void set_least_force(double force) { least_force_ = force; }
  /// Of the recorded contacts and the last force pass.
  [[nodiscard]] Equilibrium equilibrium() const;

  [[nodiscard]] int grains() const { return grains_; }
  [[nodiscard]] double mean_radius() const { return mean_radius_; }  ///< m
  [[nodiscard]] double mean_mass() const { return mean_mass_; }      ///< kg
  [[nodiscard]] double grain_area() const { return grain_area_; }    ///< sum, m^2
  [[nodiscard]] double volume() const;                               ///< of the box now, m^3
  /// Rate of the viscous damping that is `fraction` of the critical one of a mean grain on one mean contact
  /// of those recorded, 1/s.
  [[nodiscard]] double damping_rate(double fraction) const;

 private:
  void check_grains();
  /// Rolling stiffness and limit of the recorded contacts, where the stock model epsd2 keeps them to itself.
  void complete_rolling();

  int grains_ = 0;
  double mean_radius_ = 0.0;
  double mean_mass_ = 0.0;
  double grain_area_ = 0.0;
  double thickness_ = 0.0;
  double least_force_ = 0.0;
  Engine engine_;
  FixCellStrain* strain_ = nullptr;
  LAMMPS_NS::Fix* rolling_friction_ =
      nullptr;  ///< coefficientRollingFriction; null unless the model is epsd2
};

}  // namespace polargrain::dem
