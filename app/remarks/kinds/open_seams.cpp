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
#include "fem/mesh/box_around.hpp"

namespace polargrain::app {
namespace {

/// Of a mean element: nearer nodes are at one place.
constexpr double kOnePlace = 1e-6;

/// Nodes that share a place, by the place in steps of a small length. Nodes of no element do not count.
template <int dim>
std::map<std::array<long long, dim>, std::vector<int>> nodes_by_place(const fem::Mesh<dim>& mesh,
                                                                      double mean_element) {
  std::set<int> used;
  for (const fem::Element<dim>& element : mesh.elements)
    used.insert(element.nodes.begin(), element.nodes.end());
  const double step = kOnePlace * mean_element;
  const auto least = fem::box_around(mesh).least;
  std::map<std::array<long long, dim>, std::vector<int>> places;
  for (const int node : used) {
    std::array<long long, dim> place;
    for (int i = 0; i < dim; ++i)
      place[static_cast<std::size_t>(i)] =
          std::llround((mesh.nodes[static_cast<std::size_t>(node)](i) - least(i)) / step);
    places[place].push_back(node);
  }
  return places;
}

template <int dim>
void look_at_seams(const Scene& scene, const fem::Problem<dim>& problem, Remarks& remarks) {
  const fem::Mesh<dim>& mesh = problem.mesh;
  std::set<std::pair<int, int>> joined;  // by an element, as one of an interface does
  const auto places = nodes_by_place(mesh, scene.body().mean_element);
  std::set<int> twice;
  for (const auto& [place, nodes] : places)
    if (nodes.size() > 1) twice.insert(nodes.begin(), nodes.end());
  if (twice.empty()) return;
  for (const fem::Element<dim>& element : mesh.elements)
    for (const int a : element.nodes)
      for (const int b : element.nodes)
        if (a < b && twice.contains(a) && twice.contains(b)) joined.emplace(a, b);
  // An interface joins both of its sides, perhaps by a wall between them.
  std::set<int> held;
  const int stages = std::max(1, static_cast<int>(problem.stages.size()));
  for (int stage = 0; stage < stages; ++stage)
    for (const auto& [a, b] : fem::joined_nodes(problem, stage)) {
      held.insert(a);
      held.insert(b);
    }
  int count = 0;
  const typename Cosserat<dim>::Place* first = nullptr;
  for (const auto& [place, nodes] : places)
    for (std::size_t k = 1; k < nodes.size(); ++k) {
      if (joined.contains({nodes[k - 1], nodes[k]}) ||
          (held.contains(nodes[k - 1]) && held.contains(nodes[k])))
        continue;
      ++count;
      if (first == nullptr) first = &mesh.nodes[static_cast<std::size_t>(nodes[k])];
    }
  if (count == 0) return;
  remarks.push_back(
      {Rank::wrong, static_cast<double>(count),
       scene.place({"mesh"}).fault(fmt::format(
           "mesh: {} pairs of nodes lie at one place each, the first at {} m, and no element joins them: the parts that "
           "meet there do not hold each other",
           count, fem::place_text<dim>(*first))),
       "let both parts share these nodes: in Gmsh, Coherence; or BooleanFragments before Physical groups"});
}

}  // namespace

void open_seams(const Scene& scene, Remarks& remarks) {
  scene.with_problem([&](const auto& problem) { look_at_seams(scene, problem, remarks); });
}

}  // namespace polargrain::app
