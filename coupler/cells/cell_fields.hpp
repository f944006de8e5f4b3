// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/cell.hpp"
#include "coupler/cells/cosserat_part.hpp"
#include "coupler/cells/packing_at_start.hpp"
#include "coupler/cells/points_at_limits.hpp"

namespace polargrain::coupler {

// The fields of a point that goes by the answer of its own cell: the diagnostics of the cell (docs/file_formats.md), parted,
// and, where skew and couple stress are the case's, skew_mobilisation and couple_mobilisation.

/// The limits that a point has reached. @param stress of its cell, Pa @param cosserat nothing where the cells give everything
template <int dim>
LimitsReached limits_reached(const typename Cosserat<dim>::Vector& stress,
                             const std::optional<CosseratParameters>& cosserat, const CosseratPart<dim>& part,
                             const PackingAtStart<dim>& packing);

std::vector<std::string> names_of_cell_fields(bool has_part);
/// @param values in that order
template <int dim>
void write_cell_fields(const CellDiagnostics& cell, const LimitsReached& reached,
                       const std::optional<CosseratParameters>& cosserat, const CosseratPart<dim>& part,
                       std::span<double> values);

}  // namespace polargrain::coupler
