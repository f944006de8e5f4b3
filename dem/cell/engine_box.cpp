// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/cell/engine_box.hpp"

#include "dem/cell/cell_state.hpp"
#include "dem/engine/liggghts.hpp"

namespace polargrain::dem {

EngineBox::EngineBox(Driver& driver) : driver_(driver) {
  driver_.progress = [this] {
    if (progress) progress();
  };
}

void EngineBox::restore(const State& state) {
  driver_.lammps().update->ntimestep = 0;  // nothing of an earlier path may show in this one
  RestoredState restored = restore_state(driver_.lammps(), state);
  driver_.strain().begin(BoxPath(restored.box, Eigen::Matrix2d::Zero(), 0), 0.0);
  restored_rotations_ = std::move(restored.rotations);
  driver_.strain().set_rotations(restored_rotations_);
}

StatePointer EngineBox::save() {
  return save_state(driver_.lammps(), driver_.strain().box().reduced(), driver_.strain().rotations());
}

void EngineBox::begin(const BoxPath& path, double damping_rate, std::optional<RotationLoading> rotation) {
  driver_.strain().begin(path, damping_rate, std::move(rotation));
}

void EngineBox::set_rotation_weights(std::span<const double> weights) {
  driver_.strain().set_rotation_weights(weights);
}

}  // namespace polargrain::dem
