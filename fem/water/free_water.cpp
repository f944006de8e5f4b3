// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/water/free_water.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>

#include "fem/element/dofs.hpp"
#include "fem/element/quadrature.hpp"

namespace polargrain::fem {
namespace {

/// A point of a face: shape functions of its nodes, and normal times area.
template <int dim>
struct PressedPoint {
  Eigen::VectorXd shape;
  double height;
  typename Cosserat<dim>::Place area;
};

/// Of the part of a side below the level, so that a load that ends within it is exact.
std::vector<PressedPoint<2>> wet_points(const ElementType<1>& type, const VectorRows<2>& positions,
                                        double level) {
  double from = -1.0;
  double to = 1.0;
  const double first = level - positions(0, 1);
  const double last = level - positions(1, 1);
  if (first <= 0.0 && last <= 0.0) return {};
  if (first < 0.0 || last < 0.0) (first < 0.0 ? from : to) = -1.0 + 2.0 * first / (first - last);
  std::vector<PressedPoint<2>> points;
  for (const LinePoint& at : gauss_line(3)) {
    const double xi = 0.5 * (from + to) + 0.5 * (to - from) * at.position;
    const ShapeFunctions<1> shape = type.shape_functions(Eigen::Matrix<double, 1, 1>(xi));
    const Eigen::Vector2d along = positions.transpose() * shape.derivative;
    points.push_back({shape.value, (positions.transpose() * shape.value)(1),
                      0.5 * (to - from) * at.weight * Eigen::Vector2d(along(1), -along(0))});
  }
  return points;
}

/// The part of a side below the level, as a polygon of its reference coordinates; heights go straight along its edges.
std::vector<Eigen::Vector2d> wet_polygon(const ElementType<2>& type, const VectorRows<3>& positions,
                                         double level) {
  std::vector<Eigen::Vector2d> wet;
  for (int a = 0; a < type.corners; ++a) {
    const int b = (a + 1) % type.corners;
    const Eigen::Vector2d& here = type.node_positions[static_cast<std::size_t>(a)];
    const Eigen::Vector2d& next = type.node_positions[static_cast<std::size_t>(b)];
    const double below = level - positions(a, 2);
    const double next_below = level - positions(b, 2);
    if (below >= 0.0) wet.push_back(here);
    if ((below > 0.0 && next_below < 0.0) || (below < 0.0 && next_below > 0.0))
      wet.emplace_back(here + below / (below - next_below) * (next - here));
  }
  return wet;
}

/// Points of a triangle of reference coordinates, exact to the fourth degree: squares that collapse at the first corner.
std::vector<QuadraturePoint<2>> points_of_triangle(const Eigen::Vector2d& first,
                                                   const Eigen::Vector2d& second,
                                                   const Eigen::Vector2d& third) {
  const Eigen::Vector2d one = second - first;
  const Eigen::Vector2d other = third - second;
  const double twice_area = one(0) * other(1) - one(1) * other(0);
  std::vector<QuadraturePoint<2>> points;
  for (const LinePoint& out : gauss_line(3))
    for (const LinePoint& across : gauss_line(3)) {
      const double r = 0.5 * (1.0 + out.position);
      points.push_back({first + r * (one + 0.5 * (1.0 + across.position) * other),
                        0.25 * out.weight * across.weight * r * twice_area});
    }
  return points;
}

std::vector<PressedPoint<3>> wet_points(const ElementType<2>& type, const VectorRows<3>& positions,
                                        double level) {
  if (positions.col(2).minCoeff() >= level) return {};
  std::vector<PressedPoint<3>> points;
  const std::vector<InterfacePoint<3>> whole = interface_points<3>(type, positions);
  if (positions.col(2).maxCoeff() <= level) {
    for (const InterfacePoint<3>& point : whole)
      points.push_back({point.shape, point.place(2), point.area * point.axes.row(2).transpose()});
    return points;
  }
  const std::vector<Eigen::Vector2d> wet = wet_polygon(type, positions, level);
  for (std::size_t k = 2; k < wet.size(); ++k)
    for (const QuadraturePoint<2>& at : points_of_triangle(wet[0], wet[k - 1], wet[k])) {
      const ShapeFunctions<2> shape = type.shape_functions(at.position);
      const Eigen::Matrix<double, 3, 2> along = positions.transpose() * shape.derivative;
      const Eigen::Vector3d area = at.weight * along.col(0).cross(along.col(1));
      const bool is_along = area.dot(whole.front().axes.row(2)) > 0.0;
      points.push_back({shape.value, (positions.transpose() * shape.value)(2), is_along ? area : -area});
    }
  return points;
}

}  // namespace

template <int dim>
std::vector<BareFace<dim>> bare_sides_of_ground(const Mesh<dim>& mesh, const std::string& boundary) {
  const auto key_of = [&](const BoundarySide& side) {
    std::vector<int> nodes = mesh.side_nodes(side);
    std::ranges::sort(nodes);
    return nodes;
  };
  std::map<std::vector<int>, std::vector<BoundarySide>> sides;  // of the boundary, as both elements see them
  for (const BoundarySide& side : mesh.boundaries.at(boundary)) sides[key_of(side)];
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    for (std::size_t k = 0; k < mesh.elements[e].type->sides.size(); ++k) {
      const BoundarySide side{static_cast<int>(e), static_cast<int>(k)};
      if (const auto here = sides.find(key_of(side)); here != sides.end()) here->second.push_back(side);
    }
  std::vector<BareFace<dim>> faces;
  for (const BoundarySide& side : mesh.boundaries.at(boundary)) {
    const std::vector<BoundarySide>& both = sides.at(key_of(side));
    for (std::size_t k = 0; k < both.size(); ++k)
      faces.push_back({mesh.side_of(both[k]).type, mesh.side_nodes(both[k]), 1.0, both[k].element,
                       both.size() > 1 ? both[1 - k].element : -1, nullptr});
  }
  return faces;
}

template <int dim>
std::vector<BareFace<dim>> bare_sides_of_wall(
    const std::shared_ptr<const Interface<dim>>& interface,
    const std::function<bool(const InterfaceFace<dim>&)>& is_one_sided) {
  std::vector<BareFace<dim>> faces;
  for (std::size_t e = 0; e < interface->elements(); ++e) {
    const InterfaceFace<dim>& face = interface->face(e);
    faces.push_back({face.type, face.nodes_b, -1.0, -1, face.neighbours.front(), interface});
    if (is_one_sided(face)) faces.push_back({face.type, face.nodes_b, 1.0, -1, -1, interface});
  }
  return faces;
}

template <int dim>
FreeWater<dim>::FreeWater(const Mesh<dim>& mesh, std::string on, TimeTable level, double unit_weight,
                          std::vector<BareFace<dim>> faces)
    : on_(std::move(on)), level_(std::move(level)), unit_weight_(unit_weight) {
  for (BareFace<dim>& bare : faces) {
    Face& face = faces_.emplace_back();
    face.positions.resize(static_cast<Eigen::Index>(bare.nodes.size()), dim);
    for (std::size_t a = 0; a < bare.nodes.size(); ++a) {
      face.positions.row(static_cast<Eigen::Index>(a)) =
          mesh.nodes[static_cast<std::size_t>(bare.nodes[a])].transpose();
      for (int i = 0; i < dim; ++i) face.entries.push_back(entry_of<dim>(bare.nodes[a], static_cast<Dof>(i)));
    }
    face.bare = std::move(bare);
  }
  set_stage(0, {});
}

template <int dim>
bool FreeWater<dim>::is_there(std::size_t e, int stage, const std::vector<char>& there) const {
  const BareFace<dim>& bare = faces_[e].bare;
  const auto stands = [&](int element) {
    return there.empty() || there[static_cast<std::size_t>(element)] != 0;
  };
  return this->life.holds(stage) && (!bare.wall || bare.wall->life.holds(stage)) &&
         (bare.element < 0 || stands(bare.element)) && (bare.opposite < 0 || !stands(bare.opposite));
}

template <int dim>
void FreeWater<dim>::set_stage(int stage, const std::vector<char>& there) {
  for (std::size_t e = 0; e < faces_.size(); ++e) faces_[e].active = is_there(e, stage, there);
}

template <int dim>
Eigen::VectorXd FreeWater<dim>::forces_on(const Face& face, double level) const {
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(face.entries.size()));
  for (const PressedPoint<dim>& point : wet_points(*face.bare.type, face.positions, level)) {
    const double pressure = unit_weight_ * (level - point.height);
    for (Eigen::Index a = 0; a < point.shape.size(); ++a)
      forces.segment<dim>(dim * a) -= face.bare.into_water * pressure * point.shape(a) * point.area;
  }
  return forces;
}

