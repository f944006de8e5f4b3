// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/cells/cell_fields.hpp"

#include <algorithm>

#include "common/record_table.hpp"

namespace polargrain::coupler {

LimitsReached limits_reached(const Vector7& stress, const std::optional<CosseratParameters>& cosserat,
                             const CosseratPart& part, const PackingAtStart& packing) {
  if (cosserat) return part.reached(*cosserat, packing.least_pressure());
  return {.parted = pressure_in_plane(stress) <= packing.least_pressure()};
}

std::vector<std::string> names_of_cell_fields(bool has_part) {
  return joined_names(names_of_columns<CellDiagnostics>(), names_of_limit_fields(has_part));
}

void write_cell_fields(const CellDiagnostics& cell, const LimitsReached& reached,
                       const std::optional<CosseratParameters>& cosserat, const CosseratPart& part,
                       std::span<double> values) {
  const auto rest = std::ranges::copy(values_of(cell), values.begin()).out;
  write_limit_fields(reached, cosserat, part, rest);
}

}  // namespace polargrain::coupler
