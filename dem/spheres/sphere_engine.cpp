// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/spheres/sphere_engine.hpp"

#include "dem/cell/cell_answers.hpp"
#include "dem/cell/cell_state.hpp"
#include "dem/engine/liggghts.hpp"
#include "grains_io/packing_data.hpp"

namespace polargrain::dem {

SphereEngine::SphereEngine(const Packing& packing, const std::string& script, const std::string& script_file,
                           const ContactLibraryFile& contact_library,
                           const std::function<void(Engine&)>& after_script)
    : GrainEngine(packing, script, script_file, contact_library, after_script, "cell/space_strain"),
      strain_(dynamic_cast<FixSpaceStrain*>(strain_fix())) {
  // The engine's own box, to the bit: who starts from its data file starts from the same.
  SpaceBox box = strain_->engine_box();
  box.frame = frame_of_packing_data(packing);
  strain_->begin(SpacePath(box, Eigen::Matrix3d::Zero(), 0), 0.0);
  start();
}

SphereEngine::SphereEngine(const CellDefinition& definition)
    : SphereEngine(definition.packing, definition.script, definition.script_file,
                   definition.contact_library) {
  if (definition.packing.state) restore_packing([&] { restore(*definition.packing.state); });
}

void SphereEngine::restore(const State& state) {
  lammps().update->ntimestep = 0;  // nothing of an earlier path may show in this one
  const RestoredState restored = restore_state(lammps(), state);
  strain_->begin(SpacePath(restored.space.value(), Eigen::Matrix3d::Zero(), 0), 0.0);
  strain_->set_rotations(restored.rotations);
}

StatePointer SphereEngine::save() {
  strain_->fold();
  return save_state(lammps(), strain_->box(), strain_->rotations());
}

std::span<const double> SphereEngine::places() {
  return {lammps().atom->x[0], 3 * static_cast<std::size_t>(grains())};
}

SpaceMotionOfGrain SphereEngine::motion(int grain) {
  const LAMMPS_NS::Atom& atom = *lammps().atom;
  using Three = Eigen::Map<const Eigen::Vector3d>;
  return {Three(atom.x[grain]), Three(atom.v[grain]), Three(atom.omega[grain]), Eigen::Vector3d::Zero()};
}

}  // namespace polargrain::dem
