// SPDX-License-Identifier: GPL-2.0-or-later
// Grains weigh in the engine what their packing says: summed by the engine itself.
#include <group.h>
#include <gtest/gtest.h>

#include <cmath>

#include "dem/cell/cell_state.hpp"
#include "dem/cell/driver.hpp"
#include "dem/engine/liggghts.hpp"
#include "tests/support/cell_fixture.hpp"

namespace polargrain::dem {
namespace {

/// The engine's own sum over the grains (`mass(all)` in a script), kg.
double engine_mass(Driver<2>& driver) {
  return driver.lammps().group->mass(0);
}

double packing_mass(const Packing& packing) {
  double sum = 0.0;
  for (const Grain& grain : packing.grains) sum += grain.mass;
  return sum;
}

TEST(Masses, DiscsOfACellWeighWhatThePackingSays) {
  const CellDefinition cell = test::demo_cell();
  Driver<2> driver(cell.packing, cell.script, cell.script_file);
  driver.set_up();
  EXPECT_NEAR(packing_mass(cell.packing), 8.78, 0.01);  // 400 discs 0.1 m thick of 2650 kg/m^3
  EXPECT_NEAR(engine_mass(driver) / packing_mass(cell.packing), 1.0, 1e-12);
}

TEST(Masses, EachDiscTurnsWithHalfItsMassTimesTheRadiusSquared) {
  // A torque on one grain, a step, its spin: the engine's own moment of inertia. Grains far apart feel
  // nothing else.
  CellDefinition cell = test::demo_cell();
  cell.packing.box *= 2.0;
  for (Grain& grain : cell.packing.grains) grain.position *= 2.0;
  Driver<2> driver(cell.packing, cell.script, cell.script_file);
  driver.set_up();
  LAMMPS_NS::Atom& atom = *driver.lammps().atom;
  constexpr double kTorque = 1e-3;  // N m
  atom.torque[0][2] = kTorque;
  driver.run(1);  // half of a step's change before the new forces, of which there are none
  const Grain& grain = cell.packing.grains[static_cast<std::size_t>(atom.tag[0] - 1)];
  const double moment_of_inertia = 0.5 * driver.strain().time_step() * kTorque / atom.omega[0][2];
  EXPECT_NEAR(moment_of_inertia / grain.moment_of_inertia, 1.0, 1e-9);
}

TEST(Masses, SpheresInALayerWeighWhatThePackingSays) {
  CellDefinition cell = test::demo_cell();
  for (Grain& grain : cell.packing.grains) grain.mass = 2650.0 * 4.0 / 3.0 * M_PI * std::pow(grain.radius, 3);
  Driver<2> driver(cell.packing, cell.script, cell.script_file);
  EXPECT_NEAR(engine_mass(driver) / packing_mass(cell.packing), 1.0, 1e-12);
}

TEST(Masses, AStateOfHeavierGrainsLeavesThemTheirOwnMasses) {
  CellDefinition cell = test::demo_cell();
  StatePointer heavy;
  {
    CellDefinition other = cell;  // as states were written while discs weighed 0.75 / r times too much
    for (Grain& grain : other.packing.grains) grain.mass *= 0.75 / grain.radius;
    Driver<2> driver(other.packing, other.script, other.script_file);
    driver.set_up();
    heavy = save_state(driver.lammps(), driver.strain().box());
  }
  Driver<2> driver(cell.packing, cell.script, cell.script_file);
  restore_state<2>(driver.lammps(), *heavy);
  driver.set_up();
  driver.run(10);
  EXPECT_NEAR(engine_mass(driver) / packing_mass(cell.packing), 1.0, 1e-12);
}

}  // namespace
}  // namespace polargrain::dem
