// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/cells/cell_fields.hpp"

#include <algorithm>

#include "common/record_table.hpp"

namespace polargrain::coupler {

template <int dim>
LimitsReached limits_reached(const typename Cosserat<dim>::Vector& stress,
                             const std::optional<CosseratParameters>& cosserat, const CosseratPart<dim>& part,
                             const PackingAtStart<dim>& packing) {
  if (cosserat) return part.reached(*cosserat, packing.least_pressure());
  return {.parted = pressure_of<dim>(stress) <= packing.least_pressure()};
}

std::vector<std::string> names_of_cell_fields(bool has_part) {
  return joined_names(names_of_columns<CellDiagnostics>(), names_of_limit_fields(has_part));
}

template <int dim>
void write_cell_fields(const CellDiagnostics& cell, const LimitsReached& reached,
                       const std::optional<CosseratParameters>& cosserat, const CosseratPart<dim>& part,
                       std::span<double> values) {
  const auto rest = std::ranges::copy(values_of(cell), values.begin()).out;
  write_limit_fields(reached, cosserat, part, rest);
}

template LimitsReached limits_reached<2>(const Vector7&, const std::optional<CosseratParameters>&,
                                         const CosseratPart<2>&, const PackingAtStart<2>&);
template LimitsReached limits_reached<3>(const Vector18&, const std::optional<CosseratParameters>&,
                                         const CosseratPart<3>&, const PackingAtStart<3>&);
template void write_cell_fields(const CellDiagnostics&, const LimitsReached&,
                                const std::optional<CosseratParameters>&, const CosseratPart<2>&,
                                std::span<double>);
template void write_cell_fields(const CellDiagnostics&, const LimitsReached&,
                                const std::optional<CosseratParameters>&, const CosseratPart<3>&,
                                std::span<double>);

}  // namespace polargrain::coupler
