// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/spheres/space_contact.hpp"

#include <Eigen/Geometry>

namespace polargrain::dem {

Eigen::Matrix3d space_stress(std::span<const Contact> contacts, double volume) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const Contact& contact : contacts) sum += branch_of(contact) * force_of(contact).transpose();
  return sum / volume;
}

Eigen::Matrix3d space_couple_stress(std::span<const Contact> contacts, double volume) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const Contact& contact : contacts) {
    const Eigen::Vector3d branch = branch_of(contact);
    const Eigen::Vector3d polar =
        0.5 * (contact.arm_second - contact.arm_first) * force_of(contact).cross(branch.normalized());
    sum += branch * (moment_of(contact) + polar).transpose();
  }
  return sum / volume;
}

Eigen::Matrix3d space_fabric(std::span<const Contact> contacts) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const Contact& contact : contacts) {
    const Eigen::Vector3d n = branch_of(contact).normalized();
    sum += n * n.transpose();
  }
  return contacts.empty() ? sum : Eigen::Matrix3d(sum / static_cast<double>(contacts.size()));
}

double space_normal_force(const Contact& contact) {
  return -force_of(contact).dot(branch_of(contact).normalized());
}

bool slides_in_space(const Contact& contact) {
  const Eigen::Vector3d n = branch_of(contact).normalized();
  const Eigen::Vector3d force = force_of(contact);
  const double normal = force.dot(n);
  const double tangential = (force - normal * n).norm();
  // The law scales the spring exactly to the limit; only round-off is allowed for.
  return contact.friction > 0.0 && tangential >= contact.friction * std::abs(normal) * (1.0 - 1e-9);
}

}  // namespace polargrain::dem
