// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/solver/coarse_space.hpp"

#include <array>
#include <optional>

#include "fem/element/dofs.hpp"

namespace polargrain::fem {
namespace {

/// Where an unknown has its node, and which of the node's unknowns it is; ties share it with later nodes.
struct FirstPlace {
  std::size_t node;
  std::size_t component;
  bool is_corner;  ///< of the node, or of one that is tied to it
};

/// The ends of the edge in whose middle each node lies; nothing for corners.
std::vector<std::optional<std::array<int, 2>>> edge_ends(const Mesh<3>& mesh) {
  std::vector<std::optional<std::array<int, 2>>> ends(mesh.nodes.size());
  for (const Element<3>& element : mesh.elements)
    for (const ElementSide<3>& side : element.type->sides) {
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

/// Value at a node of the rigid motion `motion` (translations first, then turns of 1 about the axes), in one unknown.
double rigid_motion(int motion, const Eigen::Vector3d& place, std::size_t component) {
  const Eigen::Vector3d axis = Eigen::Vector3d::Unit(motion % 3);
  const auto along = static_cast<Eigen::Index>(component % 3);
  if (motion < 3) return component < 3 ? axis(along) : 0.0;
  return component < 3 ? axis.cross(place)(along) : axis(along);
}

UnknownGroups groups_of(const std::vector<FirstPlace>& places, const Mesh<3>& mesh) {
  UnknownGroups made;
  made.motions.resize(static_cast<Eigen::Index>(places.size()), 6);
  for (std::size_t number = 0; number < places.size(); ++number) {
    const FirstPlace& place = places[number];
    if (number == 0 || place.node != places[number - 1].node) made.begins.push_back(static_cast<int>(number));
    for (int motion = 0; motion < 6; ++motion)
      made.motions(static_cast<Eigen::Index>(number), motion) =
          rigid_motion(motion, mesh.nodes[place.node], place.component);
  }
  made.begins.push_back(static_cast<int>(places.size()));
  return made;
}

}  // namespace

template <>
CoarseSpace coarse_space<2>(const Mesh<2>& /*mesh*/, const Constraints<2>& /*constraints*/) {
  return {};
}

template <>
CoarseSpace coarse_space<3>(const Mesh<3>& mesh, const Constraints<3>& constraints) {
  constexpr auto kDofs = static_cast<std::size_t>(Cosserat<3>::dofs);
  const auto ends = edge_ends(mesh);
  std::vector<FirstPlace> places;
  for (std::size_t node = 0; node < mesh.nodes.size(); ++node)
    for (std::size_t i = 0; i < kDofs; ++i) {
      const std::size_t entry = entry_of<3>(node) + i;
      if (!constraints.is_free(entry)) continue;
      const auto number = static_cast<std::size_t>(constraints.equation(entry));
      if (number > places.size()) return {};  // not numbered by nodes
      if (number == places.size()) places.push_back({node, i, false});
      if (!ends[node]) places[number].is_corner = true;
    }
  if (static_cast<int>(places.size()) != constraints.unknowns() || places.empty()) return {};
  CoarseSpace made;
  made.groups = groups_of(places, mesh);

  std::vector<FirstPlace> corners;
  std::vector<int> column(places.size(), -1);
  for (std::size_t number = 0; number < places.size(); ++number) {
    if (!places[number].is_corner) continue;
    column[number] = static_cast<int>(corners.size());
    corners.push_back(places[number]);
  }
  if (2 * corners.size() > places.size() || corners.empty()) return made;
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t number = 0; number < places.size(); ++number) {
    const int row = static_cast<int>(number);
    if (places[number].is_corner) {
      entries.emplace_back(row, column[number], 1.0);
      continue;
    }
    for (const int end : *ends[places[number].node]) {
      const std::size_t entry = entry_of<3>(static_cast<std::size_t>(end)) + places[number].component;
      if (!constraints.is_free(entry)) continue;
      entries.emplace_back(row, column[static_cast<std::size_t>(constraints.equation(entry))], 0.5);
    }
  }
  made.from_corners.resize(constraints.unknowns(), static_cast<Eigen::Index>(corners.size()));
  made.from_corners.setFromTriplets(entries.begin(), entries.end());
  made.corners = groups_of(corners, mesh);
  return made;
}

}  // namespace polargrain::fem
