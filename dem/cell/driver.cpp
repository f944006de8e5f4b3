// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/cell/driver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "dem/cell/averages.hpp"
#include "dem/cell/packing_data.hpp"
#include "dem/cell/quasi_static.hpp"
#include "dem/contact/contact_library.hpp"
#include "dem/engine/liggghts.hpp"

namespace polargrain::dem {

namespace {
/// DEM steps between two calls of `progress`: 0.01 s with 400 grains.
constexpr int kProgressChunk = 100;
}  // namespace

Driver::Driver(const Packing& packing, const std::string& script, const std::string& script_file,
               const ContactLibraryFile& contact_library, const std::function<void(Engine&)>& after_script)
    : grains_(static_cast<int>(packing.grains.size())),
      thickness_(packing.thickness),
      script_file_(script_file),
      recorder_(contact_recorder(engine_.lammps())) {
  add_contact_library(contact_library);
  for (const Grain& grain : packing.grains) {
    mean_radius_ += grain.radius / grains_;
    mean_mass_ += grain.mass / grains_;
    grain_area_ += std::numbers::pi * grain.radius * grain.radius;
  }
  const PackingDataFile data(packing);
  engine_.command(fmt::format("variable packing index {}", data.path()));
  engine_.script(script, script_file);
  if (after_script) after_script(engine_);
  time_step_.emplace(engine_.lammps());
  engine_.command("fix polargrain_box all cell/strain");

  LAMMPS_NS::LAMMPS& lammps = engine_.lammps();
  strain_ = dynamic_cast<FixCellStrain*>(lammps.modify->fix[lammps.modify->find_fix("polargrain_box")]);
  lammps.atom->sortfreq = 0;  // the order of the grains is part of the state
  strain_->begin(BoxPath(Box::from_base_vectors(packing.box).reduced(), Eigen::Matrix2d::Zero(), 0), 0.0);
  rolling_.emplace(lammps);
  lammps.update->nsteps = 0;
  lammps.update->firststep = lammps.update->laststep = lammps.update->ntimestep;
  lammps.update->whichflag = 1;  // dynamics
  lammps.init();
}

void Driver::set_up() {
  recorder_.contacts.clear();
  recorder_.on = true;
  lammps().update->integrate->setup_minimal(1);
  recorder_.on = false;
  rolling_->complete(recorder_.contacts);
}

void Driver::run(int steps) {
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
  rolling_->complete(recorder_.contacts);
  check_grains();
}

void Driver::check_grains() {
  const LAMMPS_NS::Atom& atom = *lammps().atom;
  bool finite = true;
  for (int k = 0; k < atom.nlocal; ++k)
    finite = finite && std::isfinite(atom.x[k][0]) && std::isfinite(atom.x[k][1]);
  if (atom.nlocal == grains_ && finite) return;
  const std::string message = fmt::format(
      "Lost atoms: original {} current {}: the time step is too large for the stiffness of the contacts, or "
      "grains were pressed into each other",
      grains_, finite ? atom.nlocal : 0);
  lammps().error->all(FLERR, message.c_str());
}

std::string Driver::settle_time_step(double damping) {
  return time_step_->settle(lammps(), contacts(), inertia_of(lammps()), damping_rate(damping), script_file_);
}

double Driver::volume() const {
  return strain_->box().area() * thickness_;
}

double Driver::damping_rate(double fraction) const {
  return 2.0 * fraction * std::sqrt(mean_normal_stiffness(contacts()) / mean_mass_);
}

Equilibrium Driver::equilibrium() const {
  return equilibrium_of(contacts(), strain_->imbalance(), mean_radius_, 0.0, strain_->box().area(),
                        grain_area_);
}

}  // namespace polargrain::dem
