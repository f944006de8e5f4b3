// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/cell/state_fault.hpp"

#include <fmt/format.h>

#include <numbers>

#include "common/error.hpp"
#include "dem/cell/packed_grains.hpp"
#include "dem/cell/state_bounds.hpp"
#include "dem/discs/disc_state.hpp"
#include "dem/sphere_loop/sphere_state.hpp"

namespace polargrain::dem {

namespace {

void check_discs(const Packing& packing, double area, const State& state) {
  const DiscSnapshot snapshot = decode_discs(state);
  if (snapshot.discs.size() != packing.grains.size())
    throw RunError(fmt::format("this state is of {} grains; the cell has {}", snapshot.discs.size(),
                               packing.grains.size()));
  if (const std::string fault = box_fault(snapshot.box, area); !fault.empty()) throw RunError(fault);
  for (std::size_t k = 0; k < snapshot.discs.size(); ++k) {
    const std::string fault = motion_fault(snapshot.box, k, snapshot.discs[k], packing.grains[k].radius, 0.0);
    if (!fault.empty()) throw RunError(fault);
  }
}

void check_grains(const Packing& packing, double area, const State& state) {
  const PackedGrains packed = decode_grains(state);
  if (packed.grains() != packing.grains.size())
    throw RunError(
        fmt::format("this state is of {} grains; the cell has {}", packed.grains(), packing.grains.size()));
  if (packed.space.has_value() != (packing.dimension == 3))
    throw RunError("this state is of another dimension than the cell");
  if (const std::string fault =
          packed.space ? box_fault(*packed.space, packing.grain_volume()) : box_fault(packed.box, area);
      !fault.empty())
    throw RunError(fault);
}

void check_spheres(const Packing& packing, const State& state) {
  const SphereSnapshot snapshot = decode_spheres(state);
  if (snapshot.spheres.size() != packing.grains.size())
    throw RunError(fmt::format("this state is of {} grains; the cell has {}", snapshot.spheres.size(),
                               packing.grains.size()));
  std::vector<double> radii;
  for (const Grain& grain : packing.grains) radii.push_back(grain.radius);
  if (const std::string fault = snapshot_fault(snapshot, radii, 0.0); !fault.empty()) throw RunError(fault);
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
  if (definition.control.loop == CellLoop::engine && (is_disc_state(state) || is_sphere_state(state)))
    return fmt::format("a state of the loop over {}, of a cell that runs in the engine's loop",
                       is_disc_state(state) ? "discs" : "spheres");
  double area = 0.0;
  for (const Grain& grain : packing.grains) area += std::numbers::pi * grain.radius * grain.radius;
  try {
    if (packing.dimension == 3 && is_disc_state(state))
      throw RunError("this state is of discs, and the cell is of spheres in space");
    if (packing.dimension == 2 && is_sphere_state(state))
      throw RunError("this state is of spheres in space, and the cell is of discs");
    if (is_sphere_state(state))
      check_spheres(packing, state);
    else
      is_disc_state(state) ? check_discs(packing, area, state) : check_grains(packing, area, state);
  } catch (const RunError& error) {
    return error.what();
  }
  return {};
}

}  // namespace polargrain::dem
