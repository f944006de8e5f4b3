// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/run/soft_contacts.hpp"

#include <fmt/format.h>

#include "common/overlap_limit.hpp"
#include "fem/output/material_values.hpp"

namespace polargrain::app {

template <int dim>
std::string soft_contacts(const fem::Solver<dim>& solver) {
  fem::MaterialValues<dim> values(solver);
  double mean = 0.0;
  double largest = 0.0;
  std::size_t at = 0;
  for (std::size_t point = 0; point < solver.points(); ++point) {
    const double overlap = values.at(point, "mean_overlap").value_or(0.0);
    if (overlap <= mean) continue;
    mean = overlap;
    largest = values.at(point, "largest_overlap").value_or(0.0);
    at = point;
  }
  if (mean <= kMostMeanOverlap) return {};
  return fmt::format(
      "the contacts are soft for this stress: grains of element {} overlap by {:.1f} % of their radius on average, {:.1f} % "
      "at most. From here on strength and volume are of grains softer than a packing at rest may have ({:.0f} %), and at twice "
      "that the run ends; a stiffer contact model goes further",
      solver.element_of_point(at), 100.0 * mean, 100.0 * largest, 100.0 * kMostMeanOverlap);
}

template std::string soft_contacts<2>(const fem::Solver<2>& solver);
template std::string soft_contacts<3>(const fem::Solver<3>& solver);

}  // namespace polargrain::app
