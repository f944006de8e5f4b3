// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "common/packing.hpp"
#include "dem/cell/fix_cell_strain.hpp"
#include "dem/cell/quasi_static.hpp"
#include "dem/cell/script_time_step.hpp"
#include "dem/cell/stock_rolling.hpp"
#include "dem/contact/contact_recorder.hpp"
#include "dem/engine/engine.hpp"

namespace polargrain::dem {

/// One engine with one packing in a periodic box that follows a path: what cells and the making of packings
/// share. DEM steps are taken without the engine's own run, which prints and looks for lost grains only then.
class Driver {
 public:
  /// Reads the packing through the user's script and starts the engine; the box is the packing's, at rest. No
  /// forces are computed yet.
  /// @param script_file for messages only
  /// @param contact_library of contact laws of the user's own, or none @throws RunError as add_contact_library
  /// @param after_script called before the contact models read their parameters
  Driver(const Packing& packing, const std::string& script, const std::string& script_file,
         const ContactLibraryFile& contact_library = {},
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
  [[nodiscard]] std::span<const Contact> contacts() const { return recorder_.contacts; }
  /// Of the recorded contacts and the last force pass.
  [[nodiscard]] Equilibrium equilibrium() const;

  /// The time step from the recorded contacts, or the script's checked against them (ScriptTimeStep::settle).
  /// @param damping as CellControl::damping @returns a remark for the user, or nothing
  std::string settle_time_step(double damping);
  /// The time step of a packing in the making (ScriptTimeStep::renew).
  void renew_time_step(const StiffestContact& stiffest, double damping_rate) {
    time_step_->renew(lammps(), contacts(), stiffest, damping_rate, script_file_);
  }
  [[nodiscard]] bool script_sets_time_step() const { return time_step_->given(); }

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

  int grains_ = 0;
  double mean_radius_ = 0.0;
  double mean_mass_ = 0.0;
  double grain_area_ = 0.0;
  double thickness_ = 0.0;
  std::string script_file_;
  Engine engine_;
  ContactRecorder& recorder_;
  std::optional<ScriptTimeStep> time_step_;
  FixCellStrain* strain_ = nullptr;
  std::optional<StockRolling> rolling_;
};

}  // namespace polargrain::dem
