// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/solver/ties.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace polargrain::fem {
namespace {

Eigen::Vector2d centroid(const Mesh& mesh, const std::vector<int>& nodes) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const int node : nodes) sum += mesh.nodes[static_cast<std::size_t>(node)];
  return sum / static_cast<double>(nodes.size());
}

TiedNodes fault(std::string message) {
  TiedNodes none;
  none.fault = std::move(message);
  return none;
}

}  // namespace

TiedNodes tied_nodes(const Mesh& mesh, const Tie& tie) {
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
  const Eigen::Vector2d apart = centroid(mesh, leaders) - centroid(mesh, followers);
  constexpr double kMatch = 1e-6;
  if (!(apart.norm() > 0.0)) {
    return fault(fmt::format("'{}' and '{}' lie on each other: a tie joins opposite sides", tie.on, tie.to));
  }
  TiedNodes tied;
  for (const int node : followers) {
    const Eigen::Vector2d place = mesh.nodes[static_cast<std::size_t>(node)] + apart;
    const auto distance = [&](int other) {
      return (mesh.nodes[static_cast<std::size_t>(other)] - place).norm();
    };
    const auto nearest = std::min_element(leaders.begin(), leaders.end(),
                                          [&](int a, int b) { return distance(a) < distance(b); });
    if (distance(*nearest) > kMatch * apart.norm()) {
      return fault(
          fmt::format("'{}' has no node at ({:.6g}, {:.6g}), where '{}' moved by ({:.6g}, {:.6g}) has one: "
                      "a tie needs the same nodes on both sides",
                      tie.to, place(0), place(1), tie.on, apart(0), apart(1)));
    }
    tied.pairs.emplace_back(node, *nearest);
    leaders.erase(nearest);  // each once
    if (leaders.empty()) break;
  }
  return tied;
}

}  // namespace polargrain::fem
