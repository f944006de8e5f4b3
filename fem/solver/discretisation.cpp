// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/solver/discretisation.hpp"

#include <fmt/format.h>

#include <cmath>

#include "fem/element/dofs.hpp"
#include "fem/element/large_tangent.hpp"

namespace polargrain::fem {

Discretisation::Discretisation(const Mesh& mesh, Continuum continuum)
    : mesh_(mesh),
      continuum_(continuum),
      nodal_size_(entry_of(static_cast<Eigen::Index>(mesh.nodes.size()))) {
  first_point_.push_back(0);
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const int number = static_cast<int>(e);
    for (PointGeometry& point : point_geometries(*mesh.elements[e].type, mesh.element_positions(number))) {
      points_.push_back(std::move(point));
      element_of_point_.push_back(number);
    }
    first_point_.push_back(points_.size());
    std::vector<int>& dofs = dofs_.emplace_back();
    for (const int node : mesh.elements[e].nodes) {
      for (const Dof dof : {Dof::u1, Dof::u2, Dof::w}) dofs.push_back(entry_of(node, dof));
    }
  }
}

std::string Discretisation::move_to(const Eigen::VectorXd& nodal) {
  for (std::size_t e = 0; e < elements(); ++e) {
    const int number = static_cast<int>(e);
    Eigen::MatrixX2d positions = mesh_.element_positions(number);
    for (std::size_t a = 0; a < mesh_.elements[e].nodes.size(); ++a) {
      positions.row(static_cast<Eigen::Index>(a)) +=
          nodal.segment<2>(entry_of(mesh_.elements[e].nodes[a])).transpose();
    }
    std::size_t i = first_point_[e];
    for (PointGeometry& point : point_geometries(*mesh_.elements[e].type, positions)) {
      if (!(point.volume > 0.0)) {
        return fmt::format("element {} is turned inside out at ({:.6g}, {:.6g})", e, point.position(0),
                           point.position(1));
      }
      points_[i++] = std::move(point);
    }
  }
  return {};
}

Eigen::VectorXd Discretisation::gather(std::size_t e, const Eigen::VectorXd& nodal) const {
  return nodal(dofs_[e]);
}

std::vector<Increment> Discretisation::increments(const Eigen::VectorXd& nodal) const {
  std::vector<Increment> all;
  all.reserve(points_.size());
  for (std::size_t e = 0; e < elements(); ++e) {
    const Eigen::VectorXd local = gather(e, nodal);
    for (std::size_t i = first_point_[e]; i < first_point_[e + 1]; ++i) {
      all.push_back(increment_at(points_[i], continuum_, local));
    }
  }
  return all;
}

double Discretisation::volume_of(std::size_t e) const {
  double volume = 0.0;
  for (std::size_t i = first_point_[e]; i < first_point_[e + 1]; ++i) volume += points_[i].volume;
  return volume;
}

std::vector<Increment> Discretisation::increments_to(const Discretisation& end,
                                                     const Eigen::VectorXd& nodal) const {
  std::vector<Increment> all;
  all.reserve(points_.size());
  for (std::size_t e = 0; e < elements(); ++e) {
    const Eigen::VectorXd local = gather(e, nodal);
    const bool mean = mesh_.elements[e].type->mean_dilatation;
    const double of_element = mean ? end.volume_of(e) / volume_of(e) : 1.0;
    for (std::size_t i = first_point_[e]; i < first_point_[e + 1]; ++i) {
      const double own = end.points_[i].volume / points_[i].volume;
      all.push_back(
          large_increment_at(points_[i], continuum_, local, mean ? std::sqrt(of_element / own) : 1.0));
    }
  }
  return all;
}

Eigen::VectorXd Discretisation::internal_forces(std::span<const Response> responses) const {
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(nodal_size_);
  for (std::size_t e = 0; e < elements(); ++e) {
    Eigen::VectorXd local = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(dofs_[e].size()));
    for (std::size_t i = first_point_[e]; i < first_point_[e + 1]; ++i) {
      local.noalias() +=
          strain_matrix(points_[i], continuum_).transpose() * (points_[i].volume * responses[i].stress);
    }
    forces(dofs_[e]) += local;
  }
  return forces;
}

Eigen::VectorXd Discretisation::linearised_forces(const Linearisation& of,
                                                  const Eigen::VectorXd& nodal) const {
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(nodal_size_);
  for (std::size_t e = 0; e < elements(); ++e) {
    const Eigen::VectorXd u = gather(e, nodal);
    if (u.isZero(0.0)) continue;
    forces(dofs_[e]) += element_tangent(e, of) * u;
  }
  return forces;
}

Eigen::MatrixXd Discretisation::element_tangent(std::size_t e, const Linearisation& of) const {
  const auto size = static_cast<Eigen::Index>(dofs_[e].size());
  Eigen::MatrixXd tangent = Eigen::MatrixXd::Zero(size, size);
  for (std::size_t i = first_point_[e]; i < first_point_[e + 1]; ++i) {
    if (const auto& moving = of.moving) {
      tangent +=
          large_tangent(points_[i], moving->start.point(i), moving->increments[i], continuum_, of.answers[i]);
      continue;
    }
    const auto b = strain_matrix(points_[i], continuum_);
    const Eigen::Matrix<double, 7, Eigen::Dynamic> db = (points_[i].volume * of.answers[i].tangent) * b;
    tangent.noalias() += b.transpose() * db;
  }
  if (of.moving && mesh_.elements[e].type->mean_dilatation) {
    const std::size_t points = first_point_[e + 1] - first_point_[e];
    tangent += mean_dilatation_stiffness(std::span(points_).subspan(first_point_[e], points),
                                         std::span(of.answers).subspan(first_point_[e], points));
  }
  return tangent;
}

}  // namespace polargrain::fem
