// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/cell/state_fault.hpp"

#include <fmt/format.h>

#include "common/error.hpp"
#include "dem/box/snapshot.hpp"
#include "dem/cell/packed_grains.hpp"

namespace polargrain::dem {

namespace {

template <int dim>
void check_snapshot(const Packing& packing, const State& state) {
  const Snapshot<dim> snapshot = decode_snapshot<dim>(state);
  if (snapshot.grains.size() != packing.grains.size())
    throw RunError(fmt::format("this state is of {} grains; the cell has {}", snapshot.grains.size(),
                               packing.grains.size()));
  std::vector<double> radii;
  for (const Grain& grain : packing.grains) radii.push_back(grain.radius);
  if (const std::string fault = snapshot_fault(snapshot, radii, 0.0); !fault.empty()) throw RunError(fault);
}

void check_grains(const Packing& packing, const State& state) {
  const PackedGrains packed = decode_grains(state);
  if (packed.grains() != packing.grains.size())
    throw RunError(
        fmt::format("this state is of {} grains; the cell has {}", packed.grains(), packing.grains.size()));
  if (packed.space.has_value() != (packing.dimension == 3))
    throw RunError("this state is of another dimension than the cell");
  double area = 0.0;
  for (const Grain& grain : packing.grains) area += grain_size<2>(grain.radius);
  if (const std::string fault =
          packed.space ? box_fault(*packed.space, packing.grain_volume()) : box_fault(packed.box, area);
      !fault.empty())
    throw RunError(fault);
}

}  // namespace

std::string state_fault(const CellDefinition& definition, const State& state) {
  const Packing& packing = definition.packing;
  const std::size_t grains = packing.grains.size();
  if (state.size() < least_state_bytes(grains) || state.size() > most_state_bytes(grains))
    return fmt::format("a state has {} bytes; one of {} grains has {} to {}", state.size(), grains,
                       least_state_bytes(grains), most_state_bytes(grains));
  if (!state.is_here()) return {};
  // Such a cell never makes one; its loop would take up, with other contacts, whatever stands in it.
  const bool of_discs = is_snapshot<2>(state);
  const bool of_spheres = is_snapshot<3>(state);
  if (definition.control.loop == CellLoop::engine && (of_discs || of_spheres))
    return fmt::format("a state of the loop over {}, of a cell that runs in the engine's loop",
                       of_discs ? "discs" : "spheres");
  try {
    if (packing.dimension == 3 && of_discs)
      throw RunError("this state is of discs, and the cell is of spheres in space");
    if (packing.dimension == 2 && of_spheres)
      throw RunError("this state is of spheres in space, and the cell is of discs");
    if (of_spheres)
      check_snapshot<3>(packing, state);
    else if (of_discs)
      check_snapshot<2>(packing, state);
    else
      check_grains(packing, state);
  } catch (const RunError& error) {
    return error.what();
  }
  return {};
}

}  // namespace polargrain::dem
