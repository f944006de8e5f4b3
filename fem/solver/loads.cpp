// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/solver/loads.hpp"

#include <array>
#include <map>
#include <numeric>
#include <utility>

#include "fem/element/dofs.hpp"
#include "fem/material/polar_decomposition.hpp"

namespace polargrain::fem {
namespace {

template <int dim>
using Place = typename Cosserat<dim>::Place;
template <int dim>
using NodeValues = typename Cosserat<dim>::NodeValues;

/// One quadrature point of a side in place.
template <int dim>
struct SidePoint {
  double weight;
  Eigen::VectorXd shape;
  VectorRows<dim - 1> derivative;                ///< of the shape functions by the side's own coordinates
  Eigen::Matrix<double, dim, dim - 1> tangents;  ///< d x / d xi
  Place<dim> normal;  ///< outward; as long as an area of 1 of the reference side becomes
};

template <int dim>
std::vector<SidePoint<dim>> points_of_side(const Mesh<dim>& mesh, const BoundarySide& side,
                                           const std::vector<int>& numbers) {
  const ElementType<dim - 1>& type = *mesh.side_of(side).type;
  std::vector<SidePoint<dim>> points;
  for (const QuadraturePoint<dim - 1>& place : type.quadrature) {
    ShapeFunctions<dim - 1> shape = type.shape_functions(place.position);
    SidePoint<dim> point;
    point.tangents.setZero();
    for (std::size_t a = 0; a < numbers.size(); ++a) {
      point.tangents += mesh.nodes[static_cast<std::size_t>(numbers[a])] *
                        shape.derivative.row(static_cast<Eigen::Index>(a));
    }
    if constexpr (dim == 2) {
      point.normal = {point.tangents(1), -point.tangents(0)};
    } else {
      point.normal = point.tangents.col(0).cross(point.tangents.col(1));
    }
    point.weight = place.weight;
    point.shape = std::move(shape.value);
    point.derivative = std::move(shape.derivative);
    points.push_back(std::move(point));
  }
  return points;
}

/// Nodal vector of a traction given by the outward normal. Both are per area of the reference side.
template <int dim, class Traction>
Eigen::VectorXd side_forces(const Mesh<dim>& mesh, const std::vector<BoundarySide>& sides,
                            Traction traction) {
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(entry_of<dim>(static_cast<Eigen::Index>(mesh.nodes.size())));
  for (const BoundarySide& side : sides) {
    const std::vector<int> numbers = mesh.side_nodes(side);
    for (const SidePoint<dim>& point : points_of_side<dim>(mesh, side, numbers)) {
      const NodeValues<dim> force = point.weight * traction(point.normal);
      for (std::size_t a = 0; a < numbers.size(); ++a) {
        forces.segment<Cosserat<dim>::dofs>(entry_of<dim>(numbers[a])) +=
            point.shape(static_cast<Eigen::Index>(a)) * force;
      }
    }
  }
  return forces;
}

template <int dim>
NodeValues<dim> unit_pressure(const Place<dim>& normal) {
  NodeValues<dim> force = NodeValues<dim>::Zero();
  for (int i = 0; i < dim; ++i) force(i) = -normal(i);
  return force;
}

/// How the normal changes with the place of node b.
template <int dim>
typename Cosserat<dim>::Gradient normal_slope(const SidePoint<dim>& point, Eigen::Index b) {
  typename Cosserat<dim>::Gradient slope;
  if constexpr (dim == 2) {
    slope << 0.0, point.derivative(b), -point.derivative(b), 0.0;
  } else {
    slope = point.derivative(b, 1) * cross_matrix(point.tangents.col(0)) -
            point.derivative(b, 0) * cross_matrix(point.tangents.col(1));
  }
  return slope;
}

/// Derivative of the forces of a unit pressure, -N_a times the normal.
template <int dim>
LoadStiffness unit_pressure_stiffness(const Mesh<dim>& mesh, const BoundarySide& side) {
  const std::vector<int> numbers = mesh.side_nodes(side);
  const auto size = dim * static_cast<Eigen::Index>(numbers.size());
  LoadStiffness stiffness{{}, Eigen::MatrixXd::Zero(size, size)};
  for (const int number : numbers) {
    for (int i = 0; i < dim; ++i) stiffness.entries.push_back(entry_of<dim>(number) + i);
  }
  for (const SidePoint<dim>& point : points_of_side<dim>(mesh, side, numbers)) {
    for (Eigen::Index b = 0; b < point.shape.size(); ++b) {
      const typename Cosserat<dim>::Gradient slope = normal_slope<dim>(point, b);
      for (Eigen::Index a = 0; a < point.shape.size(); ++a)
        stiffness.values.template block<dim, dim>(dim * a, dim * b) -=
            (point.weight * point.shape(a)) * slope;
    }
  }
  return stiffness;
}

}  // namespace

template <int dim>
Loads<dim>::Loads(const Problem<dim>& problem, int stage)
    : problem_(&problem),
      there_(elements_in_stage(problem, stage)),
      size_(entry_of<dim>(static_cast<Eigen::Index>(problem.mesh.nodes.size()))),
      nodal_size_(problem.places().size()) {
  for (const BoundaryLoad<dim>& load : problem.boundary_loads)
    if (load.life.holds(stage)) add_boundary_load(problem, load, stage);
  for (const NodeLoad& load : problem.node_loads)
    if (load.life.holds(stage)) add_node_load(problem, load);
  for (const BodyLoad<dim>& load : problem.body_loads)
    if (load.life.holds(stage)) add_body_load(problem, load);
}

template <int dim>
void Loads<dim>::add_boundary_load(const Problem<dim>& problem, const BoundaryLoad<dim>& load, int stage) {
  const std::vector<BoundarySide> sides = sides_in_stage(problem, load, stage);
  if (load.pressure.largest_magnitude() > 0.0) {
    Pressure& pressure = pressures_.emplace_back(Pressure{parts_.size(), &load, sides, {}});
    if (problem.deformation == Deformation::large) {
      for (const BoundarySide& side : sides)
        pressure.stiffness.push_back(unit_pressure_stiffness<dim>(problem.mesh, side));
    }
    parts_.push_back({side_forces<dim>(problem.mesh, sides, unit_pressure<dim>), &load.pressure});
  }
  const auto add = [&](const TimeTable& table, int direction) {
    if (table.largest_magnitude() == 0.0) return;
    const auto traction = [direction](const Place<dim>& normal) {
      return NodeValues<dim>(normal.norm() * NodeValues<dim>::Unit(direction));
    };
    parts_.push_back({side_forces<dim>(problem.mesh, sides, traction), &table});
  };
  for (int i = 0; i < dim; ++i) add(load.traction[static_cast<std::size_t>(i)], i);
  for (int k = 0; k < Cosserat<dim>::rotations; ++k)
    add(load.couple_traction[static_cast<std::size_t>(k)], dim + k);
}

template <int dim>
void Loads<dim>::add_node_load(const Problem<dim>& problem, const NodeLoad& load) {
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(nodal_size_);
  std::vector<int> nodes = problem.mesh.nodes_on(load.on);
  if (!there_.empty()) {
    const std::vector<char> there = nodes_in_stage(problem.mesh, there_);
    std::erase_if(nodes, [&](int node) { return there[static_cast<std::size_t>(node)] == 0; });
  }
  const FieldPlaces<dim> places = problem.places();
  const std::size_t field = number_of_field(problem.fields, load.field);
  struct Entries {
    std::vector<int> of_dof;
    std::vector<int> of_field;
  };
  std::map<std::array<double, dim>, Entries> at_place;
  for (const int node : nodes) {
    std::array<double, dim> place;
    Eigen::Map<Place<dim>>(place.data()) = problem.mesh.nodes[static_cast<std::size_t>(node)];
    Entries& here = at_place[place];
    const int in_field = field < places.fields() ? places.entry(field, node) : -1;
    in_field >= 0 ? here.of_field.push_back(in_field) : here.of_dof.push_back(entry_of<dim>(node, load.dof));
  }
  for (const auto& [place, here] : at_place) {
    const std::vector<int>& entries = here.of_field.empty() ? here.of_dof : here.of_field;
    for (const int entry : entries) forces(entry) += 1.0 / static_cast<double>(entries.size());
  }
  parts_.push_back({std::move(forces), &load.value});
}

template <int dim>
void Loads<dim>::add_body_load(const Problem<dim>& problem, const BodyLoad<dim>& load) {
  const Mesh<dim>& mesh = problem.mesh;
  std::vector<int> elements(mesh.elements.size());
  std::iota(elements.begin(), elements.end(), 0);
  if (!load.region.empty()) elements = mesh.regions.at(load.region);
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(size_);
  for (const int e : elements) {
    if (!there_.empty() && there_[static_cast<std::size_t>(e)] == 0) continue;
    const Element<dim>& element = mesh.elements[static_cast<std::size_t>(e)];
    for (const PointGeometry<dim>& point : point_geometries<dim>(*element.type, mesh.element_positions(e))) {
      const NodeValues<dim> force = point.volume * load.density(point.position);
      for (std::size_t a = 0; a < element.nodes.size(); ++a) {
        forces.segment<Cosserat<dim>::dofs>(entry_of<dim>(element.nodes[a])) +=
            point.shape(static_cast<Eigen::Index>(a)) * force;
      }
    }
  }
  parts_.push_back({std::move(forces), &load.factor});
}

template <int dim>
void Loads<dim>::move_to(const Eigen::VectorXd& nodal) {
  if (pressures_.empty()) return;
  Mesh<dim> moved = problem_->mesh;
  for (std::size_t node = 0; node < moved.nodes.size(); ++node) {
    moved.nodes[node] += nodal.segment<dim>(entry_of<dim>(static_cast<Eigen::Index>(node)));
  }
  for (Pressure& pressure : pressures_) {
    const std::vector<BoundarySide>& sides = pressure.sides;
    parts_[pressure.part].forces = side_forces<dim>(moved, sides, unit_pressure<dim>);
    if (dim == 2) continue;  // there the forces are linear in the places of the nodes
    for (std::size_t k = 0; k < pressure.stiffness.size(); ++k)
      pressure.stiffness[k] = unit_pressure_stiffness<dim>(moved, sides[k]);
  }
}

template <int dim>
std::vector<LoadStiffness> Loads<dim>::stiffness(double time) const {
  std::vector<LoadStiffness> all;
  for (const Pressure& pressure : pressures_) {
    const double value = pressure.load->pressure.at(time);
    for (const LoadStiffness& unit : pressure.stiffness) all.push_back({unit.entries, value * unit.values});
  }
  return all;
}

template <int dim>
Eigen::VectorXd Loads<dim>::linearised(double time, const Eigen::VectorXd& nodal) const {
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(nodal_size_);
  for (const LoadStiffness& side : stiffness(time)) {
    forces(side.entries) += side.values * nodal(side.entries);
  }
  return forces;
}

template <int dim>
void Loads<dim>::hold(const Eigen::VectorXd& forces) {
  static const TimeTable kAlways = TimeTable::constant(1.0);
  parts_.push_back({forces, &kAlways});
}

template <int dim>
std::vector<ShareOfSide<dim>> shares_of_boundary(const Mesh<dim>& mesh, const std::string& boundary) {
  std::vector<ShareOfSide<dim>> shares;
  for (const BoundarySide& side : mesh.boundaries.at(boundary)) {
    const std::vector<int> numbers = mesh.side_nodes(side);
    Eigen::VectorXd of_nodes = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(numbers.size()));
    Place<dim> normal = Place<dim>::Zero();
    double area = 0.0;
    for (const SidePoint<dim>& point : points_of_side<dim>(mesh, side, numbers)) {
      of_nodes += point.weight * point.normal.norm() * point.shape.cwiseAbs2();
      area += point.weight * point.normal.norm();
      normal += point.weight * point.normal;
    }
    of_nodes *= area / of_nodes.sum();
    for (std::size_t a = 0; a < numbers.size(); ++a)
      shares.push_back(
          {side.element, numbers[a], of_nodes(static_cast<Eigen::Index>(a)), normal.normalized()});
  }
  return shares;
}

