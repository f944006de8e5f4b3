// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/cell/cell_state.hpp"

#include <cstring>
#include <tuple>
#include <utility>
#include <vector>

#include "common/error.hpp"
#include "dem/discs/disc_box.hpp"
#include "dem/engine/liggghts.hpp"

namespace polargrain::dem {

namespace {

/// First bytes of every state; plain numbers, so that another process of the same machine type reads it.
struct Header {
  std::uint64_t magic = 0;
  std::uint64_t grains = 0;
  std::uint64_t history_values = 0;  ///< per contact and side
  std::uint64_t values = 0;          ///< doubles of the packed grains; rotations may follow, one a grain
  Box box;
};
constexpr std::uint64_t kMagic = 0x31306c6c65636770ULL;  // "pgcell01" as bytes

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

}  // namespace

StatePointer save_state(LAMMPS_NS::LAMMPS& lammps, const Box& box, std::span<const double> rotations) {
  gather_histories(lammps);
  LAMMPS_NS::Atom& atom = *lammps.atom;
  // One grain is packed at a time; room for the most contacts the engine allows a grain.
  std::vector<double> grain(32 + static_cast<std::size_t>(lammps.comm->maxexchange_fix) + 64);
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(atom.nlocal) * 48);
  for (int k = 0; k < atom.nlocal; ++k) {
    const int count = atom.avec->pack_exchange(k, grain.data());
    values.insert(values.end(), grain.begin(), grain.begin() + count);
  }
  Header header;
  header.magic = kMagic;
  header.grains = static_cast<std::uint64_t>(atom.nlocal);
  header.history_values = static_cast<std::uint64_t>(granular_pair(lammps).dnum());
  header.values = values.size();
  header.box = box;
  values.insert(values.end(), rotations.begin(), rotations.end());
  std::vector<std::byte> bytes(sizeof(Header) + values.size() * sizeof(double));
  std::memcpy(bytes.data(), &header, sizeof(Header));
  std::memcpy(bytes.data() + sizeof(Header), values.data(), values.size() * sizeof(double));
  return std::make_shared<const State>(std::move(bytes));
}

namespace {
bool has_layout(LAMMPS_NS::LAMMPS& lammps, const Header& header) {
  return header.grains == static_cast<std::uint64_t>(lammps.atom->natoms) &&
         header.history_values == static_cast<std::uint64_t>(granular_pair(lammps).dnum());
}

/// A state of the loop over discs, taken up by the engine's own.
RestoredState restore_discs(LAMMPS_NS::LAMMPS& lammps, const State& state) {
  const DiscSelection models = disc_models(lammps);
  if (!models.combination) throw RunError("this state belongs to a cell of another input script");
  const DiscSnapshot snapshot = decode_discs(state);
  put_discs(lammps, *models.combination, snapshot);
  RestoredState restored{snapshot.box, {}};
  for (const DiscSnapshot::Motion& disc : snapshot.discs) restored.rotations.push_back(disc.turned);
  return restored;
}
}  // namespace

bool state_fits(LAMMPS_NS::LAMMPS& lammps, const State& state) {
  Header header;
  if (is_disc_state(state) || state.bytes().size() < sizeof(Header)) return false;
  std::memcpy(&header, state.bytes().data(), sizeof(Header));
  return header.magic == kMagic && has_layout(lammps, header);
}

RestoredState restore_state(LAMMPS_NS::LAMMPS& lammps, const State& state) {
  if (is_disc_state(state)) return restore_discs(lammps, state);
  Header header;
  const auto bytes = state.bytes();
  if (bytes.size() < sizeof(Header)) throw RunError("this is not the state of a cell: it is too short");
  std::memcpy(&header, bytes.data(), sizeof(Header));
  const std::size_t length = sizeof(Header) + header.values * sizeof(double);
  const std::size_t length_of_rotations = header.grains * sizeof(double);
  if (header.magic != kMagic || (bytes.size() != length && bytes.size() != length + length_of_rotations))
    throw RunError("this is not the state of a cell, or it was cut short");
  if (!has_layout(lammps, header))
    throw RunError("this state belongs to a cell of another packing or another input script");
  std::vector<double> values(header.values);
  std::memcpy(values.data(), bytes.data() + sizeof(Header), header.values * sizeof(double));

  gather_histories(lammps);
  LAMMPS_NS::Atom& atom = *lammps.atom;
  const GrainMasses masses(atom);
  atom.nlocal = 0;
  atom.nghost = 0;
  std::size_t place = 0;
  for (std::uint64_t k = 0; k < header.grains; ++k) {
    // The first value of a packed grain is its length.
    if (place >= values.size() || !(values[place] >= 1.0) ||
        values[place] > static_cast<double>(values.size() - place))
      throw RunError("this state of a cell is damaged");
    place += static_cast<std::size_t>(atom.avec->unpack_exchange(&values[place]));
  }
  masses.put_back(atom);
  RestoredState restored{header.box, std::vector<double>(header.grains, 0.0)};
  if (bytes.size() > length)
    std::memcpy(restored.rotations.data(), bytes.data() + length, length_of_rotations);
  return restored;
}

}  // namespace polargrain::dem
