// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/mesh/cut.hpp"

namespace polargrain::fem {

template <int dim>
Mesh<dim> cut(const Mesh<dim>& mesh, const std::vector<char>& removed) {
  Mesh<dim> rest;
  std::vector<int> element_number(mesh.elements.size(), -1);
  std::vector<int> node_number(mesh.nodes.size(), -1);
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    if (removed[e] != 0) continue;
    element_number[e] = static_cast<int>(rest.elements.size());
    rest.elements.push_back(mesh.elements[e]);
    for (const int node : mesh.elements[e].nodes) node_number[static_cast<std::size_t>(node)] = 0;
  }
  for (std::size_t node = 0; node < mesh.nodes.size(); ++node) {
    if (node_number[node] < 0) continue;
    node_number[node] = static_cast<int>(rest.nodes.size());
    rest.nodes.push_back(mesh.nodes[node]);
  }
  for (Element<dim>& element : rest.elements)
    for (int& node : element.nodes) node = node_number[static_cast<std::size_t>(node)];
  for (const auto& [name, sides] : mesh.boundaries) {
    std::vector<BoundarySide>& kept = rest.boundaries[name];
    for (const BoundarySide& side : sides)
      if (const int e = element_number[static_cast<std::size_t>(side.element)]; e >= 0)
        kept.push_back({e, side.side});
  }
  const auto keep = [](const std::vector<int>& numbers, const std::vector<int>& new_number) {
    std::vector<int> kept;
    for (const int number : numbers)
      if (const int now = new_number[static_cast<std::size_t>(number)]; now >= 0) kept.push_back(now);
    return kept;
  };
  for (const auto& [name, elements] : mesh.regions) rest.regions[name] = keep(elements, element_number);
  for (const auto& [name, nodes] : mesh.node_sets)
    if (std::vector<int> kept = keep(nodes, node_number); !kept.empty())
      rest.node_sets[name] = std::move(kept);
  std::erase_if(rest.boundaries, [](const auto& boundary) { return boundary.second.empty(); });
  std::erase_if(rest.regions, [](const auto& region) { return region.second.empty(); });
  return rest;
}

template Mesh<2> cut<2>(const Mesh<2>& mesh, const std::vector<char>& removed);
template Mesh<3> cut<3>(const Mesh<3>& mesh, const std::vector<char>& removed);

}  // namespace polargrain::fem
