// SPDX-License-Identifier: GPL-2.0-or-later
// Nodes at one place that no element joins: parts of a mesh that touch and do not hold each other.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "app/remarks/kinds.hpp"

namespace polargrain::app {
namespace {

/// Of a mean element: nearer nodes are at one place.
constexpr double kOnePlace = 1e-6;

/// Nodes that share a place, by the place in steps of a small length. Nodes of no element do not count.
std::map<std::array<long long, 2>, std::vector<int>> nodes_by_place(const Scene& scene) {
  std::set<int> used;
  for (const fem::Element<2>& element : scene.mesh().elements)
    used.insert(element.nodes.begin(), element.nodes.end());
  const double step = kOnePlace * scene.body().mean_element;
  std::map<std::array<long long, 2>, std::vector<int>> places;
  for (const int node : used) {
    const Eigen::Vector2d place =
        (scene.mesh().nodes[static_cast<std::size_t>(node)] - scene.body().least) / step;
    places[{std::llround(place.x()), std::llround(place.y())}].push_back(node);
  }
  return places;
}

}  // namespace

void open_seams(const Scene& scene, Remarks& remarks) {
  std::set<std::pair<int, int>> joined;  // by an element, as one of an interface does
  const auto places = nodes_by_place(scene);
  std::set<int> twice;
  for (const auto& [place, nodes] : places)
    if (nodes.size() > 1) twice.insert(nodes.begin(), nodes.end());
  if (twice.empty()) return;
  for (const fem::Element<2>& element : scene.mesh().elements)
    for (const int a : element.nodes)
      for (const int b : element.nodes)
        if (a < b && twice.contains(a) && twice.contains(b)) joined.emplace(a, b);
  // An interface joins both of its sides, perhaps by a wall between them.
  std::set<int> held;
  const int stages = std::max(1, static_cast<int>(scene.problem().stages.size()));
  for (int stage = 0; stage < stages; ++stage)
    for (const auto& [a, b] : fem::joined_nodes(scene.problem(), stage)) {
      held.insert(a);
      held.insert(b);
    }
  int count = 0;
  const Eigen::Vector2d* first = nullptr;
  for (const auto& [place, nodes] : places)
    for (std::size_t k = 1; k < nodes.size(); ++k) {
      if (joined.contains({nodes[k - 1], nodes[k]}) ||
          (held.contains(nodes[k - 1]) && held.contains(nodes[k])))
        continue;
      ++count;
      if (first == nullptr) first = &scene.mesh().nodes[static_cast<std::size_t>(nodes[k])];
    }
  if (count == 0) return;
  remarks.push_back(
      {Rank::wrong, static_cast<double>(count),
       scene.place({"mesh"}).fault(fmt::format(
           "mesh: {} pairs of nodes lie at one place each, the first at {} m, and no element joins them: the parts that "
           "meet there do not hold each other",
           count, fem::place_text<2>(*first))),
       "let both parts share these nodes: in Gmsh, Coherence; or BooleanFragments before Physical groups"});
}

}  // namespace polargrain::app
