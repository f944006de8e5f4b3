// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/remarks/lengths.hpp"

#include <algorithm>
#include <cmath>

namespace polargrain::app {

double usual_element(const Scene& scene, const SceneRegion& region) {
  std::vector<double> sizes;
  for (const int element : region.elements)
    sizes.push_back(scene.body().elements[static_cast<std::size_t>(element)]);
  if (sizes.empty()) return 0.0;
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::ranges::nth_element(sizes, middle);
  return *middle;
}

template <int dim>
double height_of(const fem::Mesh<dim>& mesh, const std::vector<int>& elements) {
  double least = HUGE_VAL;
  double largest = -HUGE_VAL;
  for (const int element : elements)
    for (const int node : mesh.elements[static_cast<std::size_t>(element)].nodes) {
      least = std::min(least, mesh.nodes[static_cast<std::size_t>(node)](dim - 1));
      largest = std::max(largest, mesh.nodes[static_cast<std::size_t>(node)](dim - 1));
    }
  return std::max(0.0, largest - least);
}

template double height_of<2>(const fem::Mesh<2>&, const std::vector<int>&);
template double height_of<3>(const fem::Mesh<3>&, const std::vector<int>&);

std::vector<double> whole_sides(const Scene& scene) {
  std::vector<double> sides = scene.body().sides;
  const coupler::Entry* const sector = scene.find({"mesh", "cylinder", "sector"});
  if (sector == nullptr || sector->text == "whole") return sides;
  sides[1] *= 2.0;
  if (sector->text == "quarter") sides[0] *= 2.0;
  return sides;
}

double smaller_whole_side(const Scene& scene) {
  return std::ranges::min(whole_sides(scene));
}

bool is_strong(const Scene& scene, const SceneRegion& region) {
  return region.cell != nullptr || scene.find({"materials", region.material, "friction_angle"}) != nullptr;
}

namespace {

/// Whether the last of a list of values, or of [plastic shear, value], is below the largest.
bool falls(const coupler::Entry* entry, coupler::Dimension dimension) {
  if (entry == nullptr || entry->kind != coupler::Entry::Kind::sequence) return false;
  double largest = 0.0;
  double last = 0.0;
  for (const coupler::Entry& item : entry->items) {
    const coupler::Entry& value = item.items.size() == 2 ? item.items[1] : item;
    last = coupler::parse_quantity(value.text, dimension).value_or(0.0);
    largest = std::max(largest, last);
  }
  return last < largest;
}

}  // namespace

bool softens(const Scene& scene, const SceneRegion& region) {
  return region.cell != nullptr ||
         falls(scene.find({"materials", region.material, "friction_angle"}), coupler::Dimension::angle) ||
         falls(scene.find({"materials", region.material, "cohesion"}), coupler::Dimension::pressure);
}

}  // namespace polargrain::app
