// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/solver/coarse_space.hpp"

#include <array>
#include <optional>

#include "fem/element/dofs.hpp"

namespace polargrain::fem {
namespace {

/// The ends of the edge in whose middle each node lies; nothing for corners.
template <int dim>
std::vector<std::optional<std::array<int, 2>>> edge_ends(const Mesh<dim>& mesh) {
  std::vector<std::optional<std::array<int, 2>>> ends(mesh.nodes.size());
  for (const Element<dim>& element : mesh.elements)
    for (const ElementSide<dim>& side : element.type->sides) {
      const auto corners = static_cast<std::size_t>(side.type->corners);
      // Middle nodes of a face stand behind its corners, each after the corner where its edge begins.
      for (std::size_t k = 0; corners + k < side.nodes.size(); ++k) {
        const auto node = [&](std::size_t local) {
          return element.nodes[static_cast<std::size_t>(side.nodes[local])];
        };
        ends[static_cast<std::size_t>(node(corners + k))] = {node(k), node((k + 1) % corners)};
      }
    }
  return ends;
}

}  // namespace

template <int dim>
CoarseSpace coarse_space(const Mesh<dim>& mesh, const Constraints<dim>& constraints) {
  CoarseSpace made;
  if constexpr (dim == 3) {
    constexpr auto kDofs = static_cast<std::size_t>(Cosserat<dim>::dofs);
    const auto ends = edge_ends<dim>(mesh);
    // Unknowns are numbered in the order in which nodes have them first; ties share them with later nodes.
    std::vector<std::size_t> first_entry;
    std::vector<bool> is_corner;
    for (std::size_t node = 0; node < mesh.nodes.size(); ++node) {
      const std::size_t before = first_entry.size();
      for (std::size_t i = 0; i < kDofs; ++i) {
        const std::size_t entry = entry_of<dim>(node) + i;
        if (!constraints.is_free(entry)) continue;
        const auto number = static_cast<std::size_t>(constraints.equation(entry));
        if (number == first_entry.size()) {
          first_entry.push_back(entry);
          is_corner.push_back(false);
        }
        if (!ends[node]) is_corner[number] = true;
      }
      if (first_entry.size() > before) made.node_begins.push_back(static_cast<int>(before));
    }
    made.node_begins.push_back(constraints.unknowns());
    std::vector<int> column(first_entry.size(), -1);
    int columns = 0;
    for (std::size_t number = 0; number < column.size(); ++number)
      if (is_corner[number]) column[number] = columns++;
    if (2 * columns > constraints.unknowns()) return made;
    std::vector<Eigen::Triplet<double>> entries;
    for (std::size_t number = 0; number < column.size(); ++number) {
      const int row = static_cast<int>(number);
      if (is_corner[number]) {
        entries.emplace_back(row, column[number], 1.0);
        continue;
      }
      const std::size_t node = first_entry[number] / kDofs;
      const std::size_t component = first_entry[number] % kDofs;
      for (const int end : *ends[node]) {
        const std::size_t entry = entry_of<dim>(static_cast<std::size_t>(end)) + component;
        if (!constraints.is_free(entry)) continue;
        entries.emplace_back(row, column[static_cast<std::size_t>(constraints.equation(entry))], 0.5);
      }
    }
    made.prolongation.resize(constraints.unknowns(), columns);
    made.prolongation.setFromTriplets(entries.begin(), entries.end());
  }
  return made;
}

template CoarseSpace coarse_space<2>(const Mesh<2>& mesh, const Constraints<2>& constraints);
template CoarseSpace coarse_space<3>(const Mesh<3>& mesh, const Constraints<3>& constraints);

}  // namespace polargrain::fem