template <int dim>
std::string FreeWater<dim>::evaluate(const NodalStep& step, NodalForces& forces) {
  evaluated_level_ = level_.at(step.time);
  const double level_before = level_.at(step.start_time);
  work_ = 0.0;
  for (const Face& face : faces_) {
    if (!face.active) continue;
    const Eigen::VectorXd pressed = forces_on(face, evaluated_level_);
    forces.internal(face.entries) -= pressed;
    work_ += 0.5 * (forces_on(face, level_before) + pressed).dot(step.increment(face.entries));
  }
  return {};
}

template <int dim>
bool FreeWater<dim>::add_forces_on_face(const std::vector<int>& nodes, Eigen::VectorXd& forces) const {
  bool is_here = false;
  for (const Face& face : faces_) {
    if (!face.bare.wall || !std::ranges::is_permutation(face.bare.nodes, nodes)) continue;
    is_here = true;
    if (!face.active) continue;
    const Eigen::VectorXd pressed = forces_on(face, committed_level_);
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      const auto node = std::ranges::find(face.bare.nodes, nodes[a]) - face.bare.nodes.begin();
      forces.segment<dim>(dim * static_cast<Eigen::Index>(a)) -= pressed.segment<dim>(dim * node);
    }
  }
  return is_here;
}

template <int dim>
Eigen::MatrixXd FreeWater<dim>::tangent(std::size_t e) const {
  const auto size = static_cast<Eigen::Index>(faces_[e].entries.size());
  return Eigen::MatrixXd::Zero(size, size);
}

