// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/cell/driver.hpp"

#include "common/error.hpp"
#include "dem/cell/cell_answers.hpp"
#include "dem/cell/cell_state.hpp"
#include "dem/cell/packing_check.hpp"
#include "dem/engine/liggghts.hpp"
#include "grains_io/packing_data.hpp"

namespace polargrain::dem {

namespace {
/// @throws RunError when the places of its grains cannot be those of a packing
const CellDefinition& sound(const CellDefinition& definition) {
  if (const std::string fault = geometry_fault(definition.packing); !fault.empty()) throw RunError(fault);
  return definition;
}
}  // namespace

template <int dim>
Driver<dim>::Driver(const Packing& packing, const std::string& script, const std::string& script_file,
                    const ContactLibraryFile& contact_library,
                    const std::function<void(Engine&)>& after_script)
    : GrainEngine(packing, script, script_file, contact_library, after_script),
      strain_(dynamic_cast<FixCellStrain<dim>*>(strain_fix())) {
  if constexpr (dim == 2) {
    depth_ = packing.thickness;
    for (const Grain& grain : packing.grains) grain_sizes_ += grain_size<2>(grain.radius);
  } else {
    grain_sizes_ = packing.grain_volume();
  }
  if (strain_ == nullptr)
    lammps().error->all(FLERR, dim == 3 ? "A packing of spheres in space needs a script with dimension 3"
                                        : "A packing of discs needs a script with dimension 2");
  Box<dim> box;
  if constexpr (dim == 2) {
    box = Box<2>::from_base_vectors(packing.box).reduced();
  } else {
    // The engine's own box, to the bit: who starts from its data file starts from the same.
    box = strain_->engine_box();
    box.orientation = frame_of_packing_data(packing);
  }
  strain_->begin(BoxPath<dim>(box), 0.0);
  start();
}

template <int dim>
Driver<dim>::Driver(const CellDefinition& definition)
    : Driver(sound(definition).packing, definition.script, definition.script_file,
             definition.contact_library) {
  if (!definition.packing.state) return;
  restore_packing([&] {
    if constexpr (dim == 2) {
      restore_state<2>(lammps(), *definition.packing.state);  // the box is the packing's
    } else {
      restore(*definition.packing.state);
    }
  });
}

template <int dim>
void Driver<dim>::restore(const State& state) {
  lammps().update->ntimestep = 0;  // nothing of an earlier path may show in this one
  const RestoredState<dim> restored = restore_state<dim>(lammps(), state);
  strain_->begin(BoxPath<dim>(restored.box), 0.0);
  strain_->set_rotations(restored.rotations);
}

template <int dim>
StatePointer Driver<dim>::save() {
  if constexpr (dim == 2) {
    return save_state(lammps(), strain_->box().reduced(), strain_->rotations());
  } else {
    strain_->fold();
    return save_state(lammps(), strain_->box(), strain_->rotations());
  }
}

template <int dim>
Equilibrium Driver<dim>::equilibrium() const {
  return equilibrium_of(contacts(), strain_->imbalance(), mean_radius(), 0.0, strain_->box().size(),
                        grain_sizes_);
}

template <int dim>
std::span<const double> Driver<dim>::places() {
  places_.clear();
  const LAMMPS_NS::Atom& atom = *lammps().atom;
  for (int k = 0; k < atom.nlocal; ++k) places_.insert(places_.end(), atom.x[k], atom.x[k] + dim);
  return places_;
}

template class Driver<2>;
template class Driver<3>;

}  // namespace polargrain::dem
