// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/mesh/split.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "common/error.hpp"

namespace polargrain::fem {
namespace {

/// A face by its nodes, whichever side sees it.
std::vector<int> key_of(std::vector<int> nodes) {
  std::ranges::sort(nodes);
  return nodes;
}

template <int dim>
using SidesOfFaces = std::map<std::vector<int>, std::vector<BoundarySide>>;

template <int dim>
SidesOfFaces<dim> sides_of_faces(const Mesh<dim>& mesh) {
  SidesOfFaces<dim> sides;
  for (int e = 0; e < static_cast<int>(mesh.elements.size()); ++e) {
    const auto& type = *mesh.elements[static_cast<std::size_t>(e)].type;
    for (int side = 0; side < static_cast<int>(type.sides.size()); ++side)
      sides[key_of(mesh.side_nodes({e, side}))].push_back({e, side});
  }
  return sides;
}

template <int dim>
std::vector<std::vector<int>> keys_along(const Mesh<dim>& mesh, const std::string& name,
                                         const SidesOfFaces<dim>& sides) {
  std::vector<std::vector<int>> keys;
  if (const auto boundary = mesh.boundaries.find(name); boundary != mesh.boundaries.end()) {
    for (const BoundarySide& side : boundary->second) keys.push_back(key_of(mesh.side_nodes(side)));
    return keys;
  }
  const std::vector<int> nodes = mesh.nodes_on(name);  // ascending
  for (const auto& [key, of_face] : sides)
    if (std::ranges::includes(nodes, key)) keys.push_back(key);
  if (keys.empty())
    throw RunError(fmt::format(
        "the nodes of '{}' make up no whole {} of an element; name a boundary, or a level between "
        "two rows of elements",
        name, dim == 2 ? "side" : "face"));
  return keys;
}

template <int dim>
TwoSidedFace<dim> face_of(const Mesh<dim>& mesh, const std::vector<BoundarySide>& sides) {
  TwoSidedFace<dim> face{
      mesh.side_of(sides.front()).type, sides.front(), {}, mesh.side_nodes(sides.front()), {}};
  if (sides.size() > 1) {
    face.second = sides.back();
    face.second_nodes = face.first_nodes;  // one mesh as yet
  }
  return face;
}

/// The corners of a face with the sense in which it goes through each of its edges: in the plane an edge is a node.
template <int dim>
std::vector<std::pair<std::vector<int>, bool>> edges_of(const TwoSidedFace<dim>& face) {
  const auto corners = static_cast<std::size_t>(face.type->corners);
  if constexpr (dim == 2) {
    return {{{face.first_nodes[0]}, false}, {{face.first_nodes[1]}, true}};
  } else {
    std::vector<std::pair<std::vector<int>, bool>> edges;
    for (std::size_t k = 0; k < corners; ++k) {
      const int a = face.first_nodes[k];
      const int b = face.first_nodes[(k + 1) % corners];
      edges.push_back({{std::min(a, b), std::max(a, b)}, a < b});
    }
    return edges;
  }
}

/// Turns faces so that neighbours go through the edge that they share in opposite senses. Faces with ground on one side alone
/// cannot be turned: they decide for those that hang on them.
template <int dim>
void orient(const Mesh<dim>& mesh, const std::string& name, std::vector<TwoSidedFace<dim>>& faces) {
  std::map<std::vector<int>, std::vector<std::size_t>> at_edge;
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (const auto& [edge, sense] : edges_of(faces[f])) at_edge[edge].push_back(f);
  const auto sense_at = [&](std::size_t f, const std::vector<int>& edge) {
    for (const auto& [other, sense] : edges_of(faces[f]))
      if (other == edge) return sense;
    return false;
  };
  std::vector<char> done(faces.size(), 0);
  const auto turn_all_from = [&](std::size_t seed) {
    if (done[seed] != 0) return;
    done[seed] = 1;
    std::vector<std::size_t> front{seed};
    while (!front.empty()) {
      const std::size_t f = front.back();
      front.pop_back();
      for (const auto& [edge, sense] : edges_of(faces[f])) {
        const std::vector<std::size_t>& here = at_edge[edge];
        if (here.size() != 2) continue;
        const std::size_t other = here[0] == f ? here[1] : here[0];
        if (done[other] != 0) continue;
        done[other] = 1;
        if (sense_at(other, edge) == sense) {
          if (!faces[other].second)
            throw RunError(fmt::format(
                "parts of '{}' have ground on one side alone, and not all on the same side: it changes at {}; "
                "give the parts names of their own",
                name, place_text<dim>(mesh.nodes[static_cast<std::size_t>(edge.front())])));
          faces[other] = faces[other].seen_from_second(mesh);
        }
        front.push_back(other);
      }
    }
  };
  for (std::size_t seed = 0; seed < faces.size(); ++seed)
    if (!faces[seed].second) turn_all_from(seed);
  for (std::size_t seed = 0; seed < faces.size(); ++seed) turn_all_from(seed);
}

/// Puts faces of the plane behind each other, chain by chain.
void order_along(std::vector<TwoSidedFace<2>>& faces) {
  std::map<int, std::vector<std::size_t>> starting_at;
  std::set<int> ends;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    starting_at[faces[f].first_nodes[0]].push_back(f);
    ends.insert(faces[f].first_nodes[1]);
  }
  std::vector<TwoSidedFace<2>> ordered;
  std::vector<char> done(faces.size(), 0);
  const auto follow = [&](std::size_t f) {
    while (done[f] == 0) {
      done[f] = 1;
      ordered.push_back(faces[f]);
      for (const std::size_t next : starting_at[faces[f].first_nodes[1]]) {
        if (done[next] != 0) continue;
        f = next;
        break;
      }
    }
  };
  for (std::size_t f = 0; f < faces.size(); ++f)
    if (!ends.contains(faces[f].first_nodes[0])) follow(f);
  for (std::size_t f = 0; f < faces.size(); ++f) follow(f);  // closed curves
  faces = std::move(ordered);
}

/// Groups of elements around a node that faces without a cut join.
template <int dim>
std::vector<std::vector<int>> sectors(const Mesh<dim>& mesh, int node, const std::vector<int>& elements,
                                      const std::set<std::vector<int>>& cut) {
  std::map<std::vector<int>, int> seen;  // face: number of the first element here that has it
  std::vector<std::size_t> root(elements.size());
  std::iota(root.begin(), root.end(), std::size_t{0});
  const auto find = [&](std::size_t i) {
    while (root[i] != i) i = root[i];
    return i;
  };
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const auto& type = *mesh.elements[static_cast<std::size_t>(elements[i])].type;
    for (int side = 0; side < static_cast<int>(type.sides.size()); ++side) {
      const std::vector<int> nodes = mesh.side_nodes({elements[i], side});
      if (std::ranges::find(nodes, node) == nodes.end()) continue;
      const std::vector<int> key = key_of(nodes);
      if (cut.contains(key)) continue;
      const auto [place, added] = seen.try_emplace(key, static_cast<int>(i));
      if (added) continue;
      const std::size_t a = find(i);
      const std::size_t b = find(static_cast<std::size_t>(place->second));
      root[std::max(a, b)] = std::min(a, b);
    }
  }
  std::map<std::size_t, std::vector<int>> groups;
  for (std::size_t i = 0; i < elements.size(); ++i) groups[find(i)].push_back(elements[i]);
  std::vector<std::vector<int>> found;
  for (auto& [first, group] : groups) found.push_back(std::move(group));
  return found;
}

}  // namespace

