// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/solver/stages.hpp"

#include <algorithm>
#include <map>

#include "fem/solver/problem.hpp"

namespace polargrain::fem {

template <int dim>
std::vector<char> elements_in_stage(const Problem<dim>& problem, int stage) {
  std::vector<char> there;
  for (const auto& [region, life] : problem.lifetimes) {
    if (life.holds(stage)) continue;
    there.resize(problem.mesh.elements.size(), 1);
    for (const int e : problem.mesh.regions.at(region)) there[static_cast<std::size_t>(e)] = 0;
  }
  return there;
}

template <int dim>
std::vector<char> nodes_of_elements(const Mesh<dim>& mesh, const std::vector<char>& there) {
  std::vector<char> nodes(mesh.nodes.size(), 0);
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    if (!there.empty() && there[e] == 0) continue;
    for (const int node : mesh.elements[e].nodes) nodes[static_cast<std::size_t>(node)] = 1;
  }
  return nodes;
}

namespace {

template <int dim>
std::vector<int> sorted_nodes(const Mesh<dim>& mesh, const BoundarySide& side) {
  std::vector<int> nodes = mesh.side_nodes(side);
  std::ranges::sort(nodes);
  return nodes;
}

using SidesByNodes = std::map<std::vector<int>, std::vector<BoundarySide>>;

/// Of each of `sides` those that are there, as the elements see them: one, or two where they meet inside of the body.
template <int dim>
SidesByNodes sides_there(const Mesh<dim>& mesh, const std::vector<BoundarySide>& sides,
                         const std::vector<char>& there) {
  SidesByNodes by_nodes;
  for (const BoundarySide& side : sides) by_nodes.try_emplace(sorted_nodes(mesh, side));
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    if (!there.empty() && there[e] == 0) continue;
    for (std::size_t k = 0; k < mesh.elements[e].type->sides.size(); ++k) {
      const BoundarySide side{static_cast<int>(e), static_cast<int>(k)};
      if (const auto place = by_nodes.find(sorted_nodes(mesh, side)); place != by_nodes.end())
        place->second.push_back(side);
    }
  }
  return by_nodes;
}

/// Whether each element carries a load that acts on it inside of the body.
template <int dim>
std::vector<char> elements_inside_of(const Problem<dim>& problem, const BoundaryLoad<dim>& load, int stage) {
  std::vector<char> stands(problem.mesh.elements.size(), 1);
  for (const auto& [region, life] : problem.lifetimes) {
    if (load.life.begin == 0 ? life.holds(0) && life.holds(stage) : life.is_whole()) continue;
    for (const int e : problem.mesh.regions.at(region)) stands[static_cast<std::size_t>(e)] = 0;
  }
  return stands;
}

}  // namespace

template <int dim>
std::vector<BoundarySide> sides_in_stage(const Problem<dim>& problem, const BoundaryLoad<dim>& load,
                                         int stage) {
  const Mesh<dim>& mesh = problem.mesh;
  const std::vector<BoundarySide>& sides = mesh.boundaries.at(load.on);
  const std::vector<char> there = elements_in_stage(problem, stage);
  if (there.empty()) return sides;
  const SidesByNodes by_nodes = sides_there(mesh, sides, there);
  const std::vector<char> stands = elements_inside_of(problem, load, stage);
  const auto is_inside = [&](const BoundarySide& side) {
    return stands[static_cast<std::size_t>(side.element)] != 0;
  };
  std::vector<BoundarySide> found;
  for (const BoundarySide& side : sides) {
    const std::vector<BoundarySide>& here = by_nodes.at(sorted_nodes(mesh, side));
    if (here.size() == 1)
      found.push_back(here.front());
    else if (here.size() == 2 && std::ranges::all_of(here, is_inside))
      found.push_back(side);
  }
  return found;
}

template <int dim>
std::vector<BoundarySide> covered_sides(const Mesh<dim>& mesh, std::vector<BoundarySide> sides,
                                        const std::vector<char>& there) {
  const SidesByNodes by_nodes = sides_there(mesh, sides, there);
  std::erase_if(sides,
                [&](const BoundarySide& side) { return by_nodes.at(sorted_nodes(mesh, side)).size() < 2; });
  return sides;
}

template <int dim>
std::vector<char> nodes_in_stage(const Mesh<dim>& mesh, const std::vector<char>& there) {
  std::vector<char> nodes = nodes_of_elements(mesh, there);
  const std::vector<char> of_mesh = nodes_of_elements(mesh, {});
  for (std::size_t node = 0; node < nodes.size(); ++node)
    if (of_mesh[node] == 0) nodes[node] = 1;
  return nodes;
}

template <int dim>
std::vector<std::pair<int, int>> joined_nodes(const Problem<dim>& problem, int stage) {
  const std::vector<char> there = elements_in_stage(problem, stage);
  std::vector<std::pair<int, int>> all;
  const std::vector<char> left = nodes_in_stage(problem.mesh, there);
  const auto takes_part = [&](int node) { return left[static_cast<std::size_t>(node)] != 0; };
  for (const auto& contribution : problem.contributions) {
    const bool holds = contribution->life.holds(stage) || !contribution->tied_nodes(stage).empty();
    if (!holds) continue;
    for (const auto& pair : contribution->joined_nodes())
      if (takes_part(pair.first) && takes_part(pair.second)) all.push_back(pair);
  }
  return all;
}

template std::vector<std::pair<int, int>> joined_nodes<2>(const Problem<2>&, int);
template std::vector<std::pair<int, int>> joined_nodes<3>(const Problem<3>&, int);
template std::vector<char> elements_in_stage<2>(const Problem<2>&, int);
template std::vector<char> elements_in_stage<3>(const Problem<3>&, int);
template std::vector<char> nodes_in_stage<2>(const Mesh<2>&, const std::vector<char>&);
template std::vector<char> nodes_in_stage<3>(const Mesh<3>&, const std::vector<char>&);
template std::vector<char> nodes_of_elements<2>(const Mesh<2>&, const std::vector<char>&);
template std::vector<char> nodes_of_elements<3>(const Mesh<3>&, const std::vector<char>&);
template std::vector<BoundarySide> covered_sides<2>(const Mesh<2>&, std::vector<BoundarySide>,
                                                    const std::vector<char>&);
template std::vector<BoundarySide> covered_sides<3>(const Mesh<3>&, std::vector<BoundarySide>,
                                                    const std::vector<char>&);
template std::vector<BoundarySide> sides_in_stage<2>(const Problem<2>&, const BoundaryLoad<2>&, int);
template std::vector<BoundarySide> sides_in_stage<3>(const Problem<3>&, const BoundaryLoad<3>&, int);

}  // namespace polargrain::fem
