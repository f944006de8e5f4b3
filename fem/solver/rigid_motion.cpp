// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/symmetric_modes.hpp"
#include "fem/solver/problem.hpp"

namespace polargrain::fem {
namespace {

using Pairs = std::vector<std::pair<int, int>>;

/// Number of the part of the body that each node belongs to; parts share no node, no tie and no joined pair. Nodes of neither
/// are -1.
template <int dim>
std::vector<int> parts_of_nodes(const Mesh<dim>& mesh, const Pairs& tied, const Pairs& joined,
                                const std::vector<char>& there, int& parts) {
  std::vector<int> root(mesh.nodes.size());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](int node) {
    while (root[static_cast<std::size_t>(node)] != node) {
      int& up = root[static_cast<std::size_t>(node)];
      node = up = root[static_cast<std::size_t>(up)];
    }
    return node;
  };
  std::vector<char> used = nodes_of_elements(mesh, there);
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    if (!there.empty() && there[e] == 0) continue;
    const std::vector<int>& nodes = mesh.elements[e].nodes;
    for (const int node : nodes) root[static_cast<std::size_t>(find(node))] = find(nodes.front());
  }
  for (const auto& [follower, leader] : tied) root[static_cast<std::size_t>(find(follower))] = find(leader);
  for (const auto& [one, other] : joined) {
    root[static_cast<std::size_t>(find(one))] = find(other);
    used[static_cast<std::size_t>(one)] = used[static_cast<std::size_t>(other)] = 1;
  }
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

/// How many of the eigenvalues of what supports hold, ascending, belong to motions that are free. They are squares: a support
/// that holds a motion by less than 1e-5 of its best does not hold it.
int free_modes(const Eigen::VectorXd& values) {
  const double threshold = 1e-10 * values(values.size() - 1);
  return static_cast<int>((values.array() <= threshold).count());
}

/// Free motions of one part. @param normal_matrix of the motions that supports forbid (a row a given dof, in the scaled motions)
std::vector<std::string> free_motions(const Eigen::Matrix3d& normal_matrix, const Eigen::Vector2d& centre,
                                      double length) {
  const SymmetricModes modes = symmetric_modes(normal_matrix);
  const int free = free_modes(modes.values);
  if (free == 3) return {"translation along 1", "translation along 2", "rotation"};
  std::vector<std::string> motions;
  if (free == 2) {
    // A basis with as little rotation as possible reads better: one pure translation, one that rotates.
    Eigen::Vector3d a = modes.vectors.col(0);
    Eigen::Vector3d b = modes.vectors.col(1);
    if (std::abs(a(2)) > std::abs(b(2))) a.swap(b);
    if (std::abs(b(2)) > 0.0) a -= a(2) / b(2) * b;
    b -= b.dot(a) / a.squaredNorm() * a;
    return {describe(a.normalized(), centre, length), describe(b.normalized(), centre, length)};
  }
  if (free == 1) motions.push_back(describe(Eigen::Vector3d(modes.vectors.col(0)), centre, length));
  return motions;
}

/// "1" for the first axis, "(x, y, z)" for another direction.
std::string direction_text(const Eigen::Vector3d& direction) {
  constexpr double kSmall = 1e-8;
  Eigen::Vector3d unit = direction.normalized();
  // An axis and its opposite are one: the first component that counts is positive.
  const auto first = std::ranges::find_if(unit, [](double x) { return std::abs(x) > kSmall; });
  if (first != unit.end() && *first < 0.0) unit = -unit;
  for (int i = 0; i < 3; ++i)
    if (1.0 - std::abs(unit(i)) < kSmall) return fmt::format("{}", i + 1);
  return fmt::format("({:.3g}, {:.3g}, {:.3g})", unit(0), unit(1), unit(2));
}

/// A motion of space in words. @param motion translations, then rotations about `centre` times `length`.
std::string describe(const Eigen::Matrix<double, 6, 1>& motion, const Eigen::Vector3d& centre,
                     double length) {
  constexpr double kSmall = 1e-7;  // a translation comes from squares, to the root of rounding
  const Eigen::Vector3d shift = motion.head<3>();
  const Eigen::Vector3d spin = motion.tail<3>() / length;
  if (motion.tail<3>().norm() < kSmall) return "translation along " + direction_text(shift);
  const double pitch = shift.dot(spin) / spin.squaredNorm();
  Eigen::Vector3d on_axis = centre + spin.cross(shift) / spin.squaredNorm();
  for (double& x : on_axis) x = std::abs(x) < kSmall * length ? 0.0 : x;  // rounding must not show as 1e-18
  return fmt::format("{} about an axis along {} through ({:.6g}, {:.6g}, {:.6g})",
                     std::abs(pitch) < kSmall * length ? "rotation" : "screw motion", direction_text(spin),
                     on_axis(0), on_axis(1), on_axis(2));
}

/// Free motions of one part in space: pure translations first, then those that rotate.
std::vector<std::string> free_motions(const Eigen::Matrix<double, 6, 6>& normal_matrix,
                                      const Eigen::Vector3d& centre, double length) {
  using Motions = Eigen::Matrix<double, 6, Eigen::Dynamic>;
  const SymmetricModes modes = symmetric_modes(normal_matrix);
  const int free = free_modes(modes.values);
  std::vector<std::string> texts;
  if (free == 0) return texts;
  if (free == 6)
    return {"translation along 1", "translation along 2", "translation along 3",
            "rotation about 1",    "rotation about 2",    "rotation about 3"};
  const Motions motions = modes.vectors.leftCols(free);
  // The rotations that are free, and for each of them the motion with the least translation: first those that turn least.
  const Eigen::MatrixXd spins = motions.bottomRows<3>();
  const Motions ordered = motions * symmetric_modes(spins.transpose() * spins).vectors;
  for (int i = 0; i < free; ++i)
    texts.push_back(describe(Eigen::Matrix<double, 6, 1>(ordered.col(i)), centre, length));
  return texts;
}

/// The displacement or rotation `dof` of a body at `arm` (over the length) from its centre, a row in the scaled motions.
template <int dim>
typename Cosserat<dim>::NodeValues row_of(Dof dof, const typename Cosserat<dim>::Place& arm) {
  using Row = typename Cosserat<dim>::NodeValues;
  Row row = Row::Unit(place_of<dim>(dof));
  if (is_rotation(dof)) return row;
  const int i = axis_of(dof);
  for (int k = 0; k < Cosserat<dim>::rotations; ++k)
    for (int j = 0; j < dim; ++j) row(dim + k) += permutation(i, Cosserat<dim>::axis(k), j) * arm(j);
  return row;
}

}  // namespace

