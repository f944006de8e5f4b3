// SPDX-License-Identifier: GPL-2.0-or-later
// Numbers of laws in closed form against each other and against the loads.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/remarks/kinds.hpp"
#include "app/remarks/lengths.hpp"

namespace polargrain::app {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// The largest value of a key: of a number, a list, or a table [[shear, value], ...].
std::optional<double> largest_value(const Scene& scene, const SceneRegion& region, const char* key,
                                    coupler::Dimension dimension) {
  const coupler::Entry* const entry = scene.find({"materials", region.material, key});
  if (entry == nullptr) return {};
  if (entry->kind == coupler::Entry::Kind::scalar) return coupler::parse_quantity(entry->text, dimension);
  std::optional<double> largest;
  for (const coupler::Entry& item : entry->items) {
    const coupler::Entry& value = item.items.size() == 2 ? item.items[1] : item;
    if (const auto number = coupler::parse_quantity(value.text, dimension))
      largest = std::max(largest.value_or(*number), *number);
  }
  return largest;
}

/// The stresses that loads, weight and stress at time zero bring, Pa.
double stress_scale(const Scene& scene) {
  double scale = 0.0;
  for (const fem::EdgeLoad& load : scene.problem().edge_loads)
    for (const fem::TimeTable* const table : {&load.pressure, &load.traction1, &load.traction2})
      scale = std::max(scale, table->largest_magnitude());
  for (const fem::BodyLoad& load : scene.problem().body_loads)
    scale = std::max(scale, load.density(scene.body().least).norm() * load.factor.largest_magnitude() *
                                scene.body().size().y());
  for (const SceneRegion& region : scene.regions())
    if (region.cell == nullptr && !region.elements.empty()) {
      const int node = scene.mesh().elements[static_cast<std::size_t>(region.elements.front())].nodes.front();
      if (const auto stress =
              scene.initial_stress(region, scene.mesh().nodes[static_cast<std::size_t>(node)]))
        scale = std::max(scale, stress->head<3>().cwiseAbs().maxCoeff());
    }
  return scale;
}

}  // namespace

void stiffness_of_laws(const Scene& scene, Remarks& remarks) {
  constexpr double kMostStrain = 0.05;
  constexpr double kLeastStrain = 1e-7;
  const double scale = stress_scale(scene);
  const double strain_of_run = scene.strain_of_step() * scene.the_case().steps();
  for (const SceneRegion& region : scene.regions()) {
    const auto young = scene.quantity({"materials", region.material, "E"}, coupler::Dimension::pressure);
    if (region.cell != nullptr || !young || scale <= 0.0) continue;
    const double strain = scale / *young;
    const coupler::Entry& place = scene.place({"materials", region.material, "E"});
    if (strain > kMostStrain)
      remarks.push_back(
          {Rank::wrong, strain / kMostStrain,
           place.fault(fmt::format(
               "material '{}': E is {:.4g} kPa, and loads, weight and stress at time zero reach {:.4g} kPa: that "
               "alone is an elastic strain of {:.3g} %",
               region.material, 1e-3 * *young, 1e-3 * scale, 100.0 * strain)),
           "check the unit of E (soils: 5 to 500 MPa) and of the loads"});
    else if (strain < kLeastStrain)
      remarks.push_back(
          {Rank::wrong, kLeastStrain / strain,
           place.fault(fmt::format(
               "material '{}': E is {:.4g} GPa, and loads, weight and stress at time zero reach {:.4g} kPa: an elastic "
               "strain of {:.1e}",
               region.material, 1e-9 * *young, 1e-3 * scale, strain)),
           "check the unit of E (soils: 5 to 500 MPa) and of the loads"});
    const auto cohesion = largest_value(scene, region, "cohesion", coupler::Dimension::pressure);
    const double reached = std::max(scale, *young * strain_of_run);
    if (cohesion && *cohesion > 10.0 * reached)
      remarks.push_back(
          {Rank::doubtful, *cohesion / reached,
           scene.place({"materials", region.material, "cohesion"})
               .fault(fmt::format(
                   "material '{}': a cohesion of {:.4g} kPa against stresses of {:.4g} kPa: the body stays elastic",
                   region.material, 1e-3 * *cohesion, 1e-3 * reached)),
           "check the unit of the cohesion, or use 'model: elastic'"});
  }
}

