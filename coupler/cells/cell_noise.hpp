// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cmath>

#include "coupler/cells/cosserat_part.hpp"
#include "coupler/cells/point_cell.hpp"

namespace polargrain::coupler {

/// Noise of the stress of a cell: the pressure of the dimension times the unbalanced force ratio at read-out,
/// over the root of the number of grains, as the unbalanced forces of grains are independent. Cells whose
/// increments differ slightly scatter by as much (docs/performance.md). The same holds for the moments of a cell
/// with controlled rotations: of the skew stress, and, times the mean radius, of the couple stress. Stresses that are not
/// the grains' (skew and couple stress of CosseratParameters) count as exact.
/// @param stress of the cell, Pa @param mean_radius of grains whose rotations are controlled, m; 0: they are free
template <int dim>
StressNoise noise_of(const typename Cosserat<dim>::Vector& stress, const CellDiagnostics& cell,
                     double mean_radius) {
  if (!(cell.coordination_number > 0.0) || cell.contacts == 0) return {};
  const double grains = 2.0 * static_cast<double>(cell.contacts) / cell.coordination_number;
  const double scale = std::abs(pressure_of<dim>(stress)) / std::sqrt(grains);
  const double of_moments = cell.unbalanced_moment_ratio * scale;
  return {.symmetric = cell.unbalanced_force_ratio * scale,
          .skew = mean_radius > 0.0 ? of_moments : 0.0,
          .couple = of_moments * mean_radius};
}

template <int dim>
StressNoise noise_of(const PointReply<dim>& reply, double mean_radius) {
  return noise_of<dim>(reply.response.stress, reply.diagnostics, mean_radius);
}

}  // namespace polargrain::coupler
