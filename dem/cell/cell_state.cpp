// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/cell/cell_state.hpp"

#include <fmt/format.h>

#include <bit>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "common/error.hpp"
#include "dem/cell/packed_grains.hpp"
#include "dem/discs/disc_box.hpp"
#include "dem/engine/liggghts.hpp"
#include "dem/sphere_loop/sphere_box.hpp"

namespace polargrain::dem {

namespace {

LAMMPS_NS::PairGran& granular_pair(LAMMPS_NS::LAMMPS& lammps) {
  return *static_cast<LAMMPS_NS::PairGran*>(lammps.force->pair);
}

/// Moves contact histories from the neighbour list to the grains.
void gather_histories(LAMMPS_NS::LAMMPS& lammps) {
  if (auto* history = granular_pair(lammps).get_fix_history()) history->pre_exchange();
}

/// Mass and density of each grain by its tag. A packed grain carries them too, but they are the packing's
/// business, not the state's: states written before discs weighed what their packing says hold other ones.
class GrainMasses {
 public:
  explicit GrainMasses(const LAMMPS_NS::Atom& atom) : values_(static_cast<std::size_t>(atom.nlocal)) {
    for (int k = 0; k < atom.nlocal; ++k)
      if (const auto place = static_cast<std::size_t>(atom.tag[k] - 1); place < values_.size())
        values_[place] = {atom.rmass[k], atom.density[k]};
  }
  void put_back(LAMMPS_NS::Atom& atom) const {
    for (int k = 0; k < atom.nlocal; ++k)
      if (const auto place = static_cast<std::size_t>(atom.tag[k] - 1); place < values_.size())
        std::tie(atom.rmass[k], atom.density[k]) = values_[place];
  }

