// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/run/soft_contacts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <vector>

#include "fem/solver/solver.hpp"

namespace polargrain::app {
namespace {

constexpr double kMeant = 0.05;  ///< mean overlap over the smaller radius that a packing at rest may have

/// Place of the field among those of a material; the number of its fields when it has none of that name.
std::size_t place_of(const std::vector<std::string>& names, const char* name) {
  return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

}  // namespace

std::string soft_contacts(const fem::Solver& solver) {
  std::map<const fem::Material*, std::vector<std::string>> names;
  std::vector<double> values;
  double mean = 0.0;
  double largest = 0.0;
  std::size_t at = 0;
  for (std::size_t point = 0; point < solver.points(); ++point) {
    const auto [material, index] = solver.material_of_point(point);
    const auto [known, added] = names.try_emplace(material);
    if (added) known->second = material->field_names();
    const std::size_t place = place_of(known->second, "mean_overlap");
    if (place == known->second.size()) continue;
    values.resize(known->second.size());
    material->fields(index, values);
    if (values[place] <= mean) continue;
    mean = values[place];
    largest = values[place_of(known->second, "largest_overlap")];
    at = point;
  }
  if (mean <= kMeant) return {};
  return fmt::format(
      "the contacts are soft for this stress: grains of element {} overlap by {:.1f} % of their radius on average, {:.1f} % "
      "at most. From here on strength and volume are of grains softer than a packing at rest may have ({:.0f} %), and at twice "
      "that the run ends; a stiffer contact model goes further",
      solver.element_of_point(at), 100.0 * mean, 100.0 * largest, 100.0 * kMeant);
}

}  // namespace polargrain::app
