// SPDX-License-Identifier: GPL-2.0-or-later
// Movements against the body they move.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "app/remarks/kinds.hpp"

namespace polargrain::app {
namespace {

constexpr double kLarge = 0.5;       // of the body
constexpr double kLargeSmall = 0.1;  // in small deformation
constexpr double kNoMovement = 1e-7;
constexpr double kOfATurn = 0.05;  // of the movement: the misfit that a turn may have

/// The time at the end of a step at which a movement is largest.
double time_of_largest(const Scene& scene, const fem::TimeTable& movement) {
  double time = 0.0;
  for (const coupler::StepTarget& target : scene.the_case().plan)
    if (std::abs(movement.at(target.amount)) > std::abs(movement.at(time))) time = target.amount;
  return time;
}

/// Whether all nodes whose movements are given in full, with those of this item, turn together as a rigid body does.
template <int dim>
bool turns(const Scene& scene, const fem::Problem<dim>& problem, const fem::PrescribedDof<dim>& item) {
  if (!scene.end_time() || scene.stage() > 0 || problem.deformation == fem::Deformation::small) return false;
  std::map<int, std::array<const fem::PrescribedDof<dim>*, dim>> moved;
  for (const fem::PrescribedDof<dim>& other : problem.prescribed)
    if (!fem::is_rotation(other.dof))
      for (const int node : problem.mesh.nodes_on(other.on))
        moved[node][static_cast<std::size_t>(fem::axis_of(other.dof))] = &other;
  std::erase_if(moved, [](const auto& node) {
    return std::ranges::any_of(node.second, [](const auto* along) { return along == nullptr; });
  });
  const std::vector<int> nodes = problem.mesh.nodes_on(item.on);
  if (moved.size() <= dim || std::ranges::any_of(nodes, [&](int node) { return !moved.contains(node); }))
    return false;
  using Place = Eigen::Matrix<double, dim, 1>;
  using Places = Eigen::Matrix<double, dim, Eigen::Dynamic>;
  Places before(dim, static_cast<Eigen::Index>(moved.size()));
  Places after(dim, before.cols());
  const double time = time_of_largest(scene, item.value);
  Eigen::Index column = 0;
  for (const auto& [node, along] : moved) {
    const Place place = problem.mesh.nodes[static_cast<std::size_t>(node)];
    before.col(column) = place;
    after.col(column) = place;
    for (int i = 0; i < dim; ++i) {
      const fem::PrescribedDof<dim>& given = *along[static_cast<std::size_t>(i)];
      after(i, column) += given.value.at(time) * (given.profile ? given.profile(place) : 1.0);
    }
    ++column;
  }
  const Eigen::Matrix<double, dim + 1, dim + 1> rigid = Eigen::umeyama(before, after, false);
  const Eigen::Matrix<double, dim, dim> rotation = rigid.template topLeftCorner<dim, dim>();
  const Place shift = rigid.template topRightCorner<dim, 1>();
  Places left = after - rotation * before;
  left.colwise() -= shift;
  constexpr double kAngle = 0.1;  // rad: a body that does not turn is carried along
  return left.colwise().norm().maxCoeff() < kOfATurn * std::abs(item.value.at(time)) &&
         (rotation - Eigen::Matrix<double, dim, dim>::Identity()).norm() > kAngle;
}

template <int dim>
void look_at(const Scene& scene, const fem::Problem<dim>& problem, Remarks& remarks) {
  for (const fem::PrescribedDof<dim>& item : problem.prescribed) {
    // A body that is shaken is carried along.
    if (fem::is_rotation(item.dof) || scene.boundary_value(item.on, "accelerate") != nullptr) continue;
    const double movement = scene.reached(item.value);
    if (movement == 0.0) continue;
    const double side = scene.strained_side(item.dof);
    const double share = movement / side;
    const bool small = problem.deformation == fem::Deformation::small;
    const coupler::Entry* const value = scene.boundary_value(item.on, "move");
    const coupler::Entry& place = value != nullptr ? *value : scene.place({"boundary"});
    const std::string seen =
        fmt::format("boundary: '{}' moves by {:.4g} mm, {:.3g} % of the body ({:.4g} mm)", item.on,
                    1e3 * movement, 100.0 * share, 1e3 * side);
    if (share > kLarge && turns(scene, problem, item)) continue;
    if (share > kLarge)
      remarks.push_back(
          {Rank::wrong, share / kLarge, place.fault(seen), "check the unit: without one it is in m"});
    else if (share > kLargeSmall && small)
      remarks.push_back({Rank::doubtful, share / kLargeSmall, place.fault(seen + ", in small deformation"),
                         "set 'deformation: large', or move less"});
    else if (share < kNoMovement)
      remarks.push_back({Rank::doubtful, kNoMovement / share,
                         place.fault(seen + ", less than rounding and grains can resolve"),
                         "check the units of the movement and of the mesh (Gmsh's numbers are in m)"});
  }
}

}  // namespace

void movement(const Scene& scene, Remarks& remarks) {
  scene.with_problem([&](const auto& problem) { look_at(scene, problem, remarks); });
}

}  // namespace polargrain::app
