// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include "dem/engine/engine.hpp"
#include "dem/engine/liggghts.hpp"
#include "dem/pack/pressed_box.hpp"

namespace polargrain::dem {

namespace {

/// @returns whether the script has the property for one atom type
bool set_property(Engine& engine, const char* name, double value) {
  const LAMMPS_NS::Fix* property = engine.lammps().modify->find_fix_property(
      name, "property/global", "peratomtypepair", 0, 0, "polargrain pack", false);
  if (property == nullptr) return false;
  // A fix given again under its name is replaced.
  engine.command(
      fmt::format("fix {} all property/global {} peratomtypepair 1 {:.17g}", property->id, name, value));
  return true;
}

}  // namespace

Packing pressed_together(Packing packing) {
  constexpr double kShrunk = 0.85;
  packing.box *= kShrunk;
  if (packing.dimension == 3) packing.thickness *= kShrunk;
  packing.lean *= kShrunk;
  for (Grain& grain : packing.grains) {
    grain.position *= kShrunk;
    grain.height *= kShrunk;
  }
  packing.state = nullptr;
  return packing;
}

void set_friction(Engine& engine, const MakingFriction& friction) {
  if (!set_property(engine, "coefficientFriction", friction.sliding) && friction.sliding > 0.0)
    engine.lammps().error->all(
        FLERR,
        "The packing is to be made with friction, but the script has no property/global "
        "coefficientFriction for one atom type");
  const double rolling = friction.rolling.value_or(0.0);
  if (friction.sliding > 0.0 && !friction.rolling) return;
  if (!set_property(engine, "coefficientRollingFriction", rolling) && rolling > 0.0)
    engine.lammps().error->all(
        FLERR,
        "The packing is to be made with rolling_friction, but the script has no property/global "
        "coefficientRollingFriction for one atom type: its contacts have no rolling model");
}

}  // namespace polargrain::dem
