// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <array>

namespace polargrain::dem {

/// What a cell imposes on its contacts beyond the motion of the grains. One cell runs in a process at a time,
/// so this is a value of the process; outside a cell it stays zero.
struct CellLoading {
  /// Rate of curvature d(micro-rotation)/dx_k, rad/(m s). Rolling laws of this project see it as an
  /// eigen-rotation of each contact between grains: relative rotation rate += curvature_rate . branch
  /// (docs/theory.md, C.6).
  std::array<double, 2> curvature_rate{};
};

/// The loading of the cell of this process.
CellLoading& cell_loading();

}  // namespace polargrain::dem
