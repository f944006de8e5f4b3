// SPDX-License-Identifier: GPL-2.0-or-later
// Monitors of the wrong boundary or axis, whose figures are a share of the one that is meant.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/remarks/kinds.hpp"

namespace polargrain::app {
namespace {

using coupler::Monitor;

const char* displacement_name(fem::Dof dof) {
  return dof == fem::Dof::u1 ? "u1" : "u2";
}

bool moves(const Scene& scene, const std::string& on, fem::Dof dof) {
  return std::ranges::any_of(scene.problem().prescribed, [&](const fem::PrescribedDof<2>& item) {
    return item.on == on && item.dof == dof && item.value.largest_magnitude() > 0.0;
  });
}

/// Where a straight boundary lies across an axis: at the lower or the upper end of the body, or not at an end at all.
enum class End { none, lower, upper };
End end_of(const Scene& scene, const std::string& boundary, int axis) {
  if (!scene.mesh().boundaries.contains(boundary)) return End::none;
  const double slack = 1e-6 * scene.body().size()(axis);
  const std::vector<OutlineEdge> edges = edges_of(scene.mesh(), boundary);
  const auto all_at = [&](double place) {
    return std::ranges::all_of(
        edges, [&](const OutlineEdge& edge) { return std::abs(edge.centre(axis) - place) < slack; });
  };
  if (edges.empty()) return End::none;
  if (all_at(scene.body().least(axis))) return End::lower;
  return all_at(scene.body().largest(axis)) ? End::upper : End::none;
}

/// Whether a boundary runs along an axis from one end of the body to the other.
bool runs_along(const Scene& scene, const std::string& boundary, int axis) {
  const int across = 1 - axis;
  if (end_of(scene, boundary, across) == End::none) return false;
  double length = 0.0;
  for (const OutlineEdge& edge : edges_of(scene.mesh(), boundary)) length += edge.length;
  return length > 0.9 * scene.body().size()(axis);
}

bool reads(const Scene& scene, Monitor::Kind kind, fem::Dof dof, auto&& is_there) {
  return std::ranges::any_of(scene.the_case().monitors, [&](const Monitor& monitor) {
    return monitor.kind == kind && monitor.dof == dof && std::ranges::any_of(monitor.on, is_there);
  });
}

/// The force along another axis than the one that its boundary is moved along.
void look_at_force(const Scene& scene, const Monitor& monitor, Remarks& remarks) {
  const fem::Dof other = monitor.dof == fem::Dof::u1 ? fem::Dof::u2 : fem::Dof::u1;
  const std::string& on = monitor.on.front();
  if (moves(scene, on, monitor.dof) || !moves(scene, on, other)) return;
  if (reads(scene, Monitor::Kind::reaction, other, [](const std::string&) { return true; })) return;
  remarks.push_back({Rank::doubtful, 10.0,
                     scene.place({"monitors", monitor.name})
                         .fault(fmt::format(
                             "monitor '{}': '{}' is moved along {}, and no monitor reads the force along it: "
                             "this one is along {}",
                             monitor.name, on, displacement_name(other), displacement_name(monitor.dof))),
                     fmt::format("write 'reaction: {}'", displacement_name(other))});
}

void look_at_place_of_displacement(const Scene& scene, const Monitor& monitor, Remarks& remarks) {
  const std::string& on = monitor.on.front();
  const int axis = fem::axis_of(monitor.dof);
  const char* const dof = displacement_name(monitor.dof);
  const coupler::Entry& place = scene.place({"monitors", monitor.name});
  // The mean along a side, from an end that is held to one that moves.
  for (const auto& [name, edges] : scene.mesh().boundaries) {
    if (!moves(scene, name, monitor.dof) || end_of(scene, name, axis) == End::none) continue;
    if (!runs_along(scene, on, axis) || moves(scene, on, monitor.dof)) continue;
    remarks.push_back({Rank::doubtful, 2.0,
                       place.fault(fmt::format(
                           "monitor '{}': the mean of {} along '{}', from one end of the body to the other; "
                           "'{}', which is moved, goes about twice as far",
                           monitor.name, dof, on, name)),
                       fmt::format("write 'on: {}'", name)});
    return;
  }
  // One of two sides that are both free to go.
  const End end = end_of(scene, on, axis);
  if (end == End::none) return;
  const auto held = held_nodes(scene.problem());
  const auto is_opposite = [&](const std::string& name) {
    const End there = end_of(scene, name, axis);
    return there != End::none && there != end;
  };
  if (reads(scene, Monitor::Kind::displacement, monitor.dof, is_opposite)) return;
  for (const auto& [name, edges] : scene.mesh().boundaries) {
    if (!is_opposite(name)) continue;
    const std::vector<OutlineEdge> outline = edges_of(scene.mesh(), name);
    const bool any_held = std::ranges::any_of(outline, [&](const OutlineEdge& edge) {
      return std::ranges::all_of(edge.nodes, [&](int node) {
        return held[static_cast<std::size_t>(node)][static_cast<std::size_t>(axis)];
      });
    });
    if (any_held) continue;
    remarks.push_back({Rank::doubtful, 2.0,
                       place.fault(fmt::format(
                           "monitor '{}': {} of '{}' alone, and '{}' opposite is free too: a strain made of "
                           "it is about half",
                           monitor.name, dof, on, name)),
                       fmt::format("add a monitor of '{}', and take the difference", name)});
    return;
  }
}

}  // namespace

void places_of_monitors(const Scene& scene, Remarks& remarks) {
  if (!scene.problem().ties.empty()) return;
  for (const Monitor& monitor : scene.the_case().monitors) {
    if (monitor.kind == Monitor::Kind::formula || monitor.kind == Monitor::Kind::water ||
        monitor.dof == fem::Dof::w || monitor.on.size() != 1)
      continue;
    if (monitor.kind == Monitor::Kind::reaction)
      look_at_force(scene, monitor, remarks);
    else
      look_at_place_of_displacement(scene, monitor, remarks);
  }
}

}  // namespace polargrain::app
