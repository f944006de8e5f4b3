// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/picture/conditions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "app/remarks/in_units.hpp"

namespace polargrain::app {
namespace {

constexpr std::array<const char*, Cosserat<2>::dofs> kNames{"u1", "u2", "w"};

void add(std::string& list, const std::string& text) {
  list += (list.empty() ? "" : "; ") + text;
}

void add_prescribed(PlaceConditions& place, const fem::PrescribedDof<2>& item, double end) {
  const auto k = static_cast<std::size_t>(fem::place_of<2>(item.dof));
  if (item.value.largest_magnitude() == 0.0) {
    place.held[k] = true;
    add(place.supports, fmt::format("{} held", kNames[k]));
    return;
  }
  place.moved[k] = true;
  const double way = item.value.at(end) - item.value.at(0.0);
  if (item.dof != fem::Dof::w) place.movement(static_cast<Eigen::Index>(k)) = way;
  const std::string profile = item.profile ? " times a profile" : "";
  add(place.supports, item.dof == fem::Dof::w
                          ? fmt::format("w turned by {:.4g} rad{}", way, profile)
                          : fmt::format("{} moved by {:.4g} mm{}", kNames[k], 1e3 * way, profile));
}

void add_loads(PlaceConditions& place, const fem::BoundaryLoad<2>& load, double time, std::string& words) {
  if (const double p = load.pressure.at(time); p != 0.0) {
    place.pressed = true;
    place.pressure_sign = p > 0.0 ? 1.0 : -1.0;
    add(words, fmt::format("pressure {}", pascals(p)));
  }
  const Eigen::Vector2d traction(load.traction[0].at(time), load.traction[1].at(time));
  if (traction.norm() > 0.0) {
    place.pull = traction.normalized();
    add(words, fmt::format("traction ({}, {})", pascals(traction.x()), pascals(traction.y())));
  }
  if (const double couple = load.couple_traction[0].at(time); couple != 0.0)
    add(words, fmt::format("couple traction {:.4g} N/m", couple));
}

void add_load(PlaceConditions& place, const fem::NodeLoad& load, double time, std::string& words) {
  const double value = load.value.at(time);
  if (value == 0.0) return;
  if (load.dof == fem::Dof::w) {
    add(words, fmt::format("moment of {:.4g} N at each node", value));
    return;
  }
  place.pull = (place.pull + Eigen::Vector2d::Unit(fem::place_of<2>(load.dof)) * (value > 0.0 ? 1.0 : -1.0))
                   .normalized();
  add(words, fmt::format("force {} of {:.4g} N/m at each node",
                         kNames[static_cast<std::size_t>(fem::place_of<2>(load.dof))], value));
}

}  // namespace

bool PlaceConditions::is_free() const {
  return supports.empty() && loads_at_start.empty() && loads_at_end.empty() && tied_to.empty();
}

std::vector<PlaceConditions> conditions_of(const Scene& scene) {
  const fem::Problem<2>& problem = scene.problem();
  const double end = scene.end_time().value_or(1.0);
  std::set<std::string> names;
  for (const auto& [name, edges] : problem.mesh.boundaries) names.insert(name);
  for (const fem::PrescribedDof<2>& item : problem.prescribed) names.insert(item.on);
  for (const fem::NodeLoad& load : problem.node_loads) names.insert(load.on);
  for (const fem::Tie& tie : problem.ties) names.insert({tie.on, tie.to});
  std::vector<PlaceConditions> places;
  for (const std::string& name : names) {
    PlaceConditions place;
    place.name = name;
    place.is_boundary = problem.mesh.boundaries.contains(name);
    place.nodes = problem.mesh.nodes_on(name);
    for (const fem::Dof dof : {fem::Dof::u1, fem::Dof::u2, fem::Dof::w})
      for (const fem::PrescribedDof<2>& item : problem.prescribed)
        if (item.on == name && item.dof == dof) add_prescribed(place, item, end);
    for (const fem::BoundaryLoad<2>& load : problem.boundary_loads) {
      if (load.on != name) continue;
      add_loads(place, load, 0.0, place.loads_at_start);
      add_loads(place, load, end, place.loads_at_end);
    }
    for (const fem::NodeLoad& load : problem.node_loads) {
      if (load.on != name) continue;
      add_load(place, load, 0.0, place.loads_at_start);
      add_load(place, load, end, place.loads_at_end);
    }
    for (const fem::Tie& tie : problem.ties) {
      if (tie.on == name) place.tied_to = tie.to;
      if (tie.to == name) place.tied_to = tie.on;
    }
    if (!place.tied_to.empty()) add(place.supports, fmt::format("moves as '{}'", place.tied_to));
    places.push_back(std::move(place));
  }
  return places;
}

}  // namespace polargrain::app