template <int dim>
Eigen::VectorXd Loads<dim>::at(double time) const {
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(nodal_size_);
  for (const Part& part : parts_) forces.head(part.forces.size()) += part.factor->at(time) * part.forces;
  return forces;
}

template <int dim>
Eigen::VectorXd Loads<dim>::slope(double time) const {
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(nodal_size_);
  for (const Part& part : parts_) forces.head(part.forces.size()) += part.factor->slope(time) * part.forces;
  return forces;
}

template <int dim>
double Loads<dim>::largest_force() const {
  return sum_of(false, [](const TimeTable& table) { return table.largest_magnitude(); });
}

template <int dim>
double Loads<dim>::largest_moment() const {
  return sum_of(true, [](const TimeTable& table) { return table.largest_magnitude(); });
}

template <int dim>
double Loads<dim>::largest_change(double time) const {
  return sum_of(false, [time](const TimeTable& table) { return table.largest_change(time); });
}

template <int dim>
template <class Factor>
double Loads<dim>::sum_of(bool rotations, Factor factor_of) const {
  double sum = 0.0;
  for (const Part& part : parts_) {
    for (Eigen::Index entry = 0; entry < size_; ++entry) {
      if (is_rotation(dof_at<dim>(entry)) == rotations)
        sum += std::abs(part.forces(entry)) * factor_of(*part.factor);
    }
  }
  return sum;
}

template std::vector<ShareOfSide<2>> shares_of_boundary(const Mesh<2>&, const std::string&);
template std::vector<ShareOfSide<3>> shares_of_boundary(const Mesh<3>&, const std::string&);
template class Loads<2>;
template class Loads<3>;

}  // namespace polargrain::fem
