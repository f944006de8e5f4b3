// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/solver/free_rotations.hpp"

#include "fem/element/dofs.hpp"

#include <fmt/format.h>

#include <numeric>
#include <vector>

namespace polargrain::fem {
namespace {

/// Stiffnesses below this share of the largest count as zero.
constexpr double kNothing = 1e-14;

bool has_skew_stiffness(const Matrix7& d) {
  const double skew = d(k21, k21) + d(k12, k12) - d(k21, k12) - d(k12, k21);
  return std::abs(skew) > kNothing * d.topLeftCorner<5, 5>().cwiseAbs().maxCoeff();
}

bool has_couple_stiffness(const Matrix7& d, double element_area) {
  const double couple = d.bottomRightCorner<2, 2>().cwiseAbs().maxCoeff();
  return couple > kNothing * element_area * d.topLeftCorner<5, 5>().cwiseAbs().maxCoeff();
}

}  // namespace

std::string unresisted_rotation(const Mesh& mesh, const Discretisation& discretisation,
                                const Constraints& constraints, std::span<const Response> responses) {
  std::vector<std::size_t> root(mesh.nodes.size());
  std::iota(root.begin(), root.end(), std::size_t{0});
  const auto find = [&](std::size_t node) {
    while (root[node] != node) node = root[node] = root[root[node]];
    return node;
  };
  std::vector<char> stiff(mesh.nodes.size(), 0);
  std::vector<char> used(mesh.nodes.size(), 0);
  for (std::size_t e = 0; e < discretisation.elements(); ++e) {
    bool skew = false;
    bool couple = false;
    for (std::size_t i = discretisation.first_point(e); i < discretisation.first_point(e + 1); ++i) {
      skew = skew || has_skew_stiffness(responses[i].tangent);
      couple = couple || has_couple_stiffness(responses[i].tangent, discretisation.point(i).volume);
    }
    const auto first = static_cast<std::size_t>(mesh.elements[e].nodes.front());
    for (const int number : mesh.elements[e].nodes) {
      const auto node = static_cast<std::size_t>(number);
      used[node] = 1;
      if (skew) stiff[node] = 1;
      if (couple) root[find(node)] = find(first);
    }
  }
  // Nodes whose micro-rotation is one unknown.
  std::vector<int> node_of(static_cast<std::size_t>(constraints.unknowns()), -1);
  for (std::size_t node = 0; node < mesh.nodes.size(); ++node) {
    const int equation = constraints.equation(entry_of(node, Dof::w));
    if (equation < 0) continue;
    int& first = node_of[static_cast<std::size_t>(equation)];
    if (first < 0) first = static_cast<int>(node);
    root[find(node)] = find(static_cast<std::size_t>(first));
  }
  std::vector<char> held(mesh.nodes.size(), 0);
  for (std::size_t node = 0; node < mesh.nodes.size(); ++node) {
    if (stiff[node] != 0 || !constraints.is_free(entry_of(node, Dof::w))) held[find(node)] = 1;
  }
  std::size_t free = 0;
  const Eigen::Vector2d* where = nullptr;
  for (std::size_t node = 0; node < mesh.nodes.size(); ++node) {
    if (used[node] == 0 || held[find(node)] != 0) continue;
    ++free;
    if (where == nullptr) where = &mesh.nodes[node];
  }
  if (free == 0) return {};
  return fmt::format(
      "nothing resists the micro-rotation of {} nodes, one at ({:.6g}, {:.6g}): give the material a Cosserat "
      "shear modulus Gc above zero, fix w there, or use the Cauchy continuum",
      free, (*where)(0), (*where)(1));
}

}  // namespace polargrain::fem
