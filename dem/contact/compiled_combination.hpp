// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cstdint>

#include "dem/contact/pair_loop.hpp"
#include "dem/contact/recorded_model.hpp"
#include "dem/engine/liggghts.hpp"

namespace polargrain::dem {

template <typename Model>
LIGGGHTS::PairStyles::IGranularPairStyle* create_pair(LAMMPS_NS::LAMMPS* lammps, LAMMPS_NS::PairGran* parent,
                                                      int64_t hash) {
  return new PairLoop<RecordedModel<Model>>(lammps, parent, hash);
}

template <typename Model>
LIGGGHTS::Walls::IGranularWall* create_wall(LAMMPS_NS::LAMMPS* lammps, LAMMPS_NS::FixWallGran* parent,
                                            int64_t hash) {
  return new LIGGGHTS::Walls::Granular<Model>(lammps, parent, hash);
}

/// Makes a combination of contact models, compiled as one for speed, usable in `pair_style gran` and in walls
/// by the names of its models. Identifiers: those in the heads of the models' files.
template <int Normal, int Tangential, int Cohesion, int Rolling>
void add_compiled() {
  using namespace LIGGGHTS;                 // NOLINT: the engine's macros name its parts unqualified
  using namespace LIGGGHTS::ContactModels;  // NOLINT
  using Style = GranStyle<Normal, Tangential, Cohesion, Rolling, SURFACE_DEFAULT>;
  using Model = ContactModel<Style>;
  PairStyles::Factory::instance().addStyle("gran", Style::HASHCODE, &create_pair<Model>);
  Walls::Factory::instance().addStyle("gran", Style::HASHCODE, &create_wall<Model>);
}

}  // namespace polargrain::dem
