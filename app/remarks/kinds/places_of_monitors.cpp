// SPDX-License-Identifier: GPL-2.0-or-later
// Monitors of the wrong boundary or axis, whose figures are a share of the one that is meant.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/remarks/kinds.hpp"
#include "app/remarks/outline.hpp"
#include "fem/mesh/box_around.hpp"

namespace polargrain::app {
namespace {

using coupler::Monitor;

std::string displacement_name(int axis) {
  return fmt::format("u{}", axis + 1);
}

bool is_along(fem::Dof dof, int axis) {
  return !fem::is_rotation(dof) && fem::axis_of(dof) == axis;
}

/// Where a flat boundary lies across an axis: at the lower or the upper end of the body, or not at an end at all.
enum class End { none, lower, upper };

template <int dim>
class Places {
 public:
  Places(const Scene& scene, const fem::Problem<dim>& problem, Remarks& remarks)
      : scene_(scene), problem_(problem), box_(fem::box_around(problem.mesh)), remarks_(remarks) {}

  /// The force along another axis than the one that its boundary is moved along.
  void look_at_force(const Monitor& monitor) {
    const int axis = fem::axis_of(monitor.dof);
    const std::string& on = monitor.on.front();
    if (moves(on, axis)) return;
    for (int other = 0; other < dim; ++other) {
      if (!moves(on, other) || reads(Monitor::Kind::reaction, other, [](const std::string&) { return true; }))
        continue;
      remarks_.push_back(
          {Rank::doubtful, 10.0,
           place_of(monitor).fault(fmt::format(
               "monitor '{}': '{}' is moved along {}, and no monitor reads the force along it: this one is along {}",
               monitor.name, on, displacement_name(other), displacement_name(axis))),
           fmt::format("write 'reaction: {}'", displacement_name(other))});
      return;
    }
  }

  void look_at_displacement(const Monitor& monitor) {
    if (!look_at_mean(monitor)) look_at_opposite(monitor);
  }

 private:
  [[nodiscard]] const coupler::Entry& place_of(const Monitor& monitor) const {
    return scene_.place({"monitors", monitor.name});
  }

  [[nodiscard]] bool moves(const std::string& on, int axis) const {
    return std::ranges::any_of(problem_.prescribed, [&](const fem::PrescribedDof<dim>& item) {
      return item.on == on && is_along(item.dof, axis) && item.value.largest_magnitude() > 0.0;
    });
  }

  [[nodiscard]] bool reads(Monitor::Kind kind, int axis, auto&& is_there) const {
    return std::ranges::any_of(scene_.the_case().monitors, [&](const Monitor& monitor) {
      return monitor.kind == kind && is_along(monitor.dof, axis) && std::ranges::any_of(monitor.on, is_there);
    });
  }

  [[nodiscard]] const typename Cosserat<dim>::Place& at(int node) const {
    return problem_.mesh.nodes[static_cast<std::size_t>(node)];
  }

  [[nodiscard]] End end_of(const std::string& boundary, int axis) const {
    if (!problem_.mesh.boundaries.contains(boundary)) return End::none;
    const std::vector<int> nodes = problem_.mesh.nodes_on(boundary);
    const double slack = 1e-6 * box_.sides()(axis);
    const auto all_at = [&](double end) {
      return std::ranges::all_of(nodes, [&](int node) { return std::abs(at(node)(axis) - end) < slack; });
    };
    if (nodes.empty()) return End::none;
    if (all_at(box_.least(axis))) return End::lower;
    return all_at(box_.largest(axis)) ? End::upper : End::none;
  }

  /// Whether a boundary at an end across another axis runs along this one from one end of the body to the other.
  [[nodiscard]] bool runs_along(const std::string& boundary, int axis) const {
    bool is_at_end = false;
    for (int across = 0; across < dim; ++across)
      is_at_end = is_at_end || (across != axis && end_of(boundary, across) != End::none);
    if (!is_at_end) return false;
    double least = HUGE_VAL;
    double largest = -HUGE_VAL;
    for (const int node : problem_.mesh.nodes_on(boundary)) {
      least = std::min(least, at(node)(axis));
      largest = std::max(largest, at(node)(axis));
    }
    return largest - least > 0.9 * box_.sides()(axis);
  }

  /// The mean along a side, from an end that is held to one that moves. @returns whether it is told
  bool look_at_mean(const Monitor& monitor) {
    const std::string& on = monitor.on.front();
    const int axis = fem::axis_of(monitor.dof);
    if (!runs_along(on, axis) || moves(on, axis)) return false;
    for (const auto& [name, sides] : problem_.mesh.boundaries) {
      if (!moves(name, axis) || end_of(name, axis) == End::none) continue;
      remarks_.push_back(
          {Rank::doubtful, 2.0,
           place_of(monitor).fault(fmt::format(
               "monitor '{}': the mean of {} along '{}', from one end of the body to the other; '{}', which is moved, "
               "goes about twice as far",
               monitor.name, displacement_name(axis), on, name)),
           fmt::format("write 'on: {}'", name)});
      return true;
    }
    return false;
  }

  /// One of two sides that are both free to go.
  void look_at_opposite(const Monitor& monitor) {
    const std::string& on = monitor.on.front();
    const int axis = fem::axis_of(monitor.dof);
    const End end = end_of(on, axis);
    if (end == End::none) return;
    const auto is_opposite = [&](const std::string& name) {
      const End there = end_of(name, axis);
      return there != End::none && there != end;
    };
    if (reads(Monitor::Kind::displacement, axis, is_opposite)) return;
    const auto nodes = held_nodes(problem_);
    const auto is_held = [&](const fem::BoundarySide& side) {
      return std::ranges::all_of(problem_.mesh.side_nodes(side), [&](int node) {
        return nodes[static_cast<std::size_t>(node)][static_cast<std::size_t>(axis)];
      });
    };
    for (const auto& [name, sides] : problem_.mesh.boundaries) {
      if (!is_opposite(name) || std::ranges::any_of(sides, is_held)) continue;
      remarks_.push_back(
          {Rank::doubtful, 2.0,
           place_of(monitor).fault(fmt::format(
               "monitor '{}': {} of '{}' alone, and '{}' opposite is free too: a strain made of it is about half",
               monitor.name, displacement_name(axis), on, name)),
           fmt::format("add a monitor of '{}', and take the difference", name)});
      return;
    }
  }

  const Scene& scene_;
  const fem::Problem<dim>& problem_;
  fem::BoxAround<dim> box_;
  Remarks& remarks_;
};

template <int dim>
void look_at_places(const Scene& scene, const fem::Problem<dim>& problem, Remarks& remarks) {
  if (!problem.ties.empty()) return;
  Places<dim> places(scene, problem, remarks);
  for (const Monitor& monitor : scene.the_case().monitors) {
    if (monitor.on.size() != 1 || fem::is_rotation(monitor.dof)) continue;
    if (monitor.kind == Monitor::Kind::reaction) places.look_at_force(monitor);
    if (monitor.kind == Monitor::Kind::displacement) places.look_at_displacement(monitor);
  }
}

}  // namespace

void places_of_monitors(const Scene& scene, Remarks& remarks) {
  scene.with_problem([&](const auto& problem) { look_at_places(scene, problem, remarks); });
}

}  // namespace polargrain::app