 private:
  std::vector<std::pair<double, double>> values_;
};

/// Values that a fix packs with a grain.
std::size_t packed_length(LAMMPS_NS::LAMMPS& lammps, LAMMPS_NS::Fix& fix, std::vector<double>& buffer) {
  if (lammps.atom->nlocal == 0) return 0;
  return static_cast<std::size_t>(fix.pack_exchange(0, buffer.data()));
}

/// Room for a grain with the most contacts that the engine allows.
std::vector<double> room_for_a_grain(const LAMMPS_NS::LAMMPS& lammps) {
  return std::vector<double>(32 + static_cast<std::size_t>(lammps.comm->maxexchange_fix) + 64);
}

/// As the engine's own grains are packed now; their histories are with them (gather_histories).
GrainLayout layout_of(LAMMPS_NS::LAMMPS& lammps) {
  LAMMPS_NS::Atom& atom = *lammps.atom;
  LAMMPS_NS::Fix* const history = granular_pair(lammps).get_fix_history();
  std::vector<double> buffer = room_for_a_grain(lammps);
  GrainLayout layout;
  layout.has_history = false;
  layout.history_values = static_cast<std::size_t>(granular_pair(lammps).dnum());
  layout.time_step = lammps.update->dt;
  layout.space = lammps.domain->dimension == 3;
  std::size_t before = 0;
  for (int k = 0; k < atom.nextra_grow; ++k) {
    LAMMPS_NS::Fix& fix = *lammps.modify->fix[atom.extra_grow[k]];
    if (&fix == history) {
      layout.has_history = true;
    } else if (std::string_view(fix.style).starts_with("contacthistory")) {
      throw RunError(fmt::format("fix {} keeps contacts of its own: states of such a cell cannot be taken up",
                                 fix.style));
    } else {
      (layout.has_history ? layout.tail : before) += packed_length(lammps, fix, buffer);
    }
  }
  // Length, place, velocity, tag, type, mask, image, radius, density, mass, spin: an atom_style granular.
  constexpr std::size_t kType = 8, kMask = 9, kRadius = 11, kSpin = 14, kOwn = 17;
  layout.head = kOwn + before;
  layout.spin = kSpin;
  layout.fixed = {kType, kMask, kRadius};
  layout.heads.resize(static_cast<std::size_t>(atom.nlocal));
  layout.radii.resize(layout.heads.size());
  for (int k = 0; k < atom.nlocal; ++k) {
    const auto length = static_cast<std::size_t>(atom.avec->pack_exchange(k, buffer.data()));
    const bool is_known = length >= layout.head + layout.tail &&
                          std::bit_cast<std::int64_t>(buffer[GrainLayout::kTag]) == atom.tag[k] &&
                          std::bit_cast<std::int64_t>(buffer[kType]) == atom.type[k] &&
                          buffer[kRadius] == atom.radius[k] && buffer[kSpin + 2] == atom.omega[k][2];
    const auto tag = static_cast<std::size_t>(atom.tag[k] - 1);
    if (!is_known || tag >= layout.heads.size())
      throw RunError("states of cells need atom_style granular, and grains counted from 1");
    layout.heads[tag].assign(buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(layout.head));
    layout.radii[tag] = atom.radius[k];
  }
  return layout;
}

}  // namespace

namespace {
/// The grains of the engine; their box and rotations are still to be set.
PackedGrains packed_grains(LAMMPS_NS::LAMMPS& lammps) {
  gather_histories(lammps);
  LAMMPS_NS::Atom& atom = *lammps.atom;
  std::vector<double> grain = room_for_a_grain(lammps);
  PackedGrains packed;
  packed.history_values = static_cast<std::size_t>(granular_pair(lammps).dnum());
  packed.values.reserve(static_cast<std::size_t>(atom.nlocal) * 48);
  for (int k = 0; k < atom.nlocal; ++k) {
    const int count = atom.avec->pack_exchange(k, grain.data());
    packed.values.insert(packed.values.end(), grain.begin(), grain.begin() + count);
  }
  return packed;
}
}  // namespace

template <int dim>
StatePointer save_state(LAMMPS_NS::LAMMPS& lammps, const Box<dim>& box, std::span<const double> rotations) {
  PackedGrains packed = packed_grains(lammps);
  if constexpr (dim == 2) {
    packed.box = box;
  } else {
    packed.space = box;
  }
  packed.rotations.assign(rotations.begin(), rotations.end());
  return encode(packed, static_cast<std::size_t>(lammps.atom->nlocal));
}

namespace {
void put_grains(LAMMPS_NS::LAMMPS& lammps, const LawCombination& models, const Snapshot<2>& discs) {
  put_discs(lammps, models, discs);
}
void put_grains(LAMMPS_NS::LAMMPS& lammps, const LawCombination& models, const Snapshot<3>& spheres) {
  put_spheres(lammps, models, spheres);
}

/// A state of the loop over discs or spheres, taken up by the engine's own.
template <int dim>
RestoredState<dim> restore_snapshot(LAMMPS_NS::LAMMPS& lammps, const State& state) {
  const LawSelection models = known_models(lammps);
  if (!models.combination) throw RunError("this state belongs to a cell of another input script");
  const Snapshot<dim> snapshot = decode_snapshot<dim>(state);
  put_grains(lammps, *models.combination, snapshot);
  RestoredState<dim> restored{snapshot.box, {}};
  for (const GrainMotion<dim>& grain : snapshot.grains)
    restored.rotations.insert(restored.rotations.end(), grain.turned.begin(), grain.turned.end());
  return restored;
}
}  // namespace

bool state_fits(LAMMPS_NS::LAMMPS& lammps, const State& state) {
  if (is_snapshot<2>(state) || is_snapshot<3>(state)) return false;
  try {
    const PackedGrains packed = decode_grains(state);
    return packed.grains() == static_cast<std::size_t>(lammps.atom->natoms) &&
           packed.history_values == static_cast<std::size_t>(granular_pair(lammps).dnum()) &&
           packed.space.has_value() == (lammps.domain->dimension == 3);
  } catch (const RunError&) {
    return false;
  }
}

template <int dim>
RestoredState<dim> restore_state(LAMMPS_NS::LAMMPS& lammps, const State& state) {
  if (is_snapshot<dim>(state)) return restore_snapshot<dim>(lammps, state);
  PackedGrains packed = decode_grains(state);
  gather_histories(lammps);
  check_records(packed, layout_of(lammps));
  LAMMPS_NS::Atom& atom = *lammps.atom;
  const GrainMasses masses(atom);
  atom.nlocal = 0;
  atom.nghost = 0;
  for (std::size_t k = 0; k < packed.grains(); ++k)
    atom.avec->unpack_exchange(&packed.values[packed.starts[k]]);
  masses.put_back(atom);
  packed.rotations.resize(packed.grains() * Cosserat<dim>::rotations, 0.0);
  if constexpr (dim == 2) {
    return {packed.box, std::move(packed.rotations)};
  } else {
    return {packed.space.value(), std::move(packed.rotations)};
  }
}

template StatePointer save_state(LAMMPS_NS::LAMMPS&, const Box<2>&, std::span<const double>);
template StatePointer save_state(LAMMPS_NS::LAMMPS&, const Box<3>&, std::span<const double>);
template RestoredState<2> restore_state(LAMMPS_NS::LAMMPS&, const State&);
template RestoredState<3> restore_state(LAMMPS_NS::LAMMPS&, const State&);

}  // namespace polargrain::dem
