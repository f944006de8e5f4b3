// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/solver/discretisation.hpp"

#include <fmt/format.h>

#include <cmath>

#include "common/elementary_functions.hpp"
#include "fem/element/averaged_places.hpp"
#include "fem/element/dofs.hpp"
#include "fem/element/large_tangent.hpp"

namespace polargrain::fem {

namespace {

/// The ratio of lengths that belongs to a ratio of volumes.
template <int dim>
double length_ratio(double volume_ratio) {
  return dim == 2 ? std::sqrt(volume_ratio) : power(volume_ratio, 1.0 / 3.0);
}

}  // namespace

template <int dim>
Discretisation<dim>::Discretisation(const Mesh<dim>& mesh, Continuum continuum, Eigen::Index field_entries)
    : mesh_(mesh),
      continuum_(continuum),
      nodal_size_(entry_of<dim>(static_cast<Eigen::Index>(mesh.nodes.size())) + field_entries) {
  first_point_.push_back(0);
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const int number = static_cast<int>(e);
    for (PointGeometry<dim>& point :
         point_geometries<dim>(*mesh.elements[e].type, mesh.element_positions(number))) {
      points_.push_back(std::move(point));
      element_of_point_.push_back(number);
    }
    first_point_.push_back(points_.size());
    averaged_.push_back(averaged_places<dim>(*mesh.elements[e].type, mesh.element_positions(number)));
    std::vector<int>& dofs = dofs_.emplace_back();
    for (const int node : mesh.elements[e].nodes) {
      for (const Dof dof : node_dofs<dim>()) dofs.push_back(entry_of<dim>(node, dof));
    }
  }
}

template <int dim>
std::string Discretisation<dim>::move_to(const Eigen::VectorXd& nodal) {
  for (std::size_t e = 0; e < elements(); ++e) {
    if (!is_there(e)) continue;
    const int number = static_cast<int>(e);
    VectorRows<dim> positions = mesh_.element_positions(number);
    for (std::size_t a = 0; a < mesh_.elements[e].nodes.size(); ++a) {
      positions.row(static_cast<Eigen::Index>(a)) +=
          nodal.segment<dim>(entry_of<dim>(mesh_.elements[e].nodes[a])).transpose();
    }
    averaged_[e] = averaged_places<dim>(*mesh_.elements[e].type, positions);
    std::size_t i = first_point_[e];
    for (PointGeometry<dim>& point : point_geometries<dim>(*mesh_.elements[e].type, positions)) {
      if (!(point.volume > 0.0)) {
        return fmt::format("element {} is turned inside out at {}", e, place_text<dim>(point.position));
      }
      points_[i++] = std::move(point);
    }
  }
  return {};
}

template <int dim>
Eigen::VectorXd Discretisation<dim>::gather(std::size_t e, const Eigen::VectorXd& nodal) const {
  return nodal(dofs_[e]);
}

template <int dim>
std::vector<Increment<dim>> Discretisation<dim>::increments(const Eigen::VectorXd& nodal) const {
  std::vector<Increment<dim>> all;
  all.reserve(points_.size());
  for (std::size_t e = 0; e < elements(); ++e) {
    if (!is_there(e)) {
      all.resize(first_point_[e + 1]);
      continue;
    }
    const Eigen::VectorXd local = gather(e, nodal);
    for (std::size_t i = first_point_[e]; i < first_point_[e + 1]; ++i) {
      all.push_back(increment_at<dim>(points_[i], continuum_, local));
    }
  }
  return all;
}

template <int dim>
double Discretisation<dim>::volume_of(std::size_t e) const {
  double volume = 0.0;
  for (std::size_t i = first_point_[e]; i < first_point_[e + 1]; ++i) volume += points_[i].volume;
  return volume;
}

template <int dim>
std::vector<Increment<dim>> Discretisation<dim>::increments_to(const Discretisation<dim>& end,
                                                               const Eigen::VectorXd& nodal) const {
  std::vector<Increment<dim>> all;
  all.reserve(points_.size());
  for (std::size_t e = 0; e < elements(); ++e) {
    if (!is_there(e)) {
      all.resize(first_point_[e + 1]);
      continue;
    }
    const Eigen::VectorXd local = gather(e, nodal);
    const bool mean = mesh_.elements[e].type->mean_dilatation;
    const double of_element = mean ? end.volume_of(e) / volume_of(e) : 1.0;
    for (std::size_t i = first_point_[e]; i < first_point_[e + 1]; ++i) {
      const double own = end.points_[i].volume / points_[i].volume;
      all.push_back(large_increment_at<dim>(points_[i], continuum_, local,
                                            mean ? length_ratio<dim>(of_element / own) : 1.0));
    }
  }
  return all;
}

template <int dim>
Eigen::VectorXd Discretisation<dim>::internal_forces(std::span<const Response<dim>> responses) const {
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(nodal_size_);
  for (std::size_t e = 0; e < elements(); ++e) {
    if (!is_there(e)) continue;
    Eigen::VectorXd local = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(dofs_[e].size()));
    for (std::size_t i = first_point_[e]; i < first_point_[e + 1]; ++i) {
      local.noalias() +=
          strain_matrix<dim>(points_[i], continuum_).transpose() * (points_[i].volume * responses[i].stress);
    }
    forces(dofs_[e]) += local;
  }
  return forces;
}

template <int dim>
Eigen::VectorXd Discretisation<dim>::linearised_forces(const Linearisation<dim>& of,
                                                       const Eigen::VectorXd& nodal) const {
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(nodal_size_);
  for (std::size_t e = 0; e < elements(); ++e) {
    if (!is_there(e)) continue;
    const Eigen::VectorXd u = gather(e, nodal);
    if (u.isZero(0.0)) continue;
    forces(dofs_[e]) += element_tangent(e, of) * u;
  }
  return forces;
}

template <int dim>
Eigen::MatrixXd Discretisation<dim>::element_tangent(std::size_t e, const Linearisation<dim>& of) const {
  const auto size = static_cast<Eigen::Index>(dofs_[e].size());
  Eigen::MatrixXd tangent = Eigen::MatrixXd::Zero(size, size);
  for (std::size_t i = first_point_[e]; i < first_point_[e + 1]; ++i) {
    if (const auto& moving = of.moving) {
      tangent += large_tangent<dim>(points_[i], moving->start.point(i), moving->increments[i], continuum_,
                                    of.answers[i], averaged_[e]);
      continue;
    }
    const auto b = strain_matrix<dim>(points_[i], continuum_);
    const StrainMatrix<dim> db = (points_[i].volume * of.answers[i].tangent) * b;
    tangent.noalias() += b.transpose() * db;
  }
  if (of.moving && mesh_.elements[e].type->mean_dilatation) {
    const std::size_t points = first_point_[e + 1] - first_point_[e];
    tangent += mean_dilatation_stiffness<dim>(std::span(points_).subspan(first_point_[e], points),
                                              std::span(of.answers).subspan(first_point_[e], points));
  }
  return tangent;
}

template class Discretisation<2>;
template class Discretisation<3>;

}  // namespace polargrain::fem
