// SPDX-License-Identifier: GPL-2.0-or-later
// Ground: its stress at time zero, its weight.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "app/remarks/given_stress.hpp"
#include "app/remarks/kinds.hpp"
#include "app/remarks/outline.hpp"
#include "app/remarks/weights.hpp"
#include "fem/water/pore_water.hpp"

namespace polargrain::app {
namespace {

using coupler::Dimension;
using coupler::Entry;

std::optional<double> number(const Entry& item, const char* key, Dimension dimension) {
  const Entry* const entry = item.find(key);
  return entry == nullptr ? std::nullopt : coupler::parse_quantity(entry->text, dimension);
}

/// K0 against the ratios that a cone of this friction and cohesion can carry at the mean depth of the item.
void look_at_ratio(const Scene& scene, const Entry& item, Remarks& remarks) {
  const auto k0 = number(item, "K0", Dimension::number);
  const auto surface = number(item, "surface", Dimension::length);
  const auto weight = number(item, "unit_weight", Dimension::unit_weight);
  if (!k0 || !surface || !weight) return;
  const double depth = *surface - scene.body().bottom;
  const double vertical =
      *weight * std::max(depth, 0.0) + number(item, "surcharge", Dimension::pressure).value_or(0.0);
  const Entry* const of_region = item.find("region");
  for (const SceneRegion& region : scene.regions()) {
    if (of_region != nullptr && of_region->text != region.name) continue;
    const Entry* const angle = scene.find({"materials", region.material, "friction_angle"});
    if (region.cell != nullptr || angle == nullptr) continue;
    const auto friction = coupler::parse_quantity(
        angle->kind == Entry::Kind::sequence && !angle->items.empty() ? angle->items[0].text : angle->text,
        Dimension::angle);
    const double cohesion =
        scene.quantity({"materials", region.material, "cohesion"}, Dimension::pressure).value_or(0.0);
    if (!friction || vertical <= 0.0) continue;
    const double sine = std::sin(*friction);
    const double root = std::sqrt((1.0 - sine) / (1.0 + sine));
    const double active = std::max(0.0, root * root - 2.0 * root * cohesion / vertical);
    const double passive = 1.0 / (root * root) + 2.0 / root * cohesion / vertical;
    if (*k0 >= active && *k0 <= passive) continue;
    remarks.push_back(
        {Rank::wrong, std::max(active / std::max(*k0, 1e-3), *k0 / passive),
         item.find("K0")->fault(fmt::format(
             "initial_stress: K0 of {:.3g} is beyond {:.3g} and {:.3g}, the ratios that material '{}' can carry at the "
             "lowest point: it yields before the first step",
             *k0, active, passive, region.material)),
         "K0 is horizontal over vertical stress: 0.4 to 0.6 for most ground, 1 - sin of the friction angle for sand"});
    return;
  }
}

/// Whether loads on the highest sides stand, at time zero, for ground above the mesh of this weight.
bool carries_ground_above(const Scene& scene, double top, double weight) {
  const double lowest = top - 1e-6 * scene.body().height();
  const double load_there = scene.with_problem([&]<int dim>(const fem::Problem<dim>& problem) {
    double sum = 0.0;
    for (const fem::BoundaryLoad<dim>& load : problem.boundary_loads)
      if (std::ranges::any_of(problem.mesh.boundaries.at(load.on), [&](const fem::BoundarySide& side) {
            return std::ranges::all_of(problem.mesh.side_nodes(side), [&](int node) {
              return problem.mesh.nodes[static_cast<std::size_t>(node)](dim - 1) > lowest;
            });
          }))
        sum += load.pressure.at(0.0) - load.traction[dim - 1].at(0.0);
    return sum;
  });
  return std::abs(load_there - weight) <= 0.3 * weight;
}

/// The highest point of the ground that is there at time zero.
double top_at_start(const Scene& scene) {
  return scene.with_problem([&]<int dim>(const fem::Problem<dim>& problem) {
    double top = scene.body().bottom;
    for (const SceneRegion& region : scene.regions())
      for (const int element : region.elements)
        for (const int node : problem.mesh.elements[static_cast<std::size_t>(element)].nodes)
          if (!region.comes_later)
            top = std::max(top, problem.mesh.nodes[static_cast<std::size_t>(node)](dim - 1));
    return top;
  });
}

void look_at_surface(const Scene& scene, const Entry& item, Remarks& remarks) {
  const auto surface = number(item, "surface", Dimension::length);
  if (!surface) return;
  const double height = scene.body().height();
  const double top = top_at_start(scene);
  const double over = *surface - top;
  if (std::abs(over) <= 0.02 * height) return;
  const double above = over * number(item, "unit_weight", Dimension::unit_weight).value_or(0.0) +
                       number(item, "surcharge", Dimension::pressure).value_or(0.0);
  if (over > 0.0 && carries_ground_above(scene, top, above)) return;
  if (item.find("region") != nullptr) return;  // a layer of the ground
  remarks.push_back(
      {std::abs(over) > 0.2 * height ? Rank::wrong : Rank::doubtful, 1.0 + std::abs(over) / height,
       item.find("surface")->fault(fmt::format(
           "initial_stress: the surface is at {:.4g} m, and the highest point of the mesh at {:.4g} m: {}",
           *surface, top,
           over > 0.0 ? "the ground above the mesh has no load in its place"
                      : "the ground above the surface is in tension")),
       "give the height of the mesh's surface; for ground above it a surcharge, and a pressure on the surface"});
}

/// Stresses are effective: water above the ground weighs on its surface, and the given stress must hold that.
void look_at_water_above(const Scene& scene, const Entry& item, Remarks& remarks) {
  const auto surface = number(item, "surface", Dimension::length);
  const auto level = scene.quantity({"water", "level"}, Dimension::length);
  const double weight = scene.quantity({"water", "unit_weight"}, Dimension::unit_weight)
                            .value_or(fem::PoreWaterOptions{}.unit_weight);
  if (!surface || !level || *level <= *surface) return;
  const double water = weight * (*level - *surface);
  const double carried = number(item, "surcharge", Dimension::pressure).value_or(0.0);
  if (carried >= 0.95 * water) return;
  remarks.push_back(
      {Rank::wrong, water / std::max(carried, 0.01 * water),
       item.find("surface")->fault(fmt::format(
           "initial_stress: water stands {:.4g} m above the surface and weighs {:.4g} kPa, and the surcharge is {:.4g} kPa: the "
           "ground is in tension at its surface",
           *level - *surface, 1e-3 * water, 1e-3 * carried)),
       fmt::format("give that weight to the stress: surcharge: {:.4g} kPa", 1e-3 * water)});
}

void look_at_components(const Entry& item, Remarks& remarks) {
  const Entry* const stress = item.find("stress");
  if (stress == nullptr || (stress->items.size() != 4 && stress->items.size() != 6)) return;
  double s[3] = {0.0, 0.0, 0.0};
  for (int i = 0; i < 3; ++i)
    s[i] = coupler::parse_quantity(stress->items[static_cast<std::size_t>(i)].text, Dimension::pressure)
               .value_or(0.0);
  if (s[0] > 0.0 && s[1] > 0.0)
    remarks.push_back(
        {Rank::wrong, 100.0,
         stress->fault(fmt::format(
             "initial_stress: s11 and s22 are {:.4g} and {:.4g} kPa, tension: stresses are positive in tension",
             1e-3 * s[0], 1e-3 * s[1])),
         "write pressures with a minus: stress: [-100 kPa, -100 kPa, -100 kPa, 0]"});
  else if (std::max({s[0], s[1], s[2]}) > 0.0 && std::min({s[0], s[1], s[2]}) < 0.0)
    remarks.push_back(
        {Rank::wrong, 50.0,
         stress->fault(fmt::format(
             "initial_stress: s11, s22 and s33 are {:.4g}, {:.4g} and {:.4g} kPa: stresses are positive in tension, and "
             "ground carries hardly any tension",
             1e-3 * s[0], 1e-3 * s[1], 1e-3 * s[2])),
         "write all three with a minus: stress: [-100 kPa, -100 kPa, -100 kPa, 0]"});
  else if (stress->items.size() == 4 && s[2] == 0.0 && (s[0] != 0.0 || s[1] != 0.0))
    remarks.push_back(
        {Rank::wrong, 10.0,
         stress->fault(
             "initial_stress: s33 is zero: the body is in plane strain, and a stress normal to the plane belongs to it; a law with friction yields without it"),
         fmt::format("give s33, for example {:.4g} kPa", 0.5e-3 * (s[0] + s[1]))});
}

/// Water that carries its part of the weights given, N/m^3: they hold it where it has a level. 0: there is no water, or weights are submerged.
double water_in_weights(const Scene& scene, const std::string& region) {
  return scene.with_problem([&](const auto& problem) {
    const auto* const water = fem::pore_water_of(problem);
    const bool is_within = water != nullptr && water->options().table && water->regions().contains(region);
    return is_within ? water->options().unit_weight : 0.0;
  });
}

std::ptrdiff_t items_of_weight(const Scene& scene, const std::string& region) {
  return scene.with_problem([&](const auto& problem) {
    return std::ranges::count_if(
        problem.body_loads, [&](const auto& load) { return load.region.empty() || load.region == region; });
  });
}

/// The weight that the stress grows by with depth against that of the body: they balance each other.
void look_at_weights(const Scene& scene, const Entry& list, Remarks& remarks) {
  constexpr double kSlackOfWeights = 0.05;
  constexpr double kFarWeights = 0.3;
  for (const SceneRegion& region : scene.regions()) {
    const Entry* last = nullptr;  // the one that counts: of the region before one of all
    for (const bool is_own : {false, true})
      for (const Entry& item : list.items) {
        const Entry* const of_region = item.find("region");
        if (is_own ? of_region != nullptr && of_region->text == region.name : of_region == nullptr)
          last = &item;
      }
    if (last == nullptr || region.comes_later || region.elements.empty()) continue;
    const double given = number(*last, "unit_weight", Dimension::unit_weight).value_or(0.0);
    const double weight = weight_at_start(scene, region.name);
    if (given == 0.0 || weight <= 0.0) continue;
    const double water = water_in_weights(scene, region.name);
    const double larger = std::max(given, weight);
    const double off = std::abs(given - weight) / (larger > water ? larger - water : larger);
    const double times = weight / given;
    const bool is_given_twice = items_of_weight(scene, region.name) > 1 && times > 1.5 &&
                                std::abs(times - std::round(times)) < 1e-9;  // loads_twice says so
    if (off <= kSlackOfWeights || is_given_twice) continue;
    const std::string change = given > water && water > 0.0
                                   ? fmt::format("below water its effective stress changes by {:+.0f} %",
                                                 100.0 * (weight - given) / (given - water))
                                   : "step 0 takes up the difference";
    remarks.push_back(
        {off > kFarWeights ? Rank::wrong : Rank::doubtful, 1.0 + off,
         last->find("unit_weight")
             ->fault(fmt::format(
                 "initial_stress: a unit weight of {:.4g} kN/m3, and region '{}' has {:.4g} kN/m3 below body: {}",
                 1e-3 * given, region.name, 1e-3 * weight, change)),
         water > 0.0
             ? "give both the same weight, that of the ground with its water; a layer has an item of its own: "
               "{region: NAME, ...}"
             : "give both the same weight; a layer has an item of its own: {region: NAME, ...}"});
    return;
  }
}

/// A border of two regions that lies nearly level, and the vertical stress given above and below it.
struct Border {
  std::string above, below;
  double height = 0.0;                            ///< of the middle of its side, m
  double stress_above = 0.0, stress_below = 0.0;  ///< Pa, compression positive
  /// Difference over the larger one, or over 1 kPa: near the surface there is less than a step could feel.
  [[nodiscard]] double off() const {
    const double larger = std::max({std::abs(stress_above), std::abs(stress_below), 1e3});
    return std::abs(stress_above - stress_below) / larger;
  }
};

/// The border with the largest jump.
template <int dim>
Border worst_border(const Scene& scene, const fem::Problem<dim>& problem) {
  constexpr double kLevel = 0.7;  // part of the normal that points up
  Border worst;
  std::map<std::vector<int>, int> beside;  // an element by the nodes of its side
  for (std::size_t e = 0; e < problem.mesh.elements.size(); ++e)
    for (std::size_t k = 0; k < problem.mesh.elements[e].type->sides.size(); ++k) {
      const fem::BoundarySide here{static_cast<int>(e), static_cast<int>(k)};
      std::vector<int> nodes = problem.mesh.side_nodes(here);
      std::ranges::sort(nodes);
      const auto [place, is_first] = beside.try_emplace(std::move(nodes), here.element);
      if (is_first) continue;
      const SceneRegion& one = scene.region_of(here.element);
      const SceneRegion& other = scene.region_of(place->second);
      if (one.name == other.name || one.comes_later || other.comes_later) continue;
      const OutlineSide<dim> side = side_at(problem.mesh, here);
      if (std::abs(side.normal(dim - 1)) < kLevel) continue;
      const auto vertical = [&](const SceneRegion& region) {
        const auto stress = given_stress<dim>(scene, region.name, side.centre);
        return stress ? std::optional(-(*stress)(Cosserat<dim>::stress_place(dim - 1, dim - 1)))
                      : std::nullopt;
      };
      const auto of_one = vertical(one);
      const auto of_other = vertical(other);
      if (!of_one || !of_other) continue;
      const bool is_below = side.normal(dim - 1) > 0.0;  // `one` is
      const Border border{is_below ? other.name : one.name, is_below ? one.name : other.name,
                          side.centre(dim - 1), is_below ? *of_other : *of_one,
                          is_below ? *of_one : *of_other};
      if (border.off() > worst.off()) worst = border;
    }
  return worst;
}

/// The vertical stress is the same above and below a border: the upper layer weighs on the lower one.
void look_at_borders(const Scene& scene, const Entry& list, Remarks& remarks) {
  constexpr double kSlack = 0.1;
  constexpr double kFar = 0.3;
  const Border worst = scene.with_problem([&](const auto& problem) { return worst_border(scene, problem); });
  if (worst.off() <= kSlack) return;
  const auto of_below = std::ranges::find_if(list.items, [&](const Entry& item) {
    const Entry* const region = item.find("region");
    return region != nullptr && region->text == worst.below;
  });
  remarks.push_back(
      {worst.off() > kFar ? Rank::wrong : Rank::doubtful, 1.0 + worst.off(),
       (of_below == list.items.end() ? list : *of_below)
           .fault(fmt::format(
               "initial_stress: at the height {:.4g} m region '{}' ends with a vertical stress of {:.4g} kPa and region "
               "'{}' below it begins with {:.4g} kPa: step 0 takes up the difference",
               worst.height, worst.above, 1e-3 * worst.stress_above, worst.below, 1e-3 * worst.stress_below)),
       "give the lower layer the weight above it: {region: LOWER, surface: ..., surcharge: WEIGHT ABOVE, ...}"});
}

}  // namespace

void ground_stress(const Scene& scene, Remarks& remarks) {
  const Entry* const list = scene.find({"initial_stress"});
  if (list == nullptr) return;
  look_at_weights(scene, *list, remarks);
  look_at_borders(scene, *list, remarks);
  for (const Entry& item : list->items) {
    look_at_ratio(scene, item, remarks);
    look_at_surface(scene, item, remarks);
    look_at_water_above(scene, item, remarks);
    look_at_components(item, remarks);
  }
}

namespace {

template <int dim>
void look_at_weight(const Scene& scene, const fem::Problem<dim>& problem, Remarks& remarks) {
  constexpr double kLight = 2.5e3;  // N/m^3: a density written without its unit has 1400 to 2400
  constexpr double kHeavy = 2.5e6;  // a hundred times gravity in a centrifuge
  const Entry* const list = scene.find({"body"});
  for (std::size_t k = 0; k < problem.body_loads.size(); ++k) {
    const fem::BodyLoad<dim>& load = problem.body_loads[k];
    const Eigen::Matrix<double, dim, 1> force =
        load.factor.largest_magnitude() * load.density(problem.mesh.nodes.front()).template head<dim>();
    // A later stage has no longer all items of this list, and others of its own.
    const bool is_listed = scene.stage() == 0 && list != nullptr && k < list->items.size();
    const Entry& place = is_listed ? list->items[k] : scene.place({scene.stage() == 0 ? "body" : "steps"});
    const double up = force(dim - 1);
    if (up > 0.0 || (up == 0.0 && force.norm() > 0.0 && problem.body_loads.size() == 1)) {
      std::vector<std::string> along;
      for (int i = 0; i < dim; ++i)
        along.push_back(fmt::format("{:.3g} kN/m3 along {}", 1e-3 * force(i), i + 1));
      remarks.push_back(
          {Rank::wrong, 100.0,
           place.fault(fmt::format("body: the force is {}, and {} points up: {}", fmt::join(along, " and "),
                                   dim, up > 0.0 ? "it lifts the body" : "nothing pulls the body down")),
           fmt::format("write unit_weight: 18 kN/m3, or force: [{}-18 kN/m3]", dim == 2 ? "0, " : "0, 0, ")});
    }
    const double size = force.norm();
    const bool is_light = up < 0.0 && -up < kLight;  // a force along the ground may be small
    if (is_light || size > kHeavy)
      remarks.push_back(
          {Rank::wrong, is_light ? kLight / -up : size / kHeavy,
           place.fault(fmt::format("body: a weight of {:.3g} kN/m3 (ground 10 to 25)", 1e-3 * size)),
           "check the unit: unit_weight is a force per volume, 18 kN/m3; a density of 1800 kg/m3 weighs 17.7 kN/m3"});
  }
}

}  // namespace

void weight(const Scene& scene, Remarks& remarks) {
  scene.with_problem([&](const auto& problem) { look_at_weight(scene, problem, remarks); });
}

}  // namespace polargrain::app
