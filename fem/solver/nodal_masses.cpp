// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/solver/nodal_masses.hpp"
#include "common/symmetric_modes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/error.hpp"
#include "common/symmetric_modes.hpp"
#include "fem/element/dofs.hpp"

namespace polargrain::fem {
namespace {

/// Volumes that belong to the nodes of an element: the diagonal of the integral of N_a N_b, scaled to the whole volume.
template <int dim>
Eigen::VectorXd shares_of_nodes(const Discretisation<dim>& discretisation, std::size_t e) {
  Eigen::VectorXd shares =
      Eigen::VectorXd::Zero(discretisation.point(discretisation.first_point(e)).shape.size());
  double volume = 0.0;
  for (std::size_t i = discretisation.first_point(e); i < discretisation.first_point(e + 1); ++i) {
    const PointGeometry<dim>& point = discretisation.point(i);
    shares += point.volume * point.shape.cwiseAbs2();
    volume += point.volume;
  }
  return shares * (volume / shares.sum());
}

double largest_eigenvalue(const Eigen::MatrixXd& symmetric) {
  return symmetric_eigenvalues(symmetric).maxCoeff();
}

/// The symmetric part of an element's tangent, with what comes beside the stresses.
template <int dim>
Eigen::MatrixXd stiffness_of(const Discretisation<dim>& discretisation, const Linearisation<dim>& of,
                             std::size_t e, const std::vector<Eigen::MatrixXd>& also) {
  Eigen::MatrixXd tangent = discretisation.element_tangent(e, of);
  if (!also.empty() && also[e].size() > 0) tangent += also[e];
  return 0.5 * (tangent + tangent.transpose());
}

/// M^(-1/2) K M^(-1/2).
Eigen::MatrixXd scaled(const Eigen::MatrixXd& stiffness, const Eigen::VectorXd& masses) {
  const Eigen::VectorXd root = masses.cwiseSqrt().cwiseInverse();
  return root.asDiagonal() * stiffness * root.asDiagonal();
}

}  // namespace

template <int dim>
Eigen::VectorXd nodal_masses(const Discretisation<dim>& discretisation, const Linearisation<dim>& of,
                             double safety, const std::vector<Eigen::MatrixXd>& also) {
  // Central differences are stable up to an eigenvalue of 4 with steps of 1.
  const double allowed = 4.0 * safety * safety;
  Eigen::VectorXd masses = Eigen::VectorXd::Zero(discretisation.nodal_size());
  for (std::size_t e = 0; e < discretisation.elements(); ++e) {
    const Eigen::MatrixXd stiffness = stiffness_of(discretisation, of, e, also);
    const Eigen::VectorXd shares = shares_of_nodes(discretisation, e);
    Eigen::VectorXd own = Eigen::VectorXd::Ones(stiffness.rows());
    for (const bool rotary : {false, true}) {
      Eigen::VectorXd weights = Eigen::VectorXd::Zero(stiffness.rows());
      std::vector<Eigen::Index> entries;
      for (Eigen::Index entry = 0; entry < stiffness.rows(); ++entry) {
        if (is_rotation(dof_at<dim>(entry)) == rotary) entries.push_back(entry);
        weights(entry) = shares(entry / Cosserat<dim>::dofs);
      }
      const double largest =
          largest_eigenvalue(scaled(stiffness(entries, entries), Eigen::VectorXd(weights(entries))));
      if (!rotary && !(largest > 0.0))
        throw RunError(
            fmt::format("element {} has no stiffness that explicit steps could find its mass by", e));
      // Where nothing resists the rotation, any inertia will do.
      const double density = largest > 0.0 ? largest / allowed : 1.0;
      for (const Eigen::Index entry : entries) own(entry) = density * weights(entry);
    }
    // Displacements and rotations together may be faster than either alone: by a factor of two at most.
    const double together = largest_eigenvalue(scaled(stiffness, own)) / allowed;
    masses(discretisation.element_dofs(e)) += std::max(1.0, together) * own;
  }
  return masses;
}

namespace {

/// The share of an element in the time step.
struct OfElement {
  Eigen::MatrixXd stiffness;  ///< symmetric
  Eigen::VectorXd weights;    ///< of each entry: volume that belongs to its node
  std::vector<Eigen::Index> displacements;
  std::vector<Eigen::Index> rotations;
};

template <int dim>
OfElement of_element(const Discretisation<dim>& discretisation, const Linearisation<dim>& of, std::size_t e,
                     const std::vector<Eigen::MatrixXd>& also = {}) {
  OfElement element;
  element.stiffness = stiffness_of(discretisation, of, e, also);
  const Eigen::VectorXd shares = shares_of_nodes(discretisation, e);
  element.weights = Eigen::VectorXd::Zero(element.stiffness.rows());
  for (Eigen::Index entry = 0; entry < element.stiffness.rows(); ++entry) {
    (is_rotation(dof_at<dim>(entry)) ? element.rotations : element.displacements).push_back(entry);
    element.weights(entry) = shares(entry / Cosserat<dim>::dofs);
  }
  return element;
}

double largest_of(const OfElement& element, const std::vector<Eigen::Index>& entries,
                  const Eigen::VectorXd& masses) {
  return largest_eigenvalue(scaled(element.stiffness(entries, entries), Eigen::VectorXd(masses(entries))));
}

}  // namespace

template <int dim>
std::vector<double> swings_of_shapes(const Discretisation<dim>& discretisation) {
  Response<dim> unit;
  unit.tangent.setIdentity();
  const std::vector<Response<dim>> answers(discretisation.points(), unit);
  std::vector<double> swings(discretisation.elements(), 0.0);
  for (std::size_t e = 0; e < swings.size(); ++e) {
    if (!discretisation.is_there(e)) continue;
    const OfElement element = of_element(discretisation, Linearisation<dim>{answers}, e);
    swings[e] = largest_of(element, element.displacements, element.weights);
  }
  return swings;
}

template <int dim>
TrueMasses true_masses(const Discretisation<dim>& discretisation, const Linearisation<dim>& of,
                       const std::vector<double>& densities, double safety,
                       const std::vector<Eigen::MatrixXd>& also) {
  // Rotations this much slower than the step allows: coupled with displacements they hardly shorten it.
  constexpr double kSlowRotations = 4.0;
  TrueMasses all{Eigen::VectorXd::Zero(discretisation.nodal_size()), 0.0};
  double fastest = 0.0;  // eigenvalue, 1/s^2
  for (std::size_t e = 0; e < discretisation.elements(); ++e) {
    const OfElement element = of_element(discretisation, of, e, also);
    const double largest = largest_of(element, element.displacements, densities[e] * element.weights);
    if (!(largest > 0.0))
      throw RunError(fmt::format("element {} has no stiffness that a time step could follow from", e));
    fastest = std::max(fastest, largest);
  }
  double together = 0.0;
  for (std::size_t e = 0; e < discretisation.elements(); ++e) {
    const OfElement element = of_element(discretisation, of, e, also);
    Eigen::VectorXd masses = densities[e] * element.weights;
    const double rotary = largest_of(element, element.rotations, element.weights);
    for (const Eigen::Index entry : element.rotations)
      masses(entry) =
          rotary > 0.0 ? kSlowRotations * rotary / fastest * element.weights(entry) : element.weights(entry);
    together = std::max(together, largest_eigenvalue(scaled(element.stiffness, masses)));
    all.masses(discretisation.element_dofs(e)) += masses;
  }
  all.seconds = 2.0 * safety / std::sqrt(together);
  return all;
}

template std::vector<double> swings_of_shapes<2>(const Discretisation<2>&);
template std::vector<double> swings_of_shapes<3>(const Discretisation<3>&);
template TrueMasses true_masses<2>(const Discretisation<2>&, const Linearisation<2>&,
                                   const std::vector<double>&, double, const std::vector<Eigen::MatrixXd>&);
template TrueMasses true_masses<3>(const Discretisation<3>&, const Linearisation<3>&,
                                   const std::vector<double>&, double, const std::vector<Eigen::MatrixXd>&);
template Eigen::VectorXd nodal_masses<2>(const Discretisation<2>& discretisation, const Linearisation<2>& of,
                                         double safety, const std::vector<Eigen::MatrixXd>&);
template Eigen::VectorXd nodal_masses<3>(const Discretisation<3>& discretisation, const Linearisation<3>& of,
                                         double safety, const std::vector<Eigen::MatrixXd>&);

}  // namespace polargrain::fem
