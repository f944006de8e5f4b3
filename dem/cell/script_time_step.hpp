// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <span>
#include <string>

#include "dem/cell/time_step.hpp"

namespace LAMMPS_NS {
class LAMMPS;
}

namespace polargrain::dem {

/// s; the engine is started with it, and takes no step before another one is known.
inline constexpr double kUntilContactsAreKnown = 1e-9;

/// Sets the time step of an engine and of all its parts that keep a copy, s.
void set_time_step(LAMMPS_NS::LAMMPS& lammps, double time_step);

/// Masses and moments of inertia of the grains as the engine's integrator has them.
Inertia inertia_of(const LAMMPS_NS::LAMMPS& lammps);

/// The owner of the time step of a scene: the script, or this program, from the contacts.
class ScriptTimeStep {
 public:
  /// After the script has been read, before the engine is initialised: without a step of the script's the
  /// engine gets one for the time being, as it starts without one.
  explicit ScriptTimeStep(LAMMPS_NS::LAMMPS& lammps);

  [[nodiscard]] bool given() const { return given_; }  ///< whether the script has a line `timestep`

  /// Takes the step that the contacts allow, or checks the script's against them; an unstable one ends the
  /// process with a message that tells a stable one. Without contacts nothing is done.
  /// @param damping_rate of the damping against the affine flow, 1/s @param where the user's script, for
  /// messages
  /// @returns a remark for the user when the script's step wastes more than a factor of three; else nothing
  std::string settle(LAMMPS_NS::LAMMPS& lammps, std::span<const Contact> contacts, const Inertia& inertia,
                     double damping_rate, const std::string& where) const;

  /// A shorter step where the contacts have stiffened so much that the present one is unstable, as those of Hertz do under
  /// more pressure, and the script leaves the step to this program. @returns whether the step was shortened
  bool shorten(LAMMPS_NS::LAMMPS& lammps, std::span<const Contact> contacts, const Inertia& inertia,
               double damping_rate) const;

  /// As settle, while a packing is made: bounds take the place of the eigenvalue, of the contacts there are and
  /// of grains among the stiffest contacts there have been. A step of the script's is refused when the
  /// contacts at hand do not bear it.
  void renew(LAMMPS_NS::LAMMPS& lammps, std::span<const Contact> contacts, const StiffestContact& stiffest,
             double damping_rate, const std::string& where) const;

 private:
  [[noreturn]] static void refuse(LAMMPS_NS::LAMMPS& lammps, double stable, const std::string& where);

  bool given_ = false;
};

/// Whether a step that was stable still is; costs little while there is room. @returns the fault, or
/// an empty text
std::string step_fault(std::span<const Contact> contacts, const Inertia& inertia, double damping_rate,
                       double time_step);

}  // namespace polargrain::dem
