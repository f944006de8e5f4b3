// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/picture/conditions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include "app/remarks/in_units.hpp"
#include "fem/water/free_water.hpp"

namespace polargrain::app {
namespace {

void add(std::string& list, const std::string& text) {
  list += (list.empty() ? "" : "; ") + text;
}

template <int dim>
void add_prescribed(PlaceConditions<dim>& place, const fem::PrescribedDof<dim>& item, double end) {
  const int entry = fem::place_of<dim>(item.dof);
  const auto k = static_cast<std::size_t>(entry);
  const std::string_view name = fem::name_of<dim>(item.dof);
  if (item.value.largest_magnitude() == 0.0) {
    place.held[k] = true;
    add(place.supports, fmt::format("{} held", name));
    return;
  }
  place.moved[k] = true;
  const double way = item.value.at(end) - item.value.at(0.0);
  const std::string profile = item.profile ? " times a profile" : "";
  if (fem::is_rotation(item.dof)) {
    add(place.supports, fmt::format("{} turned by {:.4g} rad{}", name, way, profile));
    return;
  }
  place.movement(entry) = way;
  add(place.supports, fmt::format("{} moved by {:.4g} mm{}", name, 1e3 * way, profile));
}

template <int dim>
void add_loads(PlaceConditions<dim>& place, const fem::BoundaryLoad<dim>& load, double time,
               std::string& words) {
  if (const double p = load.pressure.at(time); p != 0.0) {
    place.pressed = true;
    place.pressure_sign = p > 0.0 ? 1.0 : -1.0;
    add(words, fmt::format("pressure {}", pascals(p)));
  }
  typename PlaceConditions<dim>::Direction traction;
  std::string components;
  for (int i = 0; i < dim; ++i) {
    traction(i) = load.traction[static_cast<std::size_t>(i)].at(time);
    components += (i > 0 ? ", " : "") + pascals(traction(i));
  }
  if (traction.norm() > 0.0) {
    place.pull = traction.normalized();
    add(words, fmt::format("traction ({})", components));
  }
  for (const fem::TimeTable& table : load.couple_traction)
    if (const double couple = table.at(time); couple != 0.0)
      add(words, fmt::format("couple traction {:.4g} N/m", couple));
}

template <int dim>
void add_load(PlaceConditions<dim>& place, const fem::NodeLoad& load, double time, std::string& words) {
  constexpr const char* kForce = dim == 2 ? "N/m" : "N";
  constexpr const char* kMoment = dim == 2 ? "N" : "N m";
  const double value = load.value.at(time);
  if (value == 0.0) return;
  if (fem::is_rotation(load.dof)) {
    add(words, fmt::format("moment of {:.4g} {} at each node", value, kMoment));
    return;
  }
  using Direction = typename PlaceConditions<dim>::Direction;
  place.pull =
      (place.pull + Direction::Unit(fem::place_of<dim>(load.dof)) * (value > 0.0 ? 1.0 : -1.0)).normalized();
  add(words, fmt::format("force {} of {:.4g} {} at each node", fem::name_of<dim>(load.dof), value, kForce));
}

template <int dim>
void add_water(PlaceConditions<dim>& place, const fem::FreeWater<dim>& water, int last_stage, double end) {
  const auto words = [&](double time) {
    return fmt::format("free water to {:.4g} m", water.level().at(time));
  };
  const bool at_start = water.life.holds(0);
  const bool at_end = water.life.holds(last_stage);
  place.water_level = water.level().at(at_start && !at_end ? 0.0 : end);
  if constexpr (dim == 3) place.pressed = true;
  if (at_start) add(place.loads_at_start, words(0.0));
  if (at_end) add(place.loads_at_end, words(end));
  if (!at_start && !at_end) add(place.loads_at_end, words(end) + " for some stages");
}

/// Looks for the sides of places without conditions in places that have some: 'bottom_patch' is held where 'bottom' is.
template <int dim>
void find_elsewhere(const fem::Mesh<dim>& mesh, std::vector<PlaceConditions<dim>>& places) {
  using Side = std::pair<int, int>;
  std::map<std::string, std::set<Side>> sides_with_conditions;
  for (const PlaceConditions<dim>& place : places)
    if (place.is_boundary && place.has_conditions())
      for (const fem::BoundarySide& side : mesh.boundaries.at(place.name))
        sides_with_conditions[place.name].insert({side.element, side.side});
  for (PlaceConditions<dim>& place : places) {
    if (!place.is_boundary || place.has_conditions()) continue;
    std::set<Side> left;
    for (const fem::BoundarySide& side : mesh.boundaries.at(place.name))
      left.insert({side.element, side.side});
    const std::set<Side> own = left;
    for (const auto& [name, sides] : sides_with_conditions) {
      std::set<Side> shared;
      std::ranges::set_intersection(own, sides, std::inserter(shared, shared.end()));
      if (shared.empty()) continue;
      place.elsewhere.push_back(name);
      for (const Side& side : shared) left.erase(side);
    }
    place.all_elsewhere = left.empty();
  }
}

}  // namespace

template <int dim>
std::vector<PlaceConditions<dim>> conditions_of(const fem::Problem<dim>& problem, double end) {
  std::set<std::string> names;
  for (const auto& [name, sides] : problem.mesh.boundaries) names.insert(name);
  for (const fem::PrescribedDof<dim>& item : problem.prescribed) names.insert(item.on);
  for (const fem::NodeLoad& load : problem.node_loads) names.insert(load.on);
  for (const fem::Tie& tie : problem.ties) names.insert({tie.on, tie.to});
  std::vector<const fem::FreeWater<dim>*> waters;
  for (const auto& contribution : problem.contributions)
    if (const auto* const water = dynamic_cast<const fem::FreeWater<dim>*>(contribution.get())) {
      waters.push_back(water);
      names.insert(water->on());
    }
  const int last_stage = std::max(0, static_cast<int>(problem.stages.size()) - 1);
  std::vector<PlaceConditions<dim>> places;
  for (const std::string& name : names) {
    PlaceConditions<dim> place;
    place.name = name;
    place.is_boundary = problem.mesh.boundaries.contains(name);
    place.nodes = problem.mesh.nodes_on(name);
    for (const fem::Dof dof : fem::node_dofs<dim>())
      for (const fem::PrescribedDof<dim>& item : problem.prescribed)
        if (item.on == name && item.dof == dof) add_prescribed(place, item, end);
    for (const fem::BoundaryLoad<dim>& load : problem.boundary_loads) {
      if (load.on != name) continue;
      add_loads(place, load, 0.0, place.loads_at_start);
      add_loads(place, load, end, place.loads_at_end);
    }
    for (const fem::NodeLoad& load : problem.node_loads) {
      if (load.on != name) continue;
      add_load(place, load, 0.0, place.loads_at_start);
      add_load(place, load, end, place.loads_at_end);
    }
    for (const fem::FreeWater<dim>* const water : waters)
      if (water->on() == name) add_water(place, *water, last_stage, end);
    for (const fem::Tie& tie : problem.ties) {
      if (tie.on == name) place.tied_to = tie.to;
      if (tie.to == name) place.tied_to = tie.on;
    }
    if (!place.tied_to.empty()) add(place.supports, fmt::format("moves as '{}'", place.tied_to));
    places.push_back(std::move(place));
  }
  find_elsewhere(problem.mesh, places);
  return places;
}

template std::vector<PlaceConditions<2>> conditions_of<2>(const fem::Problem<2>& problem, double end);
template std::vector<PlaceConditions<3>> conditions_of<3>(const fem::Problem<3>& problem, double end);

}  // namespace polargrain::app
