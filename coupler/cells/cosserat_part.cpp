// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/cells/cosserat_part.hpp"

#include <algorithm>
#include <cmath>

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

double share_held(double trial, double limit) {
  constexpr double kFar = 3.0;
  return trial > kFar * limit ? std::max(CosseratPart::kHold, limit / trial) : CosseratPart::kHold;
}

bool limit_skew(Response<2>& response, double skew_limit, double modulus) {
  const double pressure = pressure_in_plane(response.stress);
  const double limit = skew_limit * std::max(0.0, pressure);
  const double trial = response.stress[k21] - response.stress[k12];
  if (std::abs(trial) <= limit) return false;
  const double shear = 0.5 * (response.stress[k12] + response.stress[k21]);
  const double sign = trial > 0.0 ? 1.0 : -1.0;
  response.stress[k12] = shear - 0.5 * sign * limit;
  response.stress[k21] = shear + 0.5 * sign * limit;
  Vector7 slope = Vector7::Zero();  // of the skew stress
  if (pressure > 0.0)
    slope = -0.5 * sign * skew_limit * (response.tangent.row(k11) + response.tangent.row(k22)).transpose();
  const double hold = 2.0 * share_held(std::abs(trial), limit) * modulus;
  slope[k12] -= hold;
  slope[k21] += hold;
  const Vector7 mean = 0.5 * (response.tangent.row(k12) + response.tangent.row(k21)).transpose();
  response.tangent.row(k12) = (mean - 0.5 * slope).transpose();
  response.tangent.row(k21) = (mean + 0.5 * slope).transpose();
  return true;
}

namespace {

/// The same of the couple stress.
void limit_couple(Response<2>& response, double length, double modulus) {
  const double pressure = pressure_in_plane(response.stress);
  const double limit = length * std::max(0.0, pressure);
  const Eigen::Vector2d couple_stress = response.stress.tail<2>();
  const double trial = couple_stress.norm();
  if (trial <= limit) return;
  const Eigen::Vector2d direction = couple_stress / trial;
  response.stress.tail<2>() = limit * direction;
  response.tangent.bottomRightCorner<2, 2>() =
      modulus * (limit / trial * (Eigen::Matrix2d::Identity() - direction * direction.transpose()) +
                 share_held(trial, limit) * direction * direction.transpose());
  if (pressure > 0.0) {  // the limit goes with it
    const Vector7 rise = -0.5 * (response.tangent.row(k11) + response.tangent.row(k22)).transpose();
    response.tangent.bottomLeftCorner<2, 5>() = length * direction * rise.head<5>().transpose();
  }
}

/// The share of its limit that rounding leaves of a stress at the limit.
constexpr double kAtLimit = 1.0 - 1e-9;

}  // namespace

double share_of_limit(double stress, std::optional<double> limit, double pressure) {
  if (!limit || !(*limit * pressure > 0.0)) return 0.0;
  return std::min(1.0, stress / (*limit * pressure));
}

LimitsReached limits_reached_at(const CosseratParameters& cosserat, double skew, double couple,
                                double contacts_kept, double pressure, double least) {
  LimitsReached reached;
  reached.parted = pressure <= least;
  const auto is_at = [&](double mobilisation, std::optional<double> limit) {
    return !reached.parted && limit && (*limit == 0.0 || mobilisation >= kAtLimit);
  };
  reached.skew = is_at(skew, cosserat.skew_limit);
  reached.couple = is_at(couple, cosserat.plastic_length);
  const bool no_skew = !(contacts_kept > 0.0) || (cosserat.skew_limit && (reached.parted || reached.skew));
  const bool no_couple =
      !(contacts_kept > 0.0) || (cosserat.plastic_length && (reached.parted || reached.couple));
  reached.held = cosserat.has_rotations && no_skew && no_couple;
  return reached;
}

Response<2> CosseratPart::follow(const Increment<2>& increment, const Response<2>& cell,
                                 const CosseratParameters& cosserat, double kept) {
  const fem::StretchAndTurn<2> step = fem::stretch_and_turn(increment);
  const Vector7 strain = step.stretch.strain();
  const double couple_modulus = contacts_kept * cosserat.couple_modulus();
  skew_stress += 2.0 * contacts_kept * cosserat.cosserat_shear_modulus * (strain[k21] - strain[k12]);  // A.4
  couple_stress += couple_modulus * step.stretch.curvature;                                            // A.4
  if (increment.configuration != Configuration::fixed) couple_stress = fem::rotated(couple_stress, step.turn);
  Response<2> response = joined_to(cell, cosserat);
  if (response.quality == Quality::failed) return response;
  if (cosserat.skew_limit) limit_skew(response, *cosserat.skew_limit, cosserat.cosserat_shear_modulus);
  if (cosserat.plastic_length) limit_couple(response, *cosserat.plastic_length, couple_modulus);
  keep_within(cosserat, pressure_in_plane(response.stress));
  contacts_kept = kept;
  return response;
}

void CosseratPart::keep_within(const CosseratParameters& cosserat, double new_pressure) {
  pressure = new_pressure;
  if (cosserat.skew_limit) {
    const double limit = *cosserat.skew_limit * std::max(0.0, pressure);
    skew_stress = std::clamp(skew_stress, -limit, limit);
  }
  if (!cosserat.plastic_length) return;
  const double limit = *cosserat.plastic_length * std::max(0.0, pressure);
  const double trial = couple_stress.norm();
  if (trial > limit) couple_stress = limit * (couple_stress / trial);
}

Response<2> CosseratPart::joined_to(const Response<2>& cell, const CosseratParameters& cosserat) const {
  Response<2> response = cell;
  if (response.quality == Quality::failed) return response;
  response.stress = symmetric_part(response.stress);
  response.stress[k12] -= 0.5 * skew_stress;
  response.stress[k21] += 0.5 * skew_stress;
  response.stress.tail<2>() = couple_stress;
  response.tangent = symmetric_tangent(response.tangent);
  const double skew_modulus = std::max(contacts_kept, kHold) * cosserat.cosserat_shear_modulus;
  response.tangent(k12, k12) += skew_modulus;
  response.tangent(k21, k21) += skew_modulus;
  response.tangent(k12, k21) -= skew_modulus;
  response.tangent(k21, k12) -= skew_modulus;
  const double couple_modulus = contacts_kept * cosserat.couple_modulus();
  response.tangent(kCurvature1, kCurvature1) = couple_modulus;
  response.tangent(kCurvature2, kCurvature2) = couple_modulus;
  return response;
}

double CosseratPart::skew_mobilisation(const CosseratParameters& cosserat) const {
  return share_of_limit(std::abs(skew_stress), cosserat.skew_limit, pressure);
}

double CosseratPart::couple_mobilisation(const CosseratParameters& cosserat) const {
  return share_of_limit(couple_stress.norm(), cosserat.plastic_length, pressure);
}

LimitsReached CosseratPart::reached(const CosseratParameters& cosserat, double least) const {
  return limits_reached_at(cosserat, skew_mobilisation(cosserat), couple_mobilisation(cosserat),
                           contacts_kept, pressure, least);
}

}  // namespace polargrain::coupler
