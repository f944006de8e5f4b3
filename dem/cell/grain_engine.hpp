// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "common/contact_library_file.hpp"
#include "common/packing.hpp"
#include "dem/cell/script_time_step.hpp"
#include "dem/cell/stock_laws.hpp"
#include "dem/contact/contact_recorder.hpp"
#include "dem/engine/engine.hpp"

namespace LAMMPS_NS {
class Fix;
}

namespace polargrain::dem {

/// One engine with one packing in a periodic box, whatever its dimension. DEM steps are taken without the engine's own
/// run, which prints and looks for lost grains only then.
class GrainEngine {
 public:
  /// Reads the packing through the user's script; then, once the box has been set, `start` is to be called. No forces
  /// are computed yet.
  /// @param script_file for messages only
  /// @param contact_library of contact laws of the user's own, or empty @throws RunError as add_contact_library
  /// @param after_script called before the contact models read their parameters
  GrainEngine(const Packing& packing, const std::string& script, const std::string& script_file,
              const ContactLibraryFile& contact_library, const std::function<void(Engine&)>& after_script);

  Engine& engine() { return engine_; }
  LAMMPS_NS::LAMMPS& lammps() { return engine_.lammps(); }

  /// Neighbours and forces at the positions as they are; contacts are recorded. No step.
  void set_up();
  /// Called every few DEM steps of a run; may be empty.
  std::function<void()> progress;
  /// DEM steps, at least 1; the contacts of the last force pass are recorded. Ends the process in the
  /// engine's words when a grain was lost.
  void run(int steps);
  [[nodiscard]] std::span<const Contact> contacts() const { return recorder_.contacts; }

  /// The time step from the recorded contacts, or the script's checked against them (ScriptTimeStep::settle).
  /// @param damping as CellControl::damping @returns a remark for the user, or nothing
  std::string settle_time_step(double damping);
  /// A shorter one where contacts have stiffened (ScriptTimeStep::shorten). @returns whether it was taken
  bool shorten_time_step(std::span<const Contact> stiffened, const Inertia& inertia, double damping_rate) {
    return time_step_->shorten(lammps(), stiffened, inertia, damping_rate);
  }
  /// The time step of a packing in the making (ScriptTimeStep::renew). @param now its contacts
  void renew_time_step(std::span<const Contact> now, const StiffestContact& stiffest, double damping_rate) {
    time_step_->renew(lammps(), now, stiffest, damping_rate, script_file_);
  }
  [[nodiscard]] bool script_sets_time_step() const { return time_step_->given(); }

  [[nodiscard]] int grains() const { return grains_; }
  [[nodiscard]] double mean_radius() const { return mean_radius_; }  ///< m
  [[nodiscard]] double mean_mass() const { return mean_mass_; }      ///< kg
  /// Rate of the viscous damping that is `fraction` of the critical one of a mean grain on one mean contact
  /// of those recorded, 1/s.
  [[nodiscard]] double damping_rate(double fraction) const;

 protected:
  /// The fix that carries the box.
  [[nodiscard]] LAMMPS_NS::Fix* strain_fix();
  void start();

 private:
  void check_grains();

  int grains_ = 0;
  double mean_radius_ = 0.0;
  double mean_mass_ = 0.0;
  std::string script_file_;
  Engine engine_;
  ContactRecorder& recorder_;
  std::optional<ScriptTimeStep> time_step_;
  std::optional<StockLaws> stock_laws_;
};

}  // namespace polargrain::dem
