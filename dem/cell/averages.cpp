// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/cell/averages.hpp"

#include <cmath>

namespace polargrain::dem {

Eigen::Matrix3d average_stress(std::span<const Contact> contacts, double volume) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const Contact& contact : contacts) sum += contact.branch * contact.force.transpose();
  return sum / volume;
}

Eigen::Matrix3d average_couple_stress(std::span<const Contact> contacts, double volume) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const Contact& contact : contacts) sum += contact.branch * contact.couple().transpose();
  return sum / volume;
}

Eigen::Matrix3d fabric_tensor(std::span<const Contact> contacts) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const Contact& contact : contacts) {
    const Eigen::Vector3d n = contact.normal();
    sum += n * n.transpose();
  }
  return contacts.empty() ? sum : Eigen::Matrix3d(sum / static_cast<double>(contacts.size()));
}

namespace {
template <typename Quantity>
double mean(std::span<const Contact> contacts, Quantity quantity) {
  double sum = 0.0;
  for (const Contact& contact : contacts) sum += quantity(contact);
  return contacts.empty() ? 0.0 : sum / static_cast<double>(contacts.size());
}
}  // namespace

double mean_contact_force(std::span<const Contact> contacts) {
  return mean(contacts, [](const Contact& contact) {
    return std::sqrt(contact.force.head<2>().squaredNorm() + contact.force.z() * contact.force.z());
  });
}

double mean_normal_stiffness(std::span<const Contact> contacts) {
  return mean(contacts, [](const Contact& contact) { return contact.normal_stiffness; });
}

}  // namespace polargrain::dem
