// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/cells/cosserat_part.hpp"

#include <algorithm>

#include "fem/material/rotation.hpp"

namespace polargrain::coupler {

Vector7 symmetric_part(const Vector7& components) {
  Vector7 part = components;
  part[k12] = part[k21] = 0.5 * (components[k12] + components[k21]);
  part.tail<2>().setZero();
  return part;
}

Matrix7 symmetric_tangent(const Matrix7& cell) {
  Matrix7 tangent = Matrix7::Zero();
  tangent.topLeftCorner<5, 5>() = cell.topLeftCorner<5, 5>();
  const Vector7 row = 0.5 * (tangent.row(k12) + tangent.row(k21)).transpose();
  tangent.row(k12) = tangent.row(k21) = row.transpose();
  const Vector7 column = 0.5 * (tangent.col(k12) + tangent.col(k21));
  tangent.col(k12) = tangent.col(k21) = column;
  return tangent;
}

Response CosseratPart::follow(const Increment& increment, const Response& cell,
                              const CosseratParameters& cosserat) {
  const fem::StretchAndTurn step = fem::stretch_and_turn(increment);
  const Vector7 strain = step.stretch.strain();
  skew_stress += 2.0 * cosserat.cosserat_shear_modulus * (strain[k21] - strain[k12]);  // A.4
  couple_stress += cosserat.couple_modulus() * step.stretch.curvature;                 // A.4
  if (increment.configuration != Configuration::fixed)
    couple_stress = fem::rotated(couple_stress, step.angle);
  Response response = joined_to(cell, cosserat);
  if (!cosserat.plastic_length || response.quality == Quality::failed) return response;

  const double length = *cosserat.plastic_length;
  const double pressure = -0.5 * (response.stress[k11] + response.stress[k22]);
  const double limit = length * std::max(0.0, pressure);
  const double trial = couple_stress.norm();
  if (trial <= limit) return response;
  const Eigen::Vector2d direction = couple_stress / trial;
  couple_stress = limit * direction;
  response.stress.tail<2>() = couple_stress;
  response.tangent.bottomRightCorner<2, 2>() =
      cosserat.couple_modulus() * limit / trial *
      (Eigen::Matrix2d::Identity() - direction * direction.transpose());
  if (pressure > 0.0) {  // the limit goes with it
    const Vector7 rise = -0.5 * (response.tangent.row(k11) + response.tangent.row(k22)).transpose();
    response.tangent.bottomLeftCorner<2, 5>() = length * direction * rise.head<5>().transpose();
  }
  return response;
}

Response CosseratPart::joined_to(const Response& cell, const CosseratParameters& cosserat) const {
  Response response = cell;
  if (response.quality == Quality::failed) return response;
  response.stress = symmetric_part(response.stress);
  response.stress[k12] -= 0.5 * skew_stress;
  response.stress[k21] += 0.5 * skew_stress;
  response.stress.tail<2>() = couple_stress;
  response.tangent = symmetric_tangent(response.tangent);
  const double skew_modulus = cosserat.cosserat_shear_modulus;
  response.tangent(k12, k12) += skew_modulus;
  response.tangent(k21, k21) += skew_modulus;
  response.tangent(k12, k21) -= skew_modulus;
  response.tangent(k21, k12) -= skew_modulus;
  response.tangent(kCurvature1, kCurvature1) = cosserat.couple_modulus();
  response.tangent(kCurvature2, kCurvature2) = cosserat.couple_modulus();
  return response;
}

}  // namespace polargrain::coupler
