// SPDX-License-Identifier: GPL-2.0-or-later
// Movements and pore pressures of a curve that an interface parts: its name stands for the ground on one side.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "app/remarks/kinds.hpp"
#include "fem/interface/interface.hpp"
#include "fem/water/water_across.hpp"

namespace polargrain::app {
namespace {

/// The interface that parts most nodes of a boundary from others that are not on it; null: no interface does.
template <int dim>
const fem::Interface<dim>* parting(const fem::Problem<dim>& problem, const std::string& boundary) {
  const std::vector<int> nodes = problem.mesh.nodes_on(boundary);  // ascending
  const auto is_on = [&](int node) { return std::ranges::binary_search(nodes, node); };
  for (const auto& contribution : problem.contributions) {
    const auto* const interface = dynamic_cast<const fem::Interface<dim>*>(contribution.get());
    if (interface == nullptr || !interface->settings().parts_ground) continue;
    std::set<int> parted;
    for (std::size_t e = 0; e < interface->elements(); ++e) {
      const fem::InterfaceFace<dim>& face = interface->face(e);
      for (std::size_t a = 0; a < face.nodes_a.size(); ++a)
        if (is_on(face.nodes_a[a]) != is_on(face.nodes_b[a]))
          parted.insert(is_on(face.nodes_a[a]) ? face.nodes_a[a] : face.nodes_b[a]);
    }
    if (2 * parted.size() > nodes.size()) return interface;
  }
  return nullptr;
}

/// Whether both sides of an interface have one pore pressure.
template <int dim>
bool lets_water_pass(const fem::Problem<dim>& problem, const std::string& interface) {
  for (const auto& contribution : problem.contributions) {
    const auto* const across = dynamic_cast<const fem::WaterAcross<dim>*>(contribution.get());
    if (across != nullptr && across->options().name == interface)
      return across->options().passage == fem::Passage::permeable;
  }
  return true;
}

}  // namespace

void parted_curves(const Scene& scene, Remarks& remarks) {
  scene.the_case().with_problem([&](const auto& problem) {
    for (const coupler::Monitor& monitor : scene.the_case().monitors) {
      const bool of_water = monitor.kind == coupler::Monitor::Kind::water && monitor.value == "pressure";
      if ((monitor.kind != coupler::Monitor::Kind::displacement && !of_water) || monitor.on.size() != 1 ||
          !problem.mesh.boundaries.contains(monitor.on.front()))
        continue;
      const auto* const interface = parting(problem, monitor.on.front());
      if (interface == nullptr) continue;
      const std::string& name = interface->settings().name;
      if (of_water && lets_water_pass(problem, name)) continue;
      remarks.push_back(
          {Rank::doubtful, 2.0,
           scene.place({"monitors", monitor.name})
               .fault(fmt::format(
                   "monitor '{}': the interface '{}' parts '{}', and these are the nodes of one side alone",
                   monitor.name, name, monitor.on.front())),
           of_water
               ? "read a line beside the interface, on each side"
               : fmt::format(
                     "read a place to each side ({{at: [..], displacement: ..}}), a beam by its own name, or the way "
                     "between the sides ({{interface: {}, value: slip}})",
                     name)});
    }
  });
}

}  // namespace polargrain::app
