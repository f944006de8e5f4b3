// SPDX-License-Identifier: GPL-2.0-or-later
// The script of the grains: properties that no model reads, numbers that no contact can have, and the neighbours.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>

#include "app/remarks/contact_properties.hpp"
#include "app/remarks/kinds.hpp"
#include "grains_io/neighbour_distance.hpp"

namespace polargrain::app {
namespace {

/// Each material once, though several regions may be made of it.
template <class Do>
void for_each_cell(const Scene& scene, Do&& look) {
  std::vector<std::string> seen;
  for (const SceneRegion& region : scene.regions()) {
    if (region.cell == nullptr || std::ranges::find(seen, region.material) != seen.end()) continue;
    seen.push_back(region.material);
    look(region);
  }
}

Fault at(const Fault& place, std::string message) {
  return {place.file, place.line, std::move(message)};
}

struct Bounds {
  const char* property;
  double least, largest;
  const char* what;
};

constexpr Bounds kBounds[] = {
    {"coefficientFriction", 0.0, 2.0, "a coefficient, tan of the angle: 0.5 is 27 deg; 50 % is 0.5"},
    {"coefficientRollingFriction", 0.0, 2.0, "a share of the radius: 0.1 to 0.5 for sand"},
    {"coefficientRollingFrictionForce", 0.0, 2.0, "a coefficient, of the order of 0.1"},
    {"coefficientRestitution", 0.0, 1.0, "a share of the velocity: 1 for no dashpots"},
    {"poissonsRatio", 0.0, 0.5, "between 0 and 0.5"},
    {"tangentialStiffnessRatio", 0.1, 2.0, "over the normal stiffness: 0.5 to 1 for most grains"}};

}  // namespace

void unread_properties(const Scene& scene, Remarks& remarks) {
  for_each_cell(scene, [&](const SceneRegion& region) {
    const ContactScript script = contact_script_of(*region.cell);
    if (!knows_models_of(script) || !region.cell->contact_library.path.empty()) return;
    for (const ContactProperty& property : script.properties) {
      const std::vector<std::string> readers = readers_of(property.name);
      const bool is_read = readers.empty() || std::ranges::any_of(readers, [&](const std::string& reader) {
                             const std::size_t blank = reader.find(' ');
                             const auto model = script.models.find(reader.substr(0, blank));
                             return model != script.models.end() && model->second == reader.substr(blank + 1);
                           });
      if (is_read) continue;
      std::vector<std::string> models;
      for (const auto& [key, value] : script.models) models.push_back(key + " " + value);
      remarks.push_back(
          {Rank::wrong, 2.0,
           at(property.place,
              fmt::format(
                  "material '{}': {} is given, and no model of pair_style ({}) reads it: the grains are without it",
                  region.material, property.name, fmt::join(models, ", "))),
           fmt::format("add '{}' to pair_style, or remove the line", readers.front())});
    }
  });
}

void contact_numbers(const Scene& scene, Remarks& remarks) {
  for_each_cell(scene, [&](const SceneRegion& region) {
    for (const ContactProperty& property : contact_script_of(*region.cell).properties) {
      const auto bounds =
          std::ranges::find(kBounds, property.name, [](const Bounds& b) { return std::string(b.property); });
      if (bounds == std::end(kBounds)) continue;
      const auto beyond = std::ranges::find_if(
          property.values, [&](double value) { return value < bounds->least || value > bounds->largest; });
      if (beyond == property.values.end()) continue;
      remarks.push_back(
          {Rank::wrong, std::max(1.0, *beyond / bounds->largest),
           at(property.place, fmt::format("material '{}': {} is {:g}, beyond {:g} to {:g}", region.material,
                                          property.name, *beyond, bounds->least, bounds->largest)),
           fmt::format("it is {}", bounds->what)});
    }
  });
}

void neighbours(const Scene& scene, Remarks& remarks) {
  constexpr double kMost = 1.0;    // of the mean radius: lists hold several times the grains that touch
  constexpr double kLeast = 0.02;  // they are rebuilt at every other step
  for_each_cell(scene, [&](const SceneRegion& region) {
    const ContactScript script = contact_script_of(*region.cell);
    if (!script.neighbour_distance) return;
    const Packing& packing = region.cell->packing;
    const double share = *script.neighbour_distance / packing.mean_radius();
    if (share >= kLeast && share <= kMost) return;
    remarks.push_back(
        {Rank::costly, share > kMost ? share / kMost : kLeast / std::max(share, 1e-12),
         at(script.neighbour_place,
            fmt::format(
                "material '{}': neighbours are listed up to {:.3g} mm apart, {:.2g} mean radii of these grains: cells take more than twice "
                "the time",
                region.material, 1e3 * *script.neighbour_distance, share)),
         fmt::format(
             "write 'variable neighbour_distance index {0}' and 'neighbor ${{neighbour_distance}} bin': polargrain gives it ({0} m here)",
             neighbour_distance(packing))});
  });
}

}  // namespace polargrain::app
