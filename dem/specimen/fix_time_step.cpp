// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/specimen/fix_time_step.hpp"

#include <fmt/format.h>

#include <cstring>
#include <string>
#include <vector>

#include "dem/cell/stock_laws.hpp"
#include "dem/engine/extension.hpp"
#include "dem/specimen/further_springs.hpp"

namespace polargrain::dem {

using LAMMPS_NS::Fix;
using LAMMPS_NS::LAMMPS;
namespace FixConst = LAMMPS_NS::FixConst;

namespace {

/// A step of the program's own is renewed once it is more than this of the stable one.
constexpr double kMargin = 0.95;

}  // namespace

FixTimeStep::FixTimeStep(LAMMPS* lammps, int count, char** words)
    : Fix(lammps, count, words), recorder_(contact_recorder(*lammps)) {
  restart_global = 1;
  const bool understood = count == 3 || (count == 5 && std::strcmp(words[3], "every") == 0);
  if (count == 5 && understood) every_ = force->inumeric(FLERR, words[4]);
  if (!understood || every_ < 1)
    error->all(
        FLERR,
        "Illegal fix time_step/contacts command: expected 'fix ID all time_step/contacts', with 'every "
        "N' or without, N steps from one look at the contacts to the next, at least 1");
  if (comm->nprocs > 1) error->all(FLERR, "Fix time_step/contacts runs in one process");
  step_.emplace(*lammps);
  own_ = update->dt;
}

int FixTimeStep::setmask() {
  return FixConst::PRE_FORCE | FixConst::POST_FORCE;
}

void FixTimeStep::init() {
  if (!force->pair || !force->pair_match("gran", 1))
    error->all(FLERR, "Fix time_step/contacts needs contact models: pair_style gran");
  bool found = false;
  for (int k = 0; k < modify->nfix; ++k) {
    const Fix* const other = modify->fix[k];
    found = found || other == this;
    if (found && dynamic_cast<const FurtherSprings*>(other) != nullptr)
      error->all(FLERR, fmt::format("Fix time_step/contacts must stand after fix {}, whose springs it counts",
                                    other->style)
                            .c_str());
    if (std::strncmp(other->style, "wall/", 5) == 0)
      error->all(FLERR,
                 fmt::format("Fix time_step/contacts does not know how stiff the walls of fix {} are: give a "
                             "'timestep' instead of it",
                             other->style)
                     .c_str());
  }
  // A line `timestep` after the fix, or between two runs.
  if (!step_->given() && update->dt != own_) step_.emplace(*lmp);
}

void FixTimeStep::start_recording() {
  recorder_.contacts.clear();
  recorder_.on = true;
}

void FixTimeStep::setup_pre_force(int) {
  start_recording();
}

void FixTimeStep::setup(int) {
  look();
}

void FixTimeStep::pre_force(int) {
  if (update->ntimestep % every_ == 0) start_recording();
}

void FixTimeStep::post_force(int) {
  if (recorder_.on) look();
}

void FixTimeStep::look() {
  recorder_.on = false;
  std::vector<Contact>& contacts = recorder_.contacts;
  StockLaws(*lmp).complete(contacts);
  Inertia inertia = inertia_of(*lmp);
  for (int k = 0; k < modify->nfix; ++k)
    if (const auto* const springs = dynamic_cast<const FurtherSprings*>(modify->fix[k]))
      springs->add_springs(contacts, inertia);
  if (contacts.empty()) {
    if (step_->given() || settled_) return;
    error->all(FLERR,
               "Fix time_step/contacts: no grain touches another yet, so the time step does not follow from "
               "the contacts: give a 'timestep'");
  }
  const std::string where = "the script";
  if (!settled_ && (step_->given() || own_ == kUntilContactsAreKnown)) {
    const std::string remark = step_->settle(*lmp, contacts, inertia, 0.0, where);
    own_ = update->dt;
    settled_ = true;
    say(fmt::format("time step {} s", own_));
    if (!remark.empty()) say(remark);
    return;
  }
  settled_ = true;
  const double viscous = longest_viscous_time(contacts);
  const double taken = update->dt;
  if (taken <= kMargin * stable_time_step(frequency_bound(contacts, inertia), viscous, 0.0)) return;
  const double stable = stable_time_step(largest_frequency(contacts, inertia), viscous, 0.0);
  if (step_->given()) {
    if (taken > stable) step_->settle(*lmp, contacts, inertia, 0.0, where);  // refuses it
    return;
  }
  if (taken <= kMargin * stable) return;
  own_ = chosen_time_step(stable);
  set_time_step(*lmp, own_);
  say(fmt::format("time step {} s from step {} on, no longer {} s: the contacts have stiffened", own_,
                  update->ntimestep, taken));
}

void FixTimeStep::say(const std::string& words) const {
  for (FILE* const file : {screen, logfile})
    if (file != nullptr) fmt::print(file, "polargrain: {}\n", words);
}

void FixTimeStep::write_restart(FILE* file) {
  if (comm->me != 0) return;
  const int size = sizeof(double);
  std::fwrite(&size, sizeof(int), 1, file);
  const double own = step_->given() ? 0.0 : own_;
  std::fwrite(&own, sizeof(double), 1, file);
}

void FixTimeStep::restart(char* buffer) {
  double own = 0.0;
  std::memcpy(&own, buffer, sizeof(double));
  if (own == 0.0 || step_->given()) return;
  own_ = own;
  set_time_step(*lmp, own_);
}

namespace {
const Extension kTimeStep = fix_extension<FixTimeStep>("time_step/contacts");
}  // namespace

}  // namespace polargrain::dem
