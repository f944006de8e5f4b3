// SPDX-License-Identifier: GPL-2.0-or-later
// Pulses in real time, whose waves are to be longer than the sides of elements.
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "app/remarks/base_motions.hpp"
#include "app/remarks/in_units.hpp"
#include "app/remarks/kinds.hpp"
#include "app/remarks/lengths.hpp"
#include "app/remarks/shortest_pulse.hpp"

namespace polargrain::app {
namespace {

using coupler::Entry;

/// Sides of an element in the wave of a pulse with which 10 to 15 % of its peak are lost (bars under triangles of 6 to 27 ms).
constexpr double kSidesOfAWave = 5.0;
constexpr double kSidesOfAWaveInH20 = 7.0;  // and in W15

struct Pulse {
  double seconds;  ///< 0: no pulse
  const Entry* at;
};

/// The shortest of all loads and movements.
template <int dim>
Pulse shortest_of(const Scene& scene, const fem::Problem<dim>& problem, double end) {
  Pulse shortest{0.0, nullptr};
  const auto look = [&](double seconds, const Entry* at, const char* otherwise) {
    if (!(seconds > 0.0) || (shortest.seconds > 0.0 && seconds >= shortest.seconds)) return;
    shortest = {seconds, at != nullptr ? at : &scene.place({otherwise})};
  };
  const auto look_at_load = [&](const fem::TimeTable& load, const Entry* at, const char* otherwise) {
    look(shortest_pulse(values_until(load, end)), at, otherwise);
  };
  for (const auto& load : problem.boundary_loads) {
    look_at_load(load.pressure, scene.boundary_value(load.on, "pressure"), "boundary");
    for (const fem::TimeTable& along : load.traction)
      look_at_load(along, scene.boundary_value(load.on, "traction"), "boundary");
  }
  for (const fem::NodeLoad& load : problem.node_loads)
    if (!is_rotation(load.dof)) look_at_load(load.value, nullptr, "boundary");
  for (const auto& load : problem.body_loads) look_at_load(load.factor, nullptr, "body");
  for (const auto& given : problem.prescribed) {
    if (is_rotation(given.dof)) continue;
    const char* const key = given.value.is_accelerated() ? "accelerate" : "move";
    look(shortest_pulse(speeds_until(given.value, end)), scene.boundary_value(given.on, key), "boundary");
  }
  return shortest;
}

template <int dim>
double least_sides(const fem::ElementType<dim>& type) {
  constexpr int kCornersOfTetrahedron = 4;
  const bool is_space = dim == 3 && type.corners > kCornersOfTetrahedron;
  return is_space && type.nodes > type.corners ? kSidesOfAWaveInH20 : kSidesOfAWave;
}

/// Elements in which a wave stays even, in place of those with middle nodes; empty: no such shape.
std::string even_elements(const std::string& type) {
  if (type.starts_with("H20")) return "H8 or H8R";
  return type.starts_with("Q8") ? "Q4 or Q4R" : "";
}

template <int dim>
double largest_side(const fem::Mesh<dim>& mesh, const fem::Element<dim>& element) {
  double largest = 0.0;
  for (const fem::ElementSide<dim>& side : element.type->sides) {
    const auto corners = static_cast<std::size_t>(side.type->corners);
    const auto place = [&](std::size_t k) {
      const int local = side.nodes[k % corners];
      return mesh.nodes[static_cast<std::size_t>(element.nodes[static_cast<std::size_t>(local)])];
    };
    for (std::size_t k = 0; k < corners; ++k) largest = std::max(largest, (place(k + 1) - place(k)).norm());
  }
  return largest;
}

/// The median of the largest sides, m.
template <int dim>
double usual_largest_side(const fem::Mesh<dim>& mesh, const SceneRegion& region) {
  std::vector<double> sides;
  for (const int element : region.elements)
    sides.push_back(largest_side(mesh, mesh.elements[static_cast<std::size_t>(element)]));
  const auto middle = sides.begin() + static_cast<std::ptrdiff_t>(sides.size() / 2);
  std::ranges::nth_element(sides, middle);
  return *middle;
}

template <int dim>
void look_at_region(const Scene& scene, const fem::Mesh<dim>& mesh, const SceneRegion& region,
                    const Pulse& pulse, Remarks& remarks) {
  const auto speeds = wave_speeds(scene, region);
  if (!speeds || region.elements.empty()) return;
  const auto& type = *mesh.elements[static_cast<std::size_t>(region.elements.front())].type;
  // Lumped masses move corners and middle nodes differently even under an even wave, so sides across it count too.
  const bool has_middles = type.nodes > type.corners;
  const double side = has_middles ? usual_largest_side(mesh, region) : usual_element(scene, region);
  const double least = least_sides(type);
  const double wave = speeds->compression * pulse.seconds;
  if (least * side <= wave) return;
  const std::string instead = has_middles ? even_elements(type.name) : "";
  remarks.push_back(
      {Rank::doubtful, least * side / wave,
       pulse.at->fault(fmt::format(
           "the pulse there takes {:.3g} ms, whose compression wave is {} long in region '{}': {:.2g} "
           "sides of {} elements (at least {:g}), so its peak is lost in part",
           1e3 * pulse.seconds, metres(wave), region.name, wave / side, type.name, least)),
       fmt::format("{}{}elements of {} and less{}", instead.empty() ? "" : "element: " + instead,
                   instead.empty() ? "" : "; or ", metres(wave / least),
                   has_middles ? " in all directions, also across the wave" : ", or a longer pulse")});
}

}  // namespace

void length_of_pulses(const Scene& scene, Remarks& remarks) {
  const auto end = scene.end_time();
  if (!scene.the_case().real_time || !end) return;
  scene.with_problem([&](const auto& problem) {
    const Pulse pulse = shortest_of(scene, problem, *end);
    if (!(pulse.seconds > 0.0)) return;
    for (const SceneRegion& region : scene.regions())
      look_at_region(scene, problem.mesh, region, pulse, remarks);
  });
}

}  // namespace polargrain::app
