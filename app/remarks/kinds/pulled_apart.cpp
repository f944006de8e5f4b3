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
#include "app/remarks/outline.hpp"
#include "fem/element/dofs.hpp"
#include "fem/mesh/box_around.hpp"

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

template <int dim>
fem::Dof along(int axis) {
  return fem::node_dofs<dim>()[static_cast<std::size_t>(axis)];
}

/// Mean over the nodes at that end of the body; nothing where one of them is free.
template <int dim>
std::optional<double> mean_at(const fem::Mesh<dim>& mesh, int axis, double end, double slack,
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
template <int dim>
std::optional<double> strain_along(const fem::Problem<dim>& problem, const fem::BoxAround<dim>& box, int axis,
                                   double time) {
  const double length = box.sides()(axis);
  const std::vector<std::optional<double>> given = given_at(problem, along<dim>(axis), time);
  const auto low = mean_at(problem.mesh, axis, box.least(axis), 1e-6 * length, given);
  const auto high = mean_at(problem.mesh, axis, box.largest(axis), 1e-6 * length, given);
  if (!low || !high) return {};
  return (*high - *low) / length;
}

/// Pressure over 2 G; 0 where it is not known, or without strength.
template <int dim>
double elastic_strain_of(const Scene& scene, const SceneRegion& region, const fem::BoxAround<dim>& box) {
  if (region.cell != nullptr) return region.packing != nullptr ? region.packing->elastic_strain() : 0.0;
  if (!is_strong(scene, region)) return 0.0;
  const auto young = scene.quantity({"materials", region.material, "E"}, coupler::Dimension::pressure);
  const auto poisson = scene.quantity({"materials", region.material, "nu"}, coupler::Dimension::number);
  const auto stress = scene.initial_stress<dim>(region, 0.5 * (box.least + box.largest));
  if (!young || !poisson || !stress || *young <= 0.0) return 0.0;
  double pressure = 0.0;
  for (int i = 0; i < dim; ++i) pressure -= (*stress)(Cosserat<dim>::stress_place(i, i)) / dim;
  return pressure * (1.0 + *poisson) / *young;
}

template <int dim>
const fem::PrescribedDof<dim>* largest_item(const fem::Problem<dim>& problem, fem::Dof dof, double time) {
  const fem::PrescribedDof<dim>* largest = nullptr;
  for (const fem::PrescribedDof<dim>& item : problem.prescribed)
    if (item.dof == dof &&
        (largest == nullptr || std::abs(item.value.at(time)) > std::abs(largest->value.at(time))))
      largest = &item;
  return largest;
}

template <int dim>
void look_at_parting(const Scene& scene, const fem::Problem<dim>& problem, Remarks& remarks) {
  const auto end = scene.end_time();
  // Ground under its weight follows a side that moves away.
  if (!end || !problem.body_loads.empty() || speaks_of(scene.the_case().title, kExtension)) return;
  const fem::BoxAround<dim> box = fem::box_around(problem.mesh);
  int axis = 0;
  double strain = -1.0;
  double volume_strain = 0.0;  // where all of it is given
  bool is_given = true;
  for (int i = 0; i < dim; ++i) {
    const auto here = strain_along(problem, box, i, *end);
    is_given = is_given && here.has_value();
    volume_strain += here.value_or(0.0);
    if (here.value_or(-1.0) <= strain) continue;
    strain = *here;
    axis = i;
  }
  // Sides that come together as far as the others part keep the volume.
  const double whole = is_given ? std::min(strain, volume_strain) : strain;
  const SceneRegion* stiffest = nullptr;
  double elastic = 0.0;
  for (const SceneRegion& region : scene.regions())
    if (const double here = elastic_strain_of<dim>(scene, region, box); here > elastic) {
      elastic = here;
      stiffest = &region;
    }
  if (stiffest == nullptr || whole <= kMostElastic * elastic) return;
  const fem::PrescribedDof<dim>& item = *largest_item(problem, along<dim>(axis), *end);
  const coupler::Entry* const value = scene.boundary_value(item.on, "move");
  const bool meant_otherwise = speaks_of(scene.the_case().title, kCompression);
  remarks.push_back(
      {meant_otherwise ? Rank::wrong : Rank::doubtful, meant_otherwise ? whole / elastic / kMostElastic : 1.0,
       (value != nullptr ? *value : scene.place({"boundary"}))
           .fault(fmt::format(
               "boundary: '{}' pulls the body apart: at the end it is {:.3g} % longer along {}, {:.2g} elastic strains of '{}' "
               "({:.2g} %){}{}",
               item.on, 100.0 * strain, axis + 1, strain / elastic, stiffest->material, 100.0 * elastic,
               is_given ? ", and its other sides are held: nothing is left of its stress" : "",
               meant_otherwise ? "; the title speaks of compression" : "")),
       fmt::format(
           "to compress, write 'move: {{u{}: {}}}'; where this is meant, say 'extension' in the title",
           axis + 1, metres(-item.value.at(*end)))});
}

}  // namespace

void pulled_apart(const Scene& scene, Remarks& remarks) {
  scene.with_problem([&](const auto& problem) { look_at_parting(scene, problem, remarks); });
}

}  // namespace polargrain::app
