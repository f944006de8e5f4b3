// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/sphere_loop/choose_box.hpp"

#include "dem/sphere_loop/engine_sphere_box.hpp"
#include "dem/sphere_loop/sphere_box.hpp"

namespace polargrain::dem {

std::unique_ptr<SpaceGrainBox> choose_box(SphereEngine& engine, CellLoop loop) {
  LAMMPS_NS::LAMMPS& lammps = engine.lammps();
  const DiscSelection selection = sphere_combination(lammps);
  if (loop == CellLoop::engine || !selection.combination) return std::make_unique<EngineSphereBox>(engine);
  const SphereKernels& kernels = sphere_kernels(best_instruction_set(), loop == CellLoop::plain);
  auto box = std::make_unique<SphereBox>(spheres_of(lammps, *selection.combination), kernels);
  const FixSpaceStrain& strain = engine.strain();
  box->restore(sphere_snapshot(lammps, *selection.combination, strain.box(), strain.rotations()));
  box->set_up();
  return box;
}

}  // namespace polargrain::dem
