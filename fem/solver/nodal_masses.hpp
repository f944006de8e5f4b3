// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <vector>

#include "fem/solver/discretisation.hpp"

namespace polargrain::fem {

/// Masses of explicit steps, chosen and not true: each element gets a density and a rotary inertia of its own, such that its
/// largest eigenfrequency is stable in steps of one unit of time. The largest of the elements bounds that of the mesh
/// (Irons and Treharne 1971), so one step is safe everywhere, and no element is slower than it must be.
/// @param of the tangents, of which the symmetric parts count
/// @param safety step over the critical one, 0 to 1
/// @param also by element: a stiffness that is added to that of the stresses; no element has one where it is empty
/// @return nodal vector, N/m per unit of (length over step squared), and the like for rotations; lumped by the diagonal of the
/// consistent matrix, scaled to the mass of the element (Hinton, Rock and Zienkiewicz 1976)
/// @throws RunError when an element has no stiffness at all
template <int dim>
Eigen::VectorXd nodal_masses(const Discretisation<dim>& discretisation, const Linearisation<dim>& of,
                             double safety, const std::vector<Eigen::MatrixXd>& also = {});

/// True masses, and the time step that is stable with them.
struct TrueMasses {
  Eigen::VectorXd masses;  ///< nodal vector: kg, kg m^2; in the plane per m of thickness
  double seconds = 0.0;    ///< safety times the critical step
};

/// Square of how fast each element would swing if it were made of one and the same material, in the shape that it has now: the
/// effect of the shape on a stable time step. 0 for elements that are not there.
template <int dim>
std::vector<double> swings_of_shapes(const Discretisation<dim>& discretisation);

/// Lumped as above. Rotations get the inertia that makes them no faster than the displacements: true ones would be far faster,
/// and turn with the waves all the same.
/// @param densities kg/m^3, of each element
/// @throws RunError when an element has no stiffness at all
template <int dim>
TrueMasses true_masses(const Discretisation<dim>& discretisation, const Linearisation<dim>& of,
                       const std::vector<double>& densities, double safety,
                       const std::vector<Eigen::MatrixXd>& also = {});

}  // namespace polargrain::fem
