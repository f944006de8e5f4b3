// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/cells/space_cosserat_part.hpp"

#include <algorithm>
#include <cmath>

#include "fem/material/polar_decomposition.hpp"
#include "fem/material/rotation.hpp"

namespace polargrain::coupler {
namespace {

using Space = Cosserat<3>;
using SkewRows = Eigen::Matrix<double, 3, 9>;
using Matrix9 = Eigen::Matrix<double, 9, 9>;

/// Takes the skew stress t_k = s_ji - s_ij, (i, j, k) cyclic, out of the nine stresses.
SkewRows skew_rows() {
  SkewRows rows = SkewRows::Zero();
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3;
    const int j = (k + 2) % 3;
    rows(k, Space::stress_place(j, i)) = 1.0;
    rows(k, Space::stress_place(i, j)) = -1.0;
  }
  return rows;
}

/// Makes stresses and strains symmetric.
Matrix9 symmetriser() {
  Matrix9 made = Matrix9::Zero();
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (const int place : {Space::stress_place(i, j), Space::stress_place(j, i)})
        made(Space::stress_place(i, j), place) += 0.5;
  return made;
}

/// How the mean pressure follows the strain: a row of the tangent.
Eigen::Matrix<double, 1, 18> pressure_slope(const Matrix18& tangent) {
  return -(tangent.row(0) + tangent.row(4) + tangent.row(8)) / 3.0;
}

/// The rows of the tangent of a vector of stresses that has returned radially to a limit.
/// @param trial before the return @param elastic its rows before the return @param slope of the limit
template <int rows>
Eigen::Matrix<double, rows, 18> rows_at_limit(const Eigen::Matrix<double, rows, 1>& trial, double limit,
                                              const Eigen::Matrix<double, rows, 18>& elastic,
                                              const Eigen::Matrix<double, 1, 18>& slope) {
  const double length = trial.norm();
  const Eigen::Matrix<double, rows, 1> direction = trial / length;
  return limit / length * (elastic - direction * (direction.transpose() * elastic)) + direction * slope;
}

}  // namespace

Response<3> SpaceCosseratPart::follow(const Increment<3>& increment, const Response<3>& cell,
                                      const CosseratParameters& cosserat, double kept) {
  const fem::StretchAndTurn<3> step = fem::stretch_and_turn(increment);
  const Vector18 strain = step.stretch.strain();
  const SkewRows skew = skew_rows();
  const double skew_modulus = 2.0 * contacts_kept * cosserat.cosserat_shear_modulus;
  const double couple_modulus = contacts_kept * cosserat.couple_modulus();
  skew_stress += skew_modulus * (skew * strain.head<9>());
  couple_stress += couple_modulus * strain.tail<9>();
  if (increment.configuration != Configuration::fixed) {
    Vector18 turned;
    turned << Eigen::Matrix<double, 9, 1>::Zero(), couple_stress;
    couple_stress = fem::rotated(turned, step.turn).tail<9>();
    skew_stress = step.turn * skew_stress;
  }
  Response<3> response = joined_to(cell, cosserat);
  if (response.quality == Quality::failed) return response;
  const double now = mean_pressure(response.stress);
  const Eigen::Matrix<double, 1, 18> slope = pressure_slope(response.tangent);
  const auto slope_of = [&](double factor) -> Eigen::Matrix<double, 1, 18> {
    return now > 0.0 ? Eigen::Matrix<double, 1, 18>(factor * slope) : Eigen::Matrix<double, 1, 18>::Zero();
  };
  if (cosserat.skew_limit) {
    const double limit = *cosserat.skew_limit * std::max(0.0, now);
    if (skew_stress.norm() > limit) {
      Eigen::Matrix<double, 3, 18> elastic = Eigen::Matrix<double, 3, 18>::Zero();
      elastic.leftCols<9>() = skew_modulus * skew;
      Eigen::Matrix<double, 3, 18> change =
          rows_at_limit<3>(skew_stress, limit, elastic, slope_of(*cosserat.skew_limit));
      change.leftCols<9>() +=
          2.0 * share_held(skew_stress.norm(), limit) * cosserat.cosserat_shear_modulus * skew;
      const Eigen::Matrix<double, 3, 18> before = skew * response.tangent.topRows<9>();
      response.tangent.topRows<9>() += 0.5 * skew.transpose() * (change - before);
      const Eigen::Vector3d less = limit / skew_stress.norm() * skew_stress - skew_stress;
      response.stress.head<9>() += 0.5 * skew.transpose() * less;
    }
  }
  if (cosserat.plastic_length) {
    const double limit = *cosserat.plastic_length * std::max(0.0, now);
    if (couple_stress.norm() > limit) {
      Eigen::Matrix<double, 9, 18> elastic = Eigen::Matrix<double, 9, 18>::Zero();
      elastic.rightCols<9>() = couple_modulus * Matrix9::Identity();
      response.tangent.bottomRows<9>() =
          rows_at_limit<9>(couple_stress, limit, elastic, slope_of(*cosserat.plastic_length));
      const Eigen::Matrix<double, 9, 1> direction = couple_stress / couple_stress.norm();
      response.tangent.bottomRightCorner<9, 9>() +=
          share_held(couple_stress.norm(), limit) * couple_modulus * direction * direction.transpose();
      response.stress.tail<9>() = limit * direction;
    }
  }
  keep_within(cosserat, now);
  contacts_kept = kept;
  return response;
}

Response<3> SpaceCosseratPart::joined_to(const Response<3>& cell, const CosseratParameters& cosserat) const {
  Response<3> response = cell;
  if (response.quality == Quality::failed) return response;
  static const Matrix9 symmetric = symmetriser();
  const SkewRows skew = skew_rows();
  response.stress.head<9>() = symmetric * cell.stress.head<9>() + 0.5 * skew.transpose() * skew_stress;
  response.stress.tail<9>() = couple_stress;
  response.tangent.setZero();
  const double modulus = std::max(contacts_kept, CosseratPart::kHold) * cosserat.cosserat_shear_modulus;
  response.tangent.topLeftCorner<9, 9>() =
      symmetric * cell.tangent.topLeftCorner<9, 9>() * symmetric + modulus * skew.transpose() * skew;
  response.tangent.bottomRightCorner<9, 9>() =
      contacts_kept * cosserat.couple_modulus() * Matrix9::Identity();
  return response;
}

void SpaceCosseratPart::keep_within(const CosseratParameters& cosserat, double new_pressure) {
  pressure = new_pressure;
  const auto reduce = [&](auto& stress, double limit) {
    if (const double length = stress.norm(); length > limit) stress *= limit / length;
  };
  if (cosserat.skew_limit) reduce(skew_stress, *cosserat.skew_limit * std::max(0.0, pressure));
  if (cosserat.plastic_length) reduce(couple_stress, *cosserat.plastic_length * std::max(0.0, pressure));
}

double SpaceCosseratPart::skew_mobilisation(const CosseratParameters& cosserat) const {
  return share_of_limit(skew_stress.norm(), cosserat.skew_limit, pressure);
}

double SpaceCosseratPart::couple_mobilisation(const CosseratParameters& cosserat) const {
  return share_of_limit(couple_stress.norm(), cosserat.plastic_length, pressure);
}

LimitsReached SpaceCosseratPart::reached(const CosseratParameters& cosserat, double least) const {
  return limits_reached_at(cosserat, skew_mobilisation(cosserat), couple_mobilisation(cosserat),
                           contacts_kept, pressure, least);
}

}  // namespace polargrain::coupler
