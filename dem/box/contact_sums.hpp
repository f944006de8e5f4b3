// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <cmath>
#include <span>

#include "dem/contact/contact_recorder.hpp"

namespace polargrain::dem {

/// Sums over the contacts of a force pass. A step of a resident box asks for no more, so that no list is made for it.
template <int dim>
struct ContactSums {
  using Vector = Eigen::Matrix<double, dim, 1>;
  /// branch_i force_j, N m; over the volume it is the stress (average_stress).
  Eigen::Matrix<double, dim, dim> virial = Eigen::Matrix<double, dim, dim>::Zero();
  double forces = 0.0;  ///< magnitudes, N
  double contacts = 0.0;

  void add(const Vector& branch, const Vector& force) {
    virial += branch * force.transpose();
    double square = force[0] * force[0] + force[1] * force[1];
    if constexpr (dim == 3) square += force[2] * force[2];
    forces += std::sqrt(square);
    contacts += 1.0;
  }
};

/// @param contacts of a force pass, in the order of the list
template <int dim>
ContactSums<dim> sums_of(std::span<const Contact> contacts) {
  ContactSums<dim> sums;
  for (const Contact& contact : contacts)
    sums.add(contact.branch.template head<dim>(), contact.force.template head<dim>());
  return sums;
}

}  // namespace polargrain::dem
