// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/solver/ties.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace polargrain::fem {
namespace {

template <int dim>
typename Cosserat<dim>::Place centroid(const Mesh<dim>& mesh, const std::vector<int>& nodes) {
  typename Cosserat<dim>::Place sum = Cosserat<dim>::Place::Zero();
  for (const int node : nodes) sum += mesh.nodes[static_cast<std::size_t>(node)];
  return sum / static_cast<double>(nodes.size());
}

TiedNodes fault(std::string message) {
  TiedNodes none;
  none.fault = std::move(message);
  return none;
}

}  // namespace

template <int dim>
TiedNodes tied_nodes(const Mesh<dim>& mesh, const Tie& tie) {
  for (const std::string& name : {tie.on, tie.to}) {
    if (mesh.has_nodes_on(name)) continue;
    return fault(fmt::format("the mesh has no boundary or node set '{}'; it has {}", name,
                             fmt::join(mesh.boundary_and_node_set_names(), ", ")));
  }
  const std::vector<int> followers = mesh.nodes_on(tie.on);
  std::vector<int> leaders = mesh.nodes_on(tie.to);
  if (followers.size() != leaders.size()) {
    return fault(fmt::format("'{}' has {} nodes and '{}' has {}: a tie needs the same nodes on both sides",
                             tie.on, followers.size(), tie.to, leaders.size()));
  }
  const typename Cosserat<dim>::Place apart = centroid(mesh, leaders) - centroid(mesh, followers);
  constexpr double kMatch = 1e-6;
  if (!(apart.norm() > 0.0)) {
    return fault(fmt::format("'{}' and '{}' lie on each other: a tie joins opposite sides", tie.on, tie.to));
  }
  TiedNodes tied;
  for (const int node : followers) {
    const typename Cosserat<dim>::Place place = mesh.nodes[static_cast<std::size_t>(node)] + apart;
    const auto distance = [&](int other) {
      return (mesh.nodes[static_cast<std::size_t>(other)] - place).norm();
    };
    const auto nearest = std::min_element(leaders.begin(), leaders.end(),
                                          [&](int a, int b) { return distance(a) < distance(b); });
    if (distance(*nearest) > kMatch * apart.norm()) {
      return fault(fmt::format(
          "'{}' has no node at {}, where '{}' moved by {} has one: a tie needs the same nodes on both sides",
          tie.to, place_text<dim>(place), tie.on, place_text<dim>(apart)));
    }
    tied.pairs.emplace_back(node, *nearest);
    leaders.erase(nearest);  // each once
    if (leaders.empty()) break;
  }
  return tied;
}

template TiedNodes tied_nodes<2>(const Mesh<2>& mesh, const Tie& tie);
template TiedNodes tied_nodes<3>(const Mesh<3>& mesh, const Tie& tie);

}  // namespace polargrain::fem
