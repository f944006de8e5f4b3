// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <Eigen/SVD>
#include <cmath>
#include <numeric>

#include "fem/solver/problem.hpp"

namespace polargrain::fem {
namespace {

using Pairs = std::vector<std::pair<int, int>>;

/// Number of the part of the body that each node belongs to; parts share no node and no tie. Nodes of no element are
/// -1.
std::vector<int> parts_of_nodes(const Mesh& mesh, const Pairs& tied, int& parts) {
  std::vector<int> root(mesh.nodes.size());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](int node) {
    while (root[static_cast<std::size_t>(node)] != node) {
      int& up = root[static_cast<std::size_t>(node)];
      node = up = root[static_cast<std::size_t>(up)];
    }
    return node;
  };
  std::vector<char> used(mesh.nodes.size(), 0);
  for (const Element& element : mesh.elements) {
    for (const int node : element.nodes) {
      root[static_cast<std::size_t>(find(node))] = find(element.nodes.front());
      used[static_cast<std::size_t>(node)] = 1;
    }
  }
  for (const auto& [follower, leader] : tied) root[static_cast<std::size_t>(find(follower))] = find(leader);
  std::vector<int> part(mesh.nodes.size(), -1);
  std::vector<int> number(mesh.nodes.size(), -1);
  parts = 0;
  for (std::size_t node = 0; node < mesh.nodes.size(); ++node) {
    if (!used[node]) continue;
    int& of_root = number[static_cast<std::size_t>(find(static_cast<int>(node)))];
    if (of_root < 0) of_root = parts++;
    part[node] = of_root;
  }
  return part;
}

/// A motion in words. @param motion translations along 1 and 2 and rotation about `centre` times `length`.
std::string describe(const Eigen::Vector3d& motion, const Eigen::Vector2d& centre, double length) {
  constexpr double kSmall = 1e-8;
  const double rotation = motion(2) / length;
  if (std::abs(motion(2)) < kSmall) {
    if (std::abs(motion(1)) < kSmall) return "translation along 1";
    if (std::abs(motion(0)) < kSmall) return "translation along 2";
    return fmt::format("translation along ({:.3g}, {:.3g})", motion(0), motion(1));
  }
  // Rounding must not show as 1e-18.
  const auto rounded = [&](double x) { return std::abs(x) < kSmall * length ? 0.0 : x; };
  return fmt::format("rotation about ({:.6g}, {:.6g})", rounded(centre(0) - motion(1) / rotation),
                     rounded(centre(1) + motion(0) / rotation));
}

/// Free motions of one part, given what the supports forbid (a row a given dof, in the scaled motions).
std::vector<std::string> free_motions(const Eigen::Matrix3d& normal_matrix, const Eigen::Vector2d& centre,
                                      double length) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(normal_matrix, Eigen::ComputeFullV);
  const Eigen::Vector3d values = svd.singularValues();
  // Squared small numbers: a support that holds a motion by less than 1e-5 of its best does not hold it.
  const double threshold = 1e-10 * values(0);
  int free = 0;
  for (int i = 0; i < 3; ++i) free += values(i) <= threshold ? 1 : 0;
  if (free == 3) return {"translation along 1", "translation along 2", "rotation"};
  std::vector<std::string> motions;
  if (free == 2) {
    // A basis with as little rotation as possible reads better: one pure translation, one that rotates.
    Eigen::Vector3d a = svd.matrixV().col(1);
    Eigen::Vector3d b = svd.matrixV().col(2);
    if (std::abs(a(2)) > std::abs(b(2))) a.swap(b);
    if (std::abs(b(2)) > 0.0) a -= a(2) / b(2) * b;
    b -= b.dot(a) / a.squaredNorm() * a;
    return {describe(a.normalized(), centre, length), describe(b.normalized(), centre, length)};
  }
  if (free == 1) motions.push_back(describe(svd.matrixV().col(2), centre, length));
  return motions;
}

}  // namespace

std::vector<std::string> free_rigid_motions(const Mesh& mesh, Continuum continuum,
                                            const std::vector<PrescribedDof>& prescribed,
                                            const std::vector<Tie>& ties) {
  Pairs tied;
  for (const Tie& tie : ties) {
    const Pairs pairs = tied_nodes(mesh, tie).pairs;
    tied.insert(tied.end(), pairs.begin(), pairs.end());
  }
  int parts = 0;
  const std::vector<int> part_of = parts_of_nodes(mesh, tied, parts);
  std::vector<std::string> messages;
  for (int part = 0; part < parts; ++part) {
    Eigen::Vector2d low = Eigen::Vector2d::Constant(HUGE_VAL);
    Eigen::Vector2d high = -low;
    for (std::size_t node = 0; node < mesh.nodes.size(); ++node) {
      if (part_of[node] != part) continue;
      low = low.cwiseMin(mesh.nodes[node]);
      high = high.cwiseMax(mesh.nodes[node]);
    }
    const Eigen::Vector2d centre = 0.5 * (low + high);
    const double length = 0.5 * (high - low).norm();
    Eigen::Matrix3d normal_matrix = Eigen::Matrix3d::Zero();
    for (const PrescribedDof& item : prescribed) {
      if (item.dof == Dof::w && continuum == Continuum::cauchy) continue;
      if (!mesh.has_nodes_on(item.on)) continue;
      for (const int node : mesh.nodes_on(item.on)) {
        if (part_of[static_cast<std::size_t>(node)] != part) continue;
        const Eigen::Vector2d arm = (mesh.nodes[static_cast<std::size_t>(node)] - centre) / length;
        Eigen::Vector3d row(0.0, 0.0, 1.0);
        if (item.dof == Dof::u1) row = {1.0, 0.0, -arm(1)};
        if (item.dof == Dof::u2) row = {0.0, 1.0, arm(0)};
        normal_matrix += row * row.transpose();
      }
    }
    // Nodes that move alike cannot turn about each other.
    for (const auto& [follower, leader] : tied) {
      if (part_of[static_cast<std::size_t>(follower)] != part) continue;
      const Eigen::Vector2d arm =
          (mesh.nodes[static_cast<std::size_t>(leader)] - mesh.nodes[static_cast<std::size_t>(follower)]) /
          length;
      normal_matrix(2, 2) += arm.squaredNorm();
    }
    for (std::string& motion : free_motions(normal_matrix, centre, length)) {
      if (parts > 1) motion += fmt::format(" of the part around ({:.6g}, {:.6g})", centre(0), centre(1));
      messages.push_back(std::move(motion));
    }
  }
  return messages;
}

}  // namespace polargrain::fem
