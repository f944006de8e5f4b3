// SPDX-License-Identifier: GPL-2.0-or-later
// Whole sides that move apart, farther than the material follows elastically: most often a minus was forgotten.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <span>
#include <string>
#include <string_view>

#include "app/remarks/in_units.hpp"
#include "app/remarks/kinds.hpp"
#include "app/remarks/lengths.hpp"

namespace polargrain::app {
namespace {

/// Elastic strains that tests in extension and unloading stay within, from the packing to the strength.
constexpr double kMostElastic = 4.0;

/// Parts of words in a title.
constexpr std::string_view kExtension[] = {"exten", "elong", "stretch", "pull",  "tensi", "unload",
                                           "lift",  "heav",  "swell",   "expan", "cycl"};
constexpr std::string_view kCompression[] = {"compres", "kompres", "squeez", "shorten", "oedomet"};

bool speaks_of(std::string title, std::span<const std::string_view> words) {
  for (char& letter : title) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return std::ranges::any_of(words,
                             [&](std::string_view word) { return title.find(word) != std::string::npos; });
}

constexpr fem::Dof kDofs[] = {fem::Dof::u1, fem::Dof::u2};

/// Mean over the nodes at that end of the body; nothing where one of them is free.
std::optional<double> mean_at(const fem::Mesh<2>& mesh, int axis, double end, double slack,
                              const std::vector<std::optional<double>>& given) {
  double sum = 0.0;
  int count = 0;
  for (std::size_t node = 0; node < mesh.nodes.size(); ++node) {
    if (std::abs(mesh.nodes[node](axis) - end) > slack) continue;
    if (!given[node]) return {};
    sum += *given[node];
    ++count;
  }
  return sum / std::max(count, 1);
}

/// Mean strain of the body between its two ends along an axis; nothing where loads decide.
std::optional<double> strain_along(const Scene& scene, int axis, double time) {
  const Body& body = scene.body();
  const double slack = 1e-6 * body.size()(axis);
  const std::vector<std::optional<double>> given = given_at(scene.problem(), kDofs[axis], time);
  const auto low = mean_at(scene.mesh(), axis, body.least(axis), slack, given);
  const auto high = mean_at(scene.mesh(), axis, body.largest(axis), slack, given);
  if (!low || !high) return {};
  return (*high - *low) / body.size()(axis);
}

/// Pressure over 2 G; 0 where it is not known, or without strength.
double elastic_strain_of(const Scene& scene, const SceneRegion& region) {
  if (region.cell != nullptr) return region.packing != nullptr ? region.packing->elastic_strain() : 0.0;
  if (!is_strong(scene, region)) return 0.0;
  const auto young = scene.quantity({"materials", region.material, "E"}, coupler::Dimension::pressure);
  const auto poisson = scene.quantity({"materials", region.material, "nu"}, coupler::Dimension::number);
  const auto stress = scene.initial_stress<2>(region, 0.5 * (scene.body().least + scene.body().largest));
  if (!young || !poisson || !stress || *young <= 0.0) return 0.0;
  return -0.5 * ((*stress)(k11) + (*stress)(k22)) * (1.0 + *poisson) / *young;
}

const fem::PrescribedDof<2>* largest_item(const Scene& scene, fem::Dof dof, double time) {
  const fem::PrescribedDof<2>* largest = nullptr;
  for (const fem::PrescribedDof<2>& item : scene.problem().prescribed)
    if (item.dof == dof &&
        (largest == nullptr || std::abs(item.value.at(time)) > std::abs(largest->value.at(time))))
      largest = &item;
  return largest;
}

}  // namespace

void pulled_apart(const Scene& scene, Remarks& remarks) {
  const auto end = scene.end_time();
  // Ground under its weight follows a side that moves away.
  if (!end || !scene.problem().body_loads.empty() || speaks_of(scene.the_case().title, kExtension)) return;
  const auto first = strain_along(scene, 0, *end);
  const auto second = strain_along(scene, 1, *end);
  const int axis = first.value_or(-1.0) > second.value_or(-1.0) ? 0 : 1;
  const double strain = std::max(first.value_or(-1.0), second.value_or(-1.0));
  // Sides that come together as far as the others part keep the volume.
  const double whole = first && second ? std::min(strain, *first + *second) : strain;
  const SceneRegion* stiffest = nullptr;
  double elastic = 0.0;
  for (const SceneRegion& region : scene.regions())
    if (const double here = elastic_strain_of(scene, region); here > elastic) {
      elastic = here;
      stiffest = &region;
    }
  if (stiffest == nullptr || whole <= kMostElastic * elastic) return;
  const fem::PrescribedDof<2>& item = *largest_item(scene, kDofs[axis], *end);
  const coupler::Entry* const value = scene.boundary_value(item.on, "move");
  const bool meant_otherwise = speaks_of(scene.the_case().title, kCompression);
  remarks.push_back(
      {meant_otherwise ? Rank::wrong : Rank::doubtful, meant_otherwise ? whole / elastic / kMostElastic : 1.0,
       (value != nullptr ? *value : scene.place({"boundary"}))
           .fault(fmt::format(
               "boundary: '{}' pulls the body apart: at the end it is {:.3g} % longer along {}, {:.2g} elastic strains of '{}' "
               "({:.2g} %){}{}",
               item.on, 100.0 * strain, axis + 1, strain / elastic, stiffest->material, 100.0 * elastic,
               first && second ? ", and its other sides are held: nothing is left of its stress" : "",
               meant_otherwise ? "; the title speaks of compression" : "")),
       fmt::format(
           "to compress, write 'move: {{u{}: {}}}'; where this is meant, say 'extension' in the title",
           axis + 1, metres(-item.value.at(*end)))});
}

}  // namespace polargrain::app
