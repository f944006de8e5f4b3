// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/cell/tangents.hpp"

#include "dem/cell/linear_contact.hpp"
#include "dem/cell/tangent_strains.hpp"

namespace polargrain::dem {

Matrix7 voigt_cosserat_tangent(std::span<const Contact> contacts, const Eigen::Matrix2d& frame,
                               double volume) {
  Matrix7 sum = Matrix7::Zero();
  for (const Contact& contact : contacts) {
    const LinearContact law(contact, frame);
    sum += law.affine.transpose() * law.stiffness * law.affine;
  }
  return sum / volume;
}

Matrix7 voigt_tangent(std::span<const Contact> contacts, const Eigen::Matrix2d& frame, double volume) {
  return classical_tangent<2>(voigt_cosserat_tangent(contacts, frame, volume) * classical_strains<2>());
}

}  // namespace polargrain::dem
