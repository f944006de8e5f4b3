// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/cell/script_time_step.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "dem/engine/liggghts.hpp"

namespace polargrain::dem {

namespace {

/// A step of a script may be so many times smaller than the program's own before that is worth a word.
constexpr double kWaste = 3.0;

/// Contacts that the lightest grain of a packing in the making may come to have all around: equal discs have
/// six neighbours at most. Spheres could have twelve; packings have six on average.
constexpr double kNeighbours = 6.0;
constexpr double kNeighboursInSpace = 8.0;

}  // namespace

void set_time_step(LAMMPS_NS::LAMMPS& lammps, double time_step) {
  lammps.update->dt = time_step;
  lammps.update->timestep_set = true;
  if (lammps.update->integrate != nullptr) lammps.update->integrate->reset_dt();
  if (lammps.force->pair != nullptr) lammps.force->pair->reset_dt();
  for (int k = 0; k < lammps.modify->nfix; ++k) lammps.modify->fix[k]->reset_dt();
}

Inertia inertia_of(const LAMMPS_NS::LAMMPS& lammps) {
  const LAMMPS_NS::Atom& atom = *lammps.atom;
  Inertia inertia;
  inertia.space = lammps.domain->dimension == 3;
  const double shape = inertia.space ? 0.4 : 0.5;  // fix nve/sphere turns grains of a plane scene as discs
  for (int k = 0; k < atom.nlocal; ++k) {
    inertia.masses.push_back(atom.rmass[k]);
    inertia.radii.push_back(atom.radius[k]);
    inertia.moments.push_back(shape * atom.rmass[k] * atom.radius[k] * atom.radius[k]);
  }
  return inertia;
}

ScriptTimeStep::ScriptTimeStep(LAMMPS_NS::LAMMPS& lammps) : given_(lammps.update->timestep_set) {
  if (!given_) set_time_step(lammps, kUntilContactsAreKnown);
}

std::string ScriptTimeStep::settle(LAMMPS_NS::LAMMPS& lammps, std::span<const Contact> contacts,
                                   const Inertia& inertia, double damping_rate,
                                   const std::string& where) const {
  if (contacts.empty()) return {};
  const double stable =
      stable_time_step(largest_frequency(contacts, inertia), longest_viscous_time(contacts), damping_rate);
  const double chosen = chosen_time_step(stable);
  const double given = lammps.update->dt;
  if (!given_) {
    set_time_step(lammps, chosen);
    return {};
  }
  if (given > stable) refuse(lammps, stable, where);
  if (given * kWaste < chosen)
    return fmt::format(
        "the time step of {}, {:.3g} s, makes {:.1f} times as many DEM steps as are needed: leave the "
        "line 'timestep' out, and {:.3g} s is taken",
        where, given, chosen / given, chosen);
  return {};
}

bool ScriptTimeStep::shorten(LAMMPS_NS::LAMMPS& lammps, std::span<const Contact> contacts,
                             const Inertia& inertia, double damping_rate) const {
  if (given_ || step_fault(contacts, inertia, damping_rate, lammps.update->dt).empty()) return false;
  const double stable =
      stable_time_step(largest_frequency(contacts, inertia), longest_viscous_time(contacts), damping_rate);
  set_time_step(lammps, chosen_time_step(stable));
  return true;
}

void ScriptTimeStep::renew(LAMMPS_NS::LAMMPS& lammps, std::span<const Contact> contacts,
                           const StiffestContact& stiffest, double damping_rate,
                           const std::string& where) const {
  const Inertia inertia = inertia_of(lammps);
  const double bound = frequency_bound(contacts, inertia);
  const double given = lammps.update->dt;
  if (given_) {
    if (given <= stable_time_step(bound, stiffest.viscous_time, damping_rate)) return;
    const double stable =
        stable_time_step(largest_frequency(contacts, inertia), stiffest.viscous_time, damping_rate);
    if (given > stable) refuse(lammps, stable, where);
    return;
  }
  const double neighbours = inertia.space ? kNeighboursInSpace : kNeighbours;
  const double frequency = std::max(bound, stiffest.crowded_frequency(inertia, neighbours));
  if (frequency > 0.0)
    set_time_step(lammps, chosen_time_step(stable_time_step(frequency, stiffest.viscous_time, damping_rate)));
}

void ScriptTimeStep::refuse(LAMMPS_NS::LAMMPS& lammps, double stable, const std::string& where) {
  lammps.error->all(
      FLERR,
      fmt::format(
          "The time step of {}, {:.3g} s, is unstable for these grains and contacts: the largest stable one "
          "is {:.3g} s. Leave the line 'timestep' out, and {:.3g} s is taken",
          where, lammps.update->dt, stable, chosen_time_step(stable))
          .c_str());
  std::abort();  // not reached: an engine error ends the process
}

std::string step_fault(std::span<const Contact> contacts, const Inertia& inertia, double damping_rate,
                       double time_step) {
  const double viscous_time = longest_viscous_time(contacts);
  if (time_step <= stable_time_step(frequency_bound(contacts, inertia), viscous_time, damping_rate))
    return {};
  const double stable = stable_time_step(largest_frequency(contacts, inertia), viscous_time, damping_rate);
  if (time_step <= stable) return {};
  return fmt::format(
      "the contacts have stiffened: the time step of {:.3g} s is beyond the largest stable one, {:.3g} s; "
      "write a smaller 'timestep' in the script",
      time_step, stable);
}

}  // namespace polargrain::dem
