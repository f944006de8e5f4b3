// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/picture/case_picture.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "app/page/page.hpp"
#include "app/picture/conditions.hpp"
#include "app/picture/packing_picture.hpp"
#include "app/picture/plane_drawing.hpp"
#include "app/picture/space_drawing.hpp"
#include "app/remarks/remarks.hpp"

namespace polargrain::app {
namespace {

constexpr const char* kHeadingOfPlaces = "<h2>Boundaries and node sets</h2>\n";

/// Length (plane, m) or area (space, m^2) of a boundary; of the parts of the outline in no boundary where the name is empty.
template <int dim>
double extent_of(const fem::Mesh<dim>& mesh, const std::string& name) {
  double extent = 0.0;
  for (const OutlineSide<dim>& side : sides_of(mesh, name)) extent += side.size;
  return extent;
}

template <int dim>
std::string places_table(const fem::Mesh<dim>& mesh, const std::vector<PlaceConditions<dim>>& places) {
  std::vector<TableRow> rows;
  const auto support_of = [](const PlaceConditions<dim>& place) {
    if (!place.supports.empty()) return place.supports;
    if (place.elsewhere.empty()) return std::string("free");
    return fmt::format("{} {}", place.all_elsewhere ? "see" : "free but for",
                       fmt::join(place.elsewhere, ", "));
  };
  const auto or_nothing = [](const std::string& words) { return words.empty() ? std::string("-") : words; };
  for (const PlaceConditions<dim>& place : places)
    rows.push_back(
        {{place.name,
          place.is_boundary ? fmt::format("{:.4g}", extent_of(mesh, place.name)) : std::string("nodes"),
          fmt::format("{}", place.nodes.size()), support_of(place), or_nothing(place.loads_at_start),
          or_nothing(place.loads_at_end)},
         place.is_free() ? "front" : ""});
  if (const double extent = extent_of(mesh, ""); extent > 0.0)
    rows.push_back({{"(no name)", fmt::format("{:.4g}", extent), "-", "free", "-", "-"}, "front"});
  return table({"place", dim == 2 ? "length, m" : "area, m²", "nodes", "held or moved", "load at the start",
                "load at the end"},
               rows, TableOf::text);
}

std::string regions_table(const Scene& scene) {
  std::vector<TableRow> rows;
  for (const SceneRegion& region : scene.regions()) {
    const double pressure = Scene::pressure_of(region);
    rows.push_back({{region.name, region.material, fmt::format("{}", region.elements.size()),
                     region.cell != nullptr ? fmt::format("{}", region.cell->packing.grains.size()) : "-",
                     pressure > 0.0 ? fmt::format("{:.4g}", 1e-3 * pressure) : "-"}});
  }
  return table({"region", "material", "elements", "grains a cell", "pressure of the grains, kPa"}, rows,
               TableOf::text);
}

std::string packings(const Scene& scene) {
  std::string figures;
  std::vector<std::string> shown;
  for (const SceneRegion& region : scene.regions()) {
    if (region.cell == nullptr || std::ranges::find(shown, region.material) != shown.end()) continue;
    shown.push_back(region.material);
    const Packing& packing = region.cell->packing;
    figures +=
        packing_figure(packing, fmt::format("packing{}", shown.size()),
                       fmt::format("{}: {} {}, mean diameter {:.4g} mm, box {:.4g} by {:.4g} mm",
                                   region.material, packing.grains.size(),
                                   packing.dimension == 3 ? "spheres" : "discs", 2e3 * packing.mean_radius(),
                                   1e3 * packing.box.col(0).norm(), 1e3 * packing.box.col(1).norm()));
  }
  return figures.empty() ? figures : "<h2>Packings</h2>\n<div class='grid'>\n" + figures + "</div>\n";
}

std::string remarks_table(const Remarks& remarks) {
  if (remarks.empty()) return "<p>No remarks.</p>\n";
  std::vector<TableRow> rows;
  for (const Remark& remark : remarks)
    rows.push_back(
        {{name_of(remark.rank), fmt::format("line {}", remark.at.line), remark.at.message, remark.remedy}});
  return "<h2>Remarks</h2>\n" + table({"rank", "where", "finding", "remedy"}, rows, TableOf::text);
}

}  // namespace

std::string case_picture(const Scene& scene, const Remarks& remarks) {
  const double end = scene.end_time().value_or(1.0);
  std::string body;
  if (scene.dimension() == 3) {
    const fem::Problem<3>& problem = *scene.the_case().space;
    const std::vector<PlaceConditions<3>> places = conditions_of<3>(problem, end);
    body = space_drawing(problem.mesh, scene.regions(), places) + kHeadingOfPlaces +
           places_table<3>(problem.mesh, places);
  } else {
    const std::vector<PlaceConditions<2>> places = conditions_of<2>(scene.problem(), end);
    body = plane_drawing(scene, places) + kHeadingOfPlaces + places_table<2>(scene.mesh(), places);
  }
  const std::string title =
      scene.the_case().title.empty() ? scene.the_case().file.filename().string() : scene.the_case().title;
  return page(title, "<p>The case before it runs.</p>\n" + body + "<h2>Regions</h2>\n" +
                         regions_table(scene) + packings(scene) + remarks_table(remarks));
}

}  // namespace polargrain::app