template <int dim>
TwoSidedFace<dim> TwoSidedFace<dim>::seen_from_second(const Mesh<dim>& mesh) const {
  TwoSidedFace<dim> turned{mesh.side_of(*second).type, *second, first, mesh.side_nodes(*second), {}};
  for (const int node : turned.first_nodes) {
    const auto place = std::ranges::find(second_nodes, node) - second_nodes.begin();
    turned.second_nodes.push_back(first_nodes[static_cast<std::size_t>(place)]);
  }
  return turned;
}

template <int dim>
std::vector<TwoSidedFace<dim>> faces_along(const Mesh<dim>& mesh, const std::string& name) {
  const SidesOfFaces<dim> sides = sides_of_faces(mesh);
  std::vector<TwoSidedFace<dim>> faces;
  for (const std::vector<int>& key : keys_along(mesh, name, sides))
    faces.push_back(face_of(mesh, sides.at(key)));
  orient(mesh, name, faces);
  if constexpr (dim == 2) order_along(faces);
  return faces;
}

template <int dim>
void split_along(Mesh<dim>& mesh, std::vector<std::vector<TwoSidedFace<dim>>>& curves) {
  std::set<std::vector<int>> cut;
  std::set<int> nodes;
  // Places of the second side's nodes in its element's side, to find them again.
  std::vector<std::vector<std::vector<std::size_t>>> order_of_second;
  for (const std::vector<TwoSidedFace<dim>>& faces : curves) {
    auto& orders = order_of_second.emplace_back();
    for (const TwoSidedFace<dim>& face : faces) {
      std::vector<std::size_t>& order = orders.emplace_back();
      if (!face.second) continue;
      cut.insert(key_of(face.first_nodes));
      nodes.insert(face.first_nodes.begin(), face.first_nodes.end());
      const std::vector<int> second = mesh.side_nodes(*face.second);
      for (const int node : face.second_nodes)
        order.push_back(static_cast<std::size_t>(std::ranges::find(second, node) - second.begin()));
    }
  }
  std::map<int, std::vector<int>> elements_at;
  for (int e = 0; e < static_cast<int>(mesh.elements.size()); ++e)
    for (const int node : mesh.elements[static_cast<std::size_t>(e)].nodes)
      if (nodes.contains(node)) elements_at[node].push_back(e);
  // All sectors first: copies change the nodes by which faces are known.
  std::map<int, std::vector<std::vector<int>>> sectors_at;
  for (const auto& [node, elements] : elements_at) sectors_at[node] = sectors(mesh, node, elements, cut);
  std::map<int, std::vector<int>> copies;
  for (const auto& [node, groups] : sectors_at) {
    for (std::size_t g = 1; g < groups.size(); ++g) {
      const int copy = static_cast<int>(mesh.nodes.size());
      mesh.nodes.push_back(mesh.nodes[static_cast<std::size_t>(node)]);
      copies[node].push_back(copy);
      for (const int e : groups[g])
        std::ranges::replace(mesh.elements[static_cast<std::size_t>(e)].nodes, node, copy);
    }
  }
  for (auto& [name, set] : mesh.node_sets) {
    std::vector<int> added;
    for (const int node : set)
      if (const auto of_node = copies.find(node); of_node != copies.end())
        added.insert(added.end(), of_node->second.begin(), of_node->second.end());
    set.insert(set.end(), added.begin(), added.end());
  }
  for (std::size_t c = 0; c < curves.size(); ++c) {
    for (std::size_t f = 0; f < curves[c].size(); ++f) {
      TwoSidedFace<dim>& face = curves[c][f];
      face.first_nodes = mesh.side_nodes(face.first);
      if (!face.second) continue;
      const std::vector<int> second = mesh.side_nodes(*face.second);
      for (std::size_t i = 0; i < second.size(); ++i) face.second_nodes[i] = second[order_of_second[c][f][i]];
    }
  }
}