template <int dim>
std::vector<std::string> FreeWater<dim>::faults(const Problem<dim>& problem) const {
  if (problem.deformation == Deformation::large)
    return {fmt::format("{}: free water is of small deformation; set 'deformation: small'", name())};
  return {};
}

// Sides of ground that has gone are no fault: their water has gone with them.
template <int dim>
std::vector<std::string> FreeWater<dim>::faults_of_stage(const Problem<dim>& problem, int stage) const {
  const std::vector<char> there = elements_in_stage(problem, stage);
  const auto stands = [&](int element) {
    return element >= 0 && (there.empty() || there[static_cast<std::size_t>(element)] != 0);
  };
  bool is_covered = false;
  for (std::size_t e = 0; e < faces_.size(); ++e) {
    if (is_there(e, stage, there)) return {};
    const BareFace<dim>& bare = faces_[e].bare;
    is_covered = is_covered || (stands(bare.opposite) && (bare.element < 0 || stands(bare.element)));
  }
  if (!is_covered) return {};
  return {fmt::format(
      "{} presses on nothing, as ground lies all along it; let it begin in the stage that removes that ground",
      name())};
}

template std::vector<BareFace<2>> bare_sides_of_ground<2>(const Mesh<2>&, const std::string&);
template std::vector<BareFace<3>> bare_sides_of_ground<3>(const Mesh<3>&, const std::string&);
template std::vector<BareFace<2>> bare_sides_of_wall<2>(const std::shared_ptr<const Interface<2>>&,
                                                        const std::function<bool(const InterfaceFace<2>&)>&);
template std::vector<BareFace<3>> bare_sides_of_wall<3>(const std::shared_ptr<const Interface<3>>&,
                                                        const std::function<bool(const InterfaceFace<3>&)>&);
template class FreeWater<2>;
template class FreeWater<3>;

}  // namespace polargrain::fem