template <int dim>
std::vector<std::string> free_rigid_motions(const Mesh<dim>& mesh, Continuum continuum,
                                            const std::vector<PrescribedDof<dim>>& prescribed,
                                            const std::vector<Tie>& ties, const std::vector<char>& there,
                                            const Pairs& joined) {
  Pairs tied;
  for (const Tie& tie : ties) {
    const Pairs pairs = tied_nodes<dim>(mesh, tie).pairs;
    tied.insert(tied.end(), pairs.begin(), pairs.end());
  }
  int parts = 0;
  const std::vector<int> part_of = parts_of_nodes<dim>(mesh, tied, joined, there, parts);
  std::vector<std::string> messages;
  for (int part = 0; part < parts; ++part) {
    using Place = typename Cosserat<dim>::Place;
    using Row = typename Cosserat<dim>::NodeValues;
    Place low = Place::Constant(HUGE_VAL);
    Place high = -low;
    for (std::size_t node = 0; node < mesh.nodes.size(); ++node) {
      if (part_of[node] != part) continue;
      low = low.cwiseMin(mesh.nodes[node]);
      high = high.cwiseMax(mesh.nodes[node]);
    }
    const Place centre = 0.5 * (low + high);
    const double length = 0.5 * (high - low).norm();
    Eigen::Matrix<double, Cosserat<dim>::dofs, Cosserat<dim>::dofs> normal_matrix;
    normal_matrix.setZero();
    for (const PrescribedDof<dim>& item : prescribed) {
      if (is_rotation(item.dof) && continuum == Continuum::cauchy) continue;
      if (!mesh.has_nodes_on(item.on)) continue;
      for (const int node : mesh.nodes_on(item.on)) {
        if (part_of[static_cast<std::size_t>(node)] != part) continue;
        const Place arm = (mesh.nodes[static_cast<std::size_t>(node)] - centre) / length;
        const Row row = row_of<dim>(item.dof, arm);
        normal_matrix += row * row.transpose();
      }
    }
    // Nodes that move alike cannot turn about each other.
    for (const auto& [follower, leader] : tied) {
      if (part_of[static_cast<std::size_t>(follower)] != part) continue;
      const Place arm =
          (mesh.nodes[static_cast<std::size_t>(leader)] - mesh.nodes[static_cast<std::size_t>(follower)]) /
          length;
      for (int i = 0; i < dim; ++i) {
        Row row = row_of<dim>(static_cast<Dof>(i), arm);
        row.template head<dim>().setZero();
        normal_matrix += row * row.transpose();
      }
    }
    for (std::string& motion : free_motions(normal_matrix, centre, length)) {
      if (parts > 1) motion += " of the part around " + place_text<dim>(centre);
      messages.push_back(std::move(motion));
    }
  }
  return messages;
}

template <int dim>
std::vector<std::string> free_rigid_motions(const Problem<dim>& problem, int stage) {
  std::vector<PrescribedDof<dim>> prescribed;
  for (const PrescribedDof<dim>& item : problem.prescribed)
    if (item.life.holds(stage)) prescribed.push_back(item);
  return free_rigid_motions(problem.mesh, problem.continuum, prescribed, problem.ties,
                            elements_in_stage(problem, stage), joined_nodes(problem, stage));
}

template std::vector<std::string> free_rigid_motions<2>(const Mesh<2>& mesh, Continuum continuum,
                                                        const std::vector<PrescribedDof<2>>& prescribed,
                                                        const std::vector<Tie>& ties,
                                                        const std::vector<char>& there, const Pairs& joined);
template std::vector<std::string> free_rigid_motions<3>(const Mesh<3>& mesh, Continuum continuum,
                                                        const std::vector<PrescribedDof<3>>& prescribed,
                                                        const std::vector<Tie>& ties,
                                                        const std::vector<char>& there, const Pairs& joined);
template std::vector<std::string> free_rigid_motions<2>(const Problem<2>& problem, int stage);
template std::vector<std::string> free_rigid_motions<3>(const Problem<3>& problem, int stage);

}  // namespace polargrain::fem
