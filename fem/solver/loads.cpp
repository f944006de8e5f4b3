// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/solver/loads.hpp"

#include <numeric>

#include "fem/element/dofs.hpp"
#include "fem/element/quadrature.hpp"

namespace polargrain::fem {
namespace {

/// Shape functions of a straight or quadratic side: first corner at -1, second at +1, middle node last.
void side_shape(std::size_t nodes, double x, Eigen::VectorXd& value, Eigen::VectorXd& derivative) {
  if (nodes == 2) {
    value = Eigen::Vector2d(0.5 * (1 - x), 0.5 * (1 + x));
    derivative = Eigen::Vector2d(-0.5, 0.5);
  } else {
    value = Eigen::Vector3d(0.5 * x * (x - 1), 0.5 * x * (x + 1), 1 - x * x);
    derivative = Eigen::Vector3d(x - 0.5, x + 0.5, -2 * x);
  }
}

/// Nodal vector of a traction given by the outward normal. Both are per reference length of the side:
/// `normal` has the length of d s / d xi.
template <class Traction>
Eigen::VectorXd edge_forces(const Mesh& mesh, const std::vector<Edge>& edges, Traction traction) {
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(entry_of(static_cast<Eigen::Index>(mesh.nodes.size())));
  Eigen::VectorXd value;
  Eigen::VectorXd derivative;
  for (const Edge& edge : edges) {
    const std::vector<int> numbers = mesh.edge_nodes(edge);
    for (const LinePoint& place : gauss_line(3)) {
      side_shape(numbers.size(), place.position, value, derivative);
      Eigen::Vector2d tangent = Eigen::Vector2d::Zero();
      for (std::size_t a = 0; a < numbers.size(); ++a) {
        tangent +=
            derivative(static_cast<Eigen::Index>(a)) * mesh.nodes[static_cast<std::size_t>(numbers[a])];
      }
      const Eigen::Vector3d force = place.weight * traction(Eigen::Vector2d(tangent(1), -tangent(0)));
      for (std::size_t a = 0; a < numbers.size(); ++a) {
        forces.segment<kDofsOfNode>(entry_of(numbers[a])) += value(static_cast<Eigen::Index>(a)) * force;
      }
    }
  }
  return forces;
}

Eigen::Vector3d unit_pressure(const Eigen::Vector2d& normal) {
  return {-normal(0), -normal(1), 0.0};
}

/// With the tangent t of the side, the force of a unit pressure at node a is N_a (-t2, t1) per reference
/// length.
EdgeStiffness unit_pressure_stiffness(const Mesh& mesh, const Edge& edge) {
  const std::vector<int> numbers = mesh.edge_nodes(edge);
  const auto size = 2 * static_cast<Eigen::Index>(numbers.size());
  EdgeStiffness stiffness{{}, Eigen::MatrixXd::Zero(size, size)};
  for (const int number : numbers) {
    for (const Dof dof : {Dof::u1, Dof::u2}) stiffness.entries.push_back(entry_of(number, dof));
  }
  Eigen::VectorXd value;
  Eigen::VectorXd derivative;
  for (const LinePoint& place : gauss_line(3)) {
    side_shape(numbers.size(), place.position, value, derivative);
    const Eigen::MatrixXd product = place.weight * value * derivative.transpose();
    for (Eigen::Index a = 0; a < value.size(); ++a) {
      for (Eigen::Index b = 0; b < value.size(); ++b) {
        stiffness.values(2 * a, 2 * b + 1) -= product(a, b);
        stiffness.values(2 * a + 1, 2 * b) += product(a, b);
      }
    }
  }
  return stiffness;
}

}  // namespace

Loads::Loads(const Problem& problem)
    : problem_(problem), size_(entry_of(static_cast<Eigen::Index>(problem.mesh.nodes.size()))) {
  for (const EdgeLoad& load : problem.edge_loads) add_edge_load(problem, load);
  for (const NodeLoad& load : problem.node_loads) add_node_load(problem, load);
  for (const BodyLoad& load : problem.body_loads) add_body_load(problem, load);
}

void Loads::add_edge_load(const Problem& problem, const EdgeLoad& load) {
  const std::vector<Edge>& edges = problem.mesh.boundaries.at(load.on);
  const auto add = [&](const TimeTable& table, auto traction) {
    if (table.largest_magnitude() == 0.0) return;
    parts_.push_back({edge_forces(problem.mesh, edges, traction), &table});
  };
  if (load.pressure.largest_magnitude() > 0.0) {
    Pressure& pressure = pressures_.emplace_back(Pressure{parts_.size(), &load, {}});
    if (problem.deformation == Deformation::large) {
      for (const Edge& edge : edges)
        pressure.stiffness.push_back(unit_pressure_stiffness(problem.mesh, edge));
    }
    parts_.push_back({edge_forces(problem.mesh, edges, unit_pressure), &load.pressure});
  }
  add(load.traction1, [](const Eigen::Vector2d& normal) { return Eigen::Vector3d(normal.norm(), 0.0, 0.0); });
  add(load.traction2, [](const Eigen::Vector2d& normal) { return Eigen::Vector3d(0.0, normal.norm(), 0.0); });
  add(load.couple_traction,
      [](const Eigen::Vector2d& normal) { return Eigen::Vector3d(0.0, 0.0, normal.norm()); });
}

void Loads::add_node_load(const Problem& problem, const NodeLoad& load) {
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(size_);
  for (const int node : problem.mesh.nodes_on(load.on)) forces(entry_of(node, load.dof)) += 1.0;
  parts_.push_back({std::move(forces), &load.value});
}

void Loads::add_body_load(const Problem& problem, const BodyLoad& load) {
  const Mesh& mesh = problem.mesh;
  std::vector<int> elements(mesh.elements.size());
  std::iota(elements.begin(), elements.end(), 0);
  if (!load.region.empty()) elements = mesh.regions.at(load.region);
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(size_);
  for (const int e : elements) {
    const Element& element = mesh.elements[static_cast<std::size_t>(e)];
    for (const PointGeometry& point : point_geometries(*element.type, mesh.element_positions(e))) {
      const Eigen::Vector3d force = point.volume * load.density(point.position);
      for (std::size_t a = 0; a < element.nodes.size(); ++a) {
        forces.segment<kDofsOfNode>(entry_of(element.nodes[a])) +=
            point.shape(static_cast<Eigen::Index>(a)) * force;
      }
    }
  }
  parts_.push_back({std::move(forces), &load.factor});
}

void Loads::move_to(const Eigen::VectorXd& nodal) {
  if (pressures_.empty()) return;
  Mesh moved = problem_.mesh;
  for (std::size_t node = 0; node < moved.nodes.size(); ++node) {
    moved.nodes[node] += nodal.segment<2>(entry_of(static_cast<Eigen::Index>(node)));
  }
  for (const Pressure& pressure : pressures_) {
    parts_[pressure.part].forces = edge_forces(moved, moved.boundaries.at(pressure.load->on), unit_pressure);
  }
}

std::vector<EdgeStiffness> Loads::stiffness(double time) const {
  std::vector<EdgeStiffness> all;
  for (const Pressure& pressure : pressures_) {
    const double value = pressure.load->pressure.at(time);
    for (const EdgeStiffness& unit : pressure.stiffness) all.push_back({unit.entries, value * unit.values});
  }
  return all;
}

Eigen::VectorXd Loads::linearised(double time, const Eigen::VectorXd& nodal) const {
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(size_);
  for (const EdgeStiffness& edge : stiffness(time)) {
    forces(edge.entries) += edge.values * nodal(edge.entries);
  }
  return forces;
}

Eigen::VectorXd Loads::at(double time) const {
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(size_);
  for (const Part& part : parts_) forces += part.factor->at(time) * part.forces;
  return forces;
}

Eigen::VectorXd Loads::slope(double time) const {
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(size_);
  for (const Part& part : parts_) forces += part.factor->slope(time) * part.forces;
  return forces;
}

double Loads::largest_force() const {
  double sum = 0.0;
  for (const Part& part : parts_) {
    for (Eigen::Index entry = 0; entry < size_; ++entry) {
      if (entry % kDofsOfNode != static_cast<int>(Dof::w))
        sum += std::abs(part.forces(entry)) * part.factor->largest_magnitude();
    }
  }
  return sum;
}

}  // namespace polargrain::fem
