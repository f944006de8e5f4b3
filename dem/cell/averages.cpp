// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/cell/averages.hpp"

#include <array>
#include <cmath>

namespace polargrain::dem {

Eigen::Matrix2d average_stress(std::span<const Contact> contacts, double volume) {
  Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
  for (const Contact& contact : contacts) sum += contact.branch * contact.force.transpose();
  return sum / volume;
}

Matrix7 voigt_tangent(std::span<const Contact> contacts, const Eigen::Matrix2d& frame, double volume) {
  // In the basis e11, e22, e12 + e21 (engineering shear): 3 columns of symmetric strain, 4 rows of stress.
  const std::array<Eigen::Matrix2d, 3> unit_strains = [] {
    std::array<Eigen::Matrix2d, 3> strains{Eigen::Matrix2d::Zero(), Eigen::Matrix2d::Zero(),
                                           Eigen::Matrix2d::Zero()};
    strains[0](0, 0) = 1.0;
    strains[1](1, 1) = 1.0;
    strains[2](0, 1) = strains[2](1, 0) = 0.5;
    return strains;
  }();
  std::array<Eigen::Matrix2d, 3> stress_rates{Eigen::Matrix2d::Zero(), Eigen::Matrix2d::Zero(),
                                              Eigen::Matrix2d::Zero()};
  for (const Contact& contact : contacts) {
    const Eigen::Vector2d branch = frame * contact.branch;
    const Eigen::Vector2d n = branch.normalized();
    const Eigen::Vector2d t(-n.y(), n.x());
    const double slip_coupling =
        contact.sliding() ? std::copysign(contact.friction, contact.tangential_force()) : 0.0;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector2d opening = unit_strains[k] * branch;
      const double normal_rate = contact.normal_stiffness * opening.dot(n);
      // Sticking: k_t times the tangential opening. Sliding: f_t = +-mu f_n, and f_n falls as the contact
      // opens.
      const double tangential_rate =
          contact.sliding() ? -slip_coupling * normal_rate : contact.tangential_stiffness * opening.dot(t);
      stress_rates[k] += branch * (normal_rate * n + tangential_rate * t).transpose();
    }
  }
  return symmetrised_tangent(stress_rates, volume);
}

Matrix7 symmetrised_tangent(const std::array<Eigen::Matrix2d, 3>& stress_rates, double volume) {
  Matrix7 tangent = Matrix7::Zero();
  const std::array<std::array<int, 2>, 3> columns{{{k11, k11}, {k22, k22}, {k12, k21}}};
  for (int k = 0; k < 3; ++k) {
    const Eigen::Matrix2d rate = stress_rates[k] / volume;
    const double shear = 0.5 * (rate(0, 1) + rate(1, 0));
    for (const int column : columns[k]) {
      tangent(k11, column) = rate(0, 0);
      tangent(k22, column) = rate(1, 1);
      tangent(k12, column) = shear;
      tangent(k21, column) = shear;
    }
  }
  return tangent;
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
  return mean(contacts, [](const Contact& contact) { return contact.force.norm(); });
}

double mean_normal_stiffness(std::span<const Contact> contacts) {
  return mean(contacts, [](const Contact& contact) { return contact.normal_stiffness; });
}

}  // namespace polargrain::dem
