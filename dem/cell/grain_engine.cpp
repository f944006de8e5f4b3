// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/cell/grain_engine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "dem/cell/averages.hpp"
#include "dem/cell/packing_data.hpp"
#include "dem/contact/contact_library.hpp"
#include "dem/engine/liggghts.hpp"

namespace polargrain::dem {

namespace {
/// DEM steps between two calls of `progress`: 0.01 s with 400 grains.
constexpr int kProgressChunk = 100;
}  // namespace

GrainEngine::GrainEngine(const Packing& packing, const std::string& script, const std::string& script_file,
                         const ContactLibraryFile& contact_library,
                         const std::function<void(Engine&)>& after_script)
    : grains_(static_cast<int>(packing.grains.size())),
      script_file_(script_file),
      recorder_(contact_recorder(engine_.lammps())) {
  add_contact_library(contact_library);
  for (const Grain& grain : packing.grains) {
    mean_radius_ += grain.radius / grains_;
    mean_mass_ += grain.mass / grains_;
  }
  const PackingDataFile data(packing);
  data.define_variables(engine_);
  engine_.script(script, script_file);
  if (after_script) after_script(engine_);
  time_step_.emplace(engine_.lammps());
  engine_.command("fix polargrain_box all cell/strain");
  engine_.lammps().atom->sortfreq = 0;  // the order of the grains is part of the state
}

LAMMPS_NS::Fix* GrainEngine::strain_fix() {
  LAMMPS_NS::Modify& modify = *lammps().modify;
  return modify.fix[modify.find_fix("polargrain_box")];
}

void GrainEngine::start() {
  LAMMPS_NS::LAMMPS& lammps = engine_.lammps();
  stock_laws_.emplace(lammps);
  lammps.update->nsteps = 0;
  lammps.update->firststep = lammps.update->laststep = lammps.update->ntimestep;
  lammps.update->whichflag = 1;  // dynamics
  lammps.init();
}

void GrainEngine::set_up() {
  recorder_.contacts.clear();
  recorder_.on = true;
  lammps().update->integrate->setup_minimal(1);
  recorder_.on = false;
  stock_laws_->complete(recorder_.contacts);
}

void GrainEngine::run(int steps) {
  LAMMPS_NS::Update& update = *lammps().update;
  update.laststep = update.ntimestep + steps + 1;  // no step is the engine's last: it would print
  lammps().output->next = update.laststep;
  for (int left = steps - 1; left > 0; left -= kProgressChunk) {
    update.integrate->run(std::min(left, kProgressChunk));
    if (progress) progress();
  }
  recorder_.contacts.clear();
  recorder_.on = true;
  update.integrate->run(1);
  recorder_.on = false;
  stock_laws_->complete(recorder_.contacts);
  check_grains();
}

void GrainEngine::check_grains() {
  const LAMMPS_NS::Atom& atom = *lammps().atom;
  bool finite = true;
  for (int k = 0; k < atom.nlocal; ++k)
    finite = finite && std::isfinite(atom.x[k][0] + atom.x[k][1] + atom.x[k][2]);
  if (atom.nlocal == grains_ && finite) return;
  const std::string message = fmt::format(
      "Lost atoms: original {} current {}: the time step is too large for the stiffness of the contacts, or "
      "grains were pressed into each other",
      grains_, finite ? atom.nlocal : 0);
  lammps().error->all(FLERR, message.c_str());
}

std::string GrainEngine::settle_time_step(double damping) {
  return time_step_->settle(lammps(), contacts(), inertia_of(lammps()), damping_rate(damping), script_file_);
}

double GrainEngine::damping_rate(double fraction) const {
  return 2.0 * fraction * std::sqrt(mean_normal_stiffness(contacts()) / mean_mass_);
}

}  // namespace polargrain::dem
