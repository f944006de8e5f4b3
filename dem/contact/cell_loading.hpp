// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <array>

#include "dem/engine/engine_part.hpp"

namespace polargrain::dem {

/// What a cell imposes on its contacts beyond the motion of the grains; outside a cell it stays zero.
struct CellLoading {
  /// Rate of curvature d(micro-rotation)/dx_k, rad/(m s): every contact between grains sees their spins turned
  /// by what it makes from the middle of the branch to either centre (docs/theory/grains.md, C.6, C.8). Laws
  /// that take spins past the contact (stock rolling models) do not feel it.
  std::array<double, 2> curvature_rate{};

  [[nodiscard]] bool bends() const { return curvature_rate[0] != 0.0 || curvature_rate[1] != 0.0; }
};

/// The loading of the cell of this engine.
inline CellLoading& cell_loading(LAMMPS_NS::LAMMPS& lammps) {
  return part_of<CellLoading>(lammps);
}

}  // namespace polargrain::dem
