// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/contact/contact_pair.hpp"

#include <fmt/format.h>

#include "dem/contact/cell_loading.hpp"
#include "dem/engine/engine.hpp"
#include "dem/engine/liggghts.hpp"

namespace polargrain::dem {

struct ContactPair::Engineroom {
  Engine engine;
};

namespace {

void set(double* target, const Eigen::Vector3d& value) {
  for (int axis = 0; axis < 3; ++axis) target[axis] = value(axis);
}

Eigen::Vector3d get(const double* source) {
  return {source[0], source[1], source[2]};
}

}  // namespace

ContactPair::ContactPair(const Definition& definition, const Place& start)
    : room_(std::make_unique<Engineroom>()) {
  Engine& engine = room_->engine;
  const double reach = 10.0 * (definition.radius_first + definition.radius_second);
  for (const std::string& line :
       {std::string("units si"), fmt::format("dimension {}", definition.dimension),
        std::string("atom_style granular"), std::string("atom_modify map array sort 0 0"),
        std::string(definition.dimension == 2 ? "boundary f f p" : "boundary f f f"),
        std::string("newton off"), std::string("communicate single vel yes"),
        definition.dimension == 2
            ? fmt::format("region box block {0:.17g} {1:.17g} {0:.17g} {1:.17g} {2:.17g} {3:.17g} units box",
                          -reach, reach, -0.1 * reach, 0.1 * reach)
            : fmt::format("region box block {0:.17g} {1:.17g} {0:.17g} {1:.17g} {0:.17g} {1:.17g} units box",
                          -reach, reach),
        std::string("create_box 1 box"),
        // Neighbours once and for all: the pair never parts by more than its own size.
        fmt::format("neighbor {:.17g} bin", 0.2 * reach),
        std::string("neigh_modify delay 1000000000 check no")})
    engine.command(line);
  for (const std::string& line : definition.model) engine.command(line);
  engine.command(fmt::format("timestep {:.17g}", definition.time_step));
  int number = 0;
  for (const auto& [centre, radius] :
       {std::pair(start.first, definition.radius_first), std::pair(start.second, definition.radius_second)}) {
    engine.command(fmt::format("create_atoms 1 single {:.17g} {:.17g} {:.17g} units box", centre.x(),
                               centre.y(), centre.z()));
    engine.command(fmt::format("set atom {} diameter {:.17g} density {:.17g}", ++number, 2.0 * radius,
                               definition.density));
  }
  engine.command("thermo 1000000000");
  engine.command("run 0");

  LAMMPS_NS::Update& update = *engine.lammps().update;
  update.whichflag = 1;  // dynamics: outside of a `run` the engine would take no step
  update.laststep = 1000000000;
  engine.lammps().output->next = update.laststep;
}

ContactPair::~ContactPair() = default;

void ContactPair::bend(const Eigen::Vector2d& curvature_rate) {
  cell_loading(room_->engine.lammps()).bend(Eigen::RowVector2d(curvature_rate.transpose()));
}

ContactPair::Answer ContactPair::advance(const Place& next, const Spins& spins) {
  LAMMPS_NS::LAMMPS& lammps = room_->engine.lammps();
  LAMMPS_NS::Atom& atom = *lammps.atom;
  const double time_step = lammps.update->dt;
  const int first = atom.map(1);
  const int second = atom.map(2);
  for (const auto& [grain, place, spin] :
       {std::tuple(first, next.first, spins.first), std::tuple(second, next.second, spins.second)}) {
    set(atom.v[grain], (place - get(atom.x[grain])) / time_step);
    set(atom.x[grain], place);
    set(atom.omega[grain], spin);
  }
  ContactRecorder& recorder = contact_recorder(lammps);
  recorder.on = true;
  recorder.contacts.clear();
  lammps.update->integrate->run(1);
  recorder.on = false;
  Answer answer{get(atom.f[first]), get(atom.torque[first]), get(atom.torque[second]), {}};
  if (!recorder.contacts.empty()) answer.contact = recorder.contacts.front();
  return answer;
}

}  // namespace polargrain::dem
