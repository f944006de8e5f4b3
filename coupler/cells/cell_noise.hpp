// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cmath>

#include "common/cell.hpp"

namespace polargrain::coupler {

/// Noise of the stress of a cell: mean pressure in the plane times the unbalanced force ratio at read-out,
/// over the root of the number of grains, as the unbalanced forces of grains are independent. Cells whose
/// increments differ slightly scatter by as much (docs/performance.md). The same holds for the moments and
/// the skew stress of a cell with controlled rotations; couple stresses, and what is not the grains' (skew
/// and couple stress of CosseratParameters), count as exact.
inline StressNoise noise_of(const CellReply& reply) {
  const CellDiagnostics& cell = reply.diagnostics;
  if (!(cell.coordination_number > 0.0) || cell.contacts == 0) return {};
  const double grains = 2.0 * static_cast<double>(cell.contacts) / cell.coordination_number;
  const double pressure = 0.5 * std::abs(reply.response.stress(k11) + reply.response.stress(k22));
  const double scale = pressure / std::sqrt(grains);
  return {.symmetric = cell.unbalanced_force_ratio * scale,
          .skew = cell.multiplier != 0.0 ? cell.unbalanced_moment_ratio * scale : 0.0};
}

}  // namespace polargrain::coupler