template <int dim>
OwnNodes<dim> add_own_nodes(Mesh<dim>& mesh, const std::vector<TwoSidedFace<dim>>& originals) {
  std::map<int, int> own_of;
  return add_own_nodes(mesh, originals, own_of);
}

template <int dim>
OwnNodes<dim> add_own_nodes(Mesh<dim>& mesh, const std::vector<TwoSidedFace<dim>>& originals,
                            std::map<int, int>& own_of) {
  OwnNodes<dim> own;
  std::set<int> listed;
  for (const TwoSidedFace<dim>& face : originals) {
    std::vector<int>& nodes = own.face_nodes.emplace_back();
    for (const int node : face.first_nodes) {
      const auto [place, added] = own_of.try_emplace(node, static_cast<int>(mesh.nodes.size()));
      if (added) mesh.nodes.push_back(mesh.nodes[static_cast<std::size_t>(node)]);
      if (listed.insert(place->second).second) own.nodes.push_back(place->second);
      nodes.push_back(place->second);
    }
  }
  return own;
}

template struct TwoSidedFace<2>;
template struct TwoSidedFace<3>;
template std::vector<TwoSidedFace<2>> faces_along<2>(const Mesh<2>&, const std::string&);
template std::vector<TwoSidedFace<3>> faces_along<3>(const Mesh<3>&, const std::string&);
template void split_along<2>(Mesh<2>&, std::vector<std::vector<TwoSidedFace<2>>>&);
template void split_along<3>(Mesh<3>&, std::vector<std::vector<TwoSidedFace<3>>>&);
template OwnNodes<2> add_own_nodes<2>(Mesh<2>&, const std::vector<TwoSidedFace<2>>&);
template OwnNodes<2> add_own_nodes<2>(Mesh<2>&, const std::vector<TwoSidedFace<2>>&, std::map<int, int>&);
template OwnNodes<3> add_own_nodes<3>(Mesh<3>&, const std::vector<TwoSidedFace<3>>&);
template OwnNodes<3> add_own_nodes<3>(Mesh<3>&, const std::vector<TwoSidedFace<3>>&, std::map<int, int>&);

}  // namespace polargrain::fem