void strength_of_laws(const Scene& scene, Remarks& remarks) {
  for (const SceneRegion& region : scene.regions()) {
    if (region.cell != nullptr) continue;
    const auto friction = largest_value(scene, region, "friction_angle", coupler::Dimension::angle);
    const coupler::Entry& place = scene.place({"materials", region.material, "friction_angle"});
    if (friction && *friction > 55.0 * kDegree)
      remarks.push_back(
          {Rank::doubtful, *friction / (50.0 * kDegree),
           place.fault(fmt::format("material '{}': a friction angle of {:.3g} deg (sand: 28 to 50)",
                                   region.material, *friction / kDegree)),
           "check the number and its unit (deg, rad)"});
    else if (friction && *friction > 0.0 && *friction < 5.0 * kDegree)
      remarks.push_back(
          {Rank::wrong, 5.0 * kDegree / *friction,
           place.fault(fmt::format("material '{}': a friction angle of {:.3g} deg (sand: 28 to 50)",
                                   region.material, *friction / kDegree)),
           "check the unit: 0.6 rad is 34 deg; for undrained clay write 0"});
    const auto shear =
        scene.quantity({"materials", region.material, "hardening_shear"}, coupler::Dimension::number);
    if (shear && *shear > 1.0)
      remarks.push_back(
          {Rank::doubtful, *shear,
           scene.place({"materials", region.material, "hardening_shear"})
               .fault(fmt::format(
                   "material '{}': hardening_shear: strength changes over a plastic shear of {:.3g} %",
                   region.material, 100.0 * *shear)),
           "it is a strain: 0.1 or '10 %' is usual"});
  }
}

void plain_loads(const Scene& scene, Remarks& remarks) {
  constexpr double kTiny = 0.02;
  double scale = stress_scale(scene);
  for (const SceneRegion& region : scene.regions()) scale = std::max(scale, Scene::pressure_of(region));
  for (const fem::EdgeLoad& load : scene.problem().edge_loads) {
    const double value = load.pressure.largest_magnitude();
    const coupler::Entry* const entry = scene.boundary_value(load.on, "pressure");
    if (value == 0.0 || entry == nullptr || entry->kind != coupler::Entry::Kind::scalar || entry->line == 0)
      continue;
    if (!coupler::is_plain_number(entry->text) || value > kTiny * scale) continue;
    remarks.push_back(
        {Rank::wrong, scale / value,
         entry->fault(fmt::format(
             "boundary: pressure on '{}': '{}' has no unit and is {:g} Pa, {:.2g} % of the stresses of this case ({:.4g} kPa)",
             load.on, entry->text, value, 100.0 * value / scale, 1e-3 * scale)),
         fmt::format("write '{0} kPa', or '{0} Pa' if it is in Pa", entry->text)});
  }
}

void tension(const Scene& scene, Remarks& remarks) {
  for (const fem::EdgeLoad& load : scene.problem().edge_loads) {
    const auto end = scene.end_time().value_or(1.0);
    const double least =
        std::min({load.pressure.at(0.0), load.pressure.at(0.5 * end), load.pressure.at(end)});
    if (least >= 0.0) continue;
    const std::vector<OutlineEdge> edges = edges_of(scene.mesh(), load.on);
    const bool grains = std::ranges::any_of(
        edges, [&](const OutlineEdge& edge) { return scene.region_of(edge.element).cell != nullptr; });
    double cohesion = 0.0;
    for (const SceneRegion& region : scene.regions())
      cohesion = std::max(cohesion, largest_value(scene, region, "cohesion", coupler::Dimension::pressure)
                                        .value_or(is_strong(scene, region) ? 0.0 : 1e300));
    if (!grains && -least <= cohesion) continue;
    const coupler::Entry* const entry = scene.boundary_value(load.on, "pressure");
    remarks.push_back(
        {Rank::wrong, 1e3,
         (entry != nullptr ? *entry : scene.place({"boundary"}))
             .fault(fmt::format(
                 "boundary: a pressure of {:.4g} kPa on '{}' pulls, and the material there has no such strength in tension",
                 1e-3 * least, load.on)),
         "a pressure pushes into the body where it is positive: remove the sign"});
  }
}

}  // namespace polargrain::app
