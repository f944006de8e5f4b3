// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/cells/cosserat_part.hpp"

#include <algorithm>
#include <cmath>

#include "fem/material/rotation.hpp"

namespace polargrain::coupler {
namespace {

template <int dim>
using Skew = typename CosseratPart<dim>::Skew;
template <int dim>
using Couples = typename CosseratPart<dim>::Couples;
/// Derivatives of a number, and of a skew stress, by the strain.
template <int dim>
using Slope = Eigen::Matrix<double, 1, Cosserat<dim>::components>;
template <int dim>
using SkewSlopes = Eigen::Matrix<double, Cosserat<dim>::rotations, Cosserat<dim>::components>;

/// The places of the two stresses s_ij and s_ji whose difference s_ji - s_ij works on rotation k.
struct CouplePair {
  int ij, ji;
};
template <int dim>
CouplePair pair_of(int k) {
  const int axis = Cosserat<dim>::axis(k);
  const int i = (axis + 1) % 3;
  const int j = (axis + 2) % 3;
  return {Cosserat<dim>::stress_place(i, j), Cosserat<dim>::stress_place(j, i)};
}

/// The moments of each face as a row: m_ik.
template <int dim>
Eigen::Matrix<double, dim, Cosserat<dim>::rotations> by_face(const Couples<dim>& couples) {
  Eigen::Matrix<double, dim, Cosserat<dim>::rotations> made;
  for (int i = 0; i < dim; ++i)
    for (int k = 0; k < Cosserat<dim>::rotations; ++k)
      made(i, k) = couples(Cosserat<dim>::couple_place(i, k) - Cosserat<dim>::stresses);
  return made;
}

/// How the sum of weight_kl P_kl follows the strain; the weights have the trace 1.
template <int dim>
Slope<dim> slope_of_pressure(const typename Cosserat<dim>::Matrix& tangent, const Pressures<dim>& weight) {
  if constexpr (dim == 2) {
    (void)weight;
    return -0.5 * (tangent.row(k11) + tangent.row(k22));
  } else {
    Slope<dim> slope = Slope<dim>::Zero();
    for (int k = 0; k < 3; ++k) {
      slope -= 0.5 * tangent.row(Cosserat<3>::stress_place(k, k));
      for (int l = 0; l < 3; ++l) slope += 0.5 * weight(k, l) * tangent.row(Cosserat<3>::stress_place(k, l));
    }
    return slope;
  }
}

/// The couple stress of an answer, returned to its limit.
template <int dim>
void limit_couple(Response<dim>& response, double length, double modulus) {
  constexpr int stresses = Cosserat<dim>::stresses;
  constexpr int couples = Cosserat<dim>::couples;
  const Pressures<dim> pressures = pressures_of<dim>(response.stress);
  const Couples<dim> couple_stress = response.stress.template tail<couples>();
  const double pressure = pressure_about_couples<dim>(pressures, couple_stress);
  const double limit = length * std::max(0.0, pressure);
  const double trial = couple_stress.norm();
  if (trial <= limit) return;
  const Couples<dim> direction = couple_stress / trial;
  using Square = Eigen::Matrix<double, couples, couples>;
  response.stress.template tail<couples>() = limit * direction;
  response.tangent.template bottomRightCorner<couples, couples>() =
      modulus * (limit / trial * (Square::Identity() - direction * direction.transpose()) +
                 share_held(trial, limit) * direction * direction.transpose());
  if (!(pressure > 0.0)) return;
  // The limit goes with the pressure, and the pressure, in space, with the axes of the moments.
  const auto faces = by_face<dim>(direction);
  const Pressures<dim> weight = faces.transpose() * faces;
  const Slope<dim> rise = slope_of_pressure<dim>(response.tangent, weight);
  response.tangent.template bottomLeftCorner<couples, stresses>() =
      length * direction * rise.template head<stresses>();
  if constexpr (dim == 3) {
    const Eigen::Matrix3d by_direction = 2.0 * faces * pressures;
    Couples<dim> gradient;
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) gradient(Cosserat<3>::couple_place(i, k) - stresses) = by_direction(i, k);
    gradient -= direction * direction.dot(gradient);
    response.tangent.template bottomRightCorner<couples, couples>() +=
        length * modulus / trial * direction * gradient.transpose();
  }
}

/// The share of its limit that rounding leaves of a stress at the limit.
constexpr double kAtLimit = 1.0 - 1e-9;

template <class Stress>
void reduce(Stress& stress, double limit) {
  if (const double size = stress.norm(); size > limit) stress = limit * (stress / size).eval();
}

}  // namespace

template <int dim>
Pressures<dim> pressures_of(const typename Cosserat<dim>::Vector& stress) {
  if constexpr (dim == 2) {
    return Pressures<2>(pressure_of<2>(stress));
  } else {
    Eigen::Matrix3d symmetric;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        symmetric(i, j) =
            0.5 * (stress(Cosserat<3>::stress_place(i, j)) + stress(Cosserat<3>::stress_place(j, i)));
    return -0.5 * (symmetric.trace() * Eigen::Matrix3d::Identity() - symmetric);
  }
}

template <int dim>
double pressure_about(const Pressures<dim>& pressures, const typename Cosserat<dim>::Rotation& skew_stress) {
  if constexpr (dim == 2) {
    (void)skew_stress;
    return pressures(0, 0);
  } else {
    const double squared = skew_stress.squaredNorm();
    return squared > 0.0 ? skew_stress.dot(pressures * skew_stress) / squared : pressures.trace() / 3.0;
  }
}

template <int dim>
double pressure_about_couples(const Pressures<dim>& pressures,
                              const Eigen::Matrix<double, Cosserat<dim>::couples, 1>& couple_stress) {
  if constexpr (dim == 2) {
    (void)couple_stress;
    return pressures(0, 0);
  } else {
    const double squared = couple_stress.squaredNorm();
    if (!(squared > 0.0)) return pressures.trace() / 3.0;
    const Eigen::Matrix3d faces = by_face<dim>(couple_stress);
    return (faces * pressures).cwiseProduct(faces).sum() / squared;
  }
}

template <int dim>
typename Cosserat<dim>::Vector symmetric_part(const typename Cosserat<dim>::Vector& components) {
  typename Cosserat<dim>::Vector part = components;
  for (int k = 0; k < Cosserat<dim>::rotations; ++k) {
    const CouplePair at = pair_of<dim>(k);
    part(at.ij) = part(at.ji) = 0.5 * (components(at.ij) + components(at.ji));
  }
  part.template tail<Cosserat<dim>::couples>().setZero();
  return part;
}

template <int dim>
typename Cosserat<dim>::Matrix symmetric_tangent(const typename Cosserat<dim>::Matrix& cell) {
  constexpr int stresses = Cosserat<dim>::stresses;
  using Matrix = typename Cosserat<dim>::Matrix;
  using Vector = typename Cosserat<dim>::Vector;
  Matrix tangent = Matrix::Zero();
  tangent.template topLeftCorner<stresses, stresses>() = cell.template topLeftCorner<stresses, stresses>();
  for (int k = 0; k < Cosserat<dim>::rotations; ++k) {
    const CouplePair at = pair_of<dim>(k);
    const Vector row = 0.5 * (tangent.row(at.ij) + tangent.row(at.ji)).transpose();
    tangent.row(at.ij) = tangent.row(at.ji) = row.transpose();
    const Vector column = 0.5 * (tangent.col(at.ij) + tangent.col(at.ji));
    tangent.col(at.ij) = tangent.col(at.ji) = column;
  }
  return tangent;
}

double share_held(double trial, double limit) {
  constexpr double kFar = 3.0;
  return trial > kFar * limit ? std::max(CosseratPart<2>::kHold, limit / trial) : CosseratPart<2>::kHold;
}

template <int dim>
typename Cosserat<dim>::Rotation skew_stress_of(const typename Cosserat<dim>::Vector& stress) {
  Skew<dim> skew;
  for (int k = 0; k < Cosserat<dim>::rotations; ++k) {
    const CouplePair at = pair_of<dim>(k);
    skew(k) = stress(at.ji) - stress(at.ij);
  }
  return skew;
}

template <int dim>
bool limit_skew(Response<dim>& response, double skew_limit, double modulus) {
  constexpr int rotations = Cosserat<dim>::rotations;
  const Pressures<dim> pressures = pressures_of<dim>(response.stress);
  const Skew<dim> trial = skew_stress_of<dim>(response.stress);
  const double pressure = pressure_about<dim>(pressures, trial);
  const double limit = skew_limit * std::max(0.0, pressure);
  const double size = trial.norm();
  if (size <= limit) return false;
  const Skew<dim> direction = trial / size;

  SkewSlopes<dim> slopes = SkewSlopes<dim>::Zero();  // of the skew stress
  Slope<dim> rise = Slope<dim>::Zero();              // of the pressure
  if (pressure > 0.0) rise = slope_of_pressure<dim>(response.tangent, direction * direction.transpose());
  if constexpr (dim == 3) {  // the direction may turn, and the pressure about it with it
    SkewSlopes<dim> turning;
    for (int k = 0; k < rotations; ++k) {
      const CouplePair at = pair_of<dim>(k);
      turning.row(k) = response.tangent.row(at.ji) - response.tangent.row(at.ij);
    }
    turning = (turning - direction * (direction.transpose() * turning).eval()).eval() / size;
    slopes = limit * turning;
    if (pressure > 0.0) rise += 2.0 * (pressures * direction).transpose() * turning;
  }
  slopes += direction * skew_limit * rise;
  const double hold = 2.0 * share_held(size, limit) * modulus;
  for (int k = 0; k < rotations; ++k) {
    const CouplePair at = pair_of<dim>(k);
    slopes(k, at.ij) -= hold;
    slopes(k, at.ji) += hold;
    const double shear = 0.5 * (response.stress[at.ij] + response.stress[at.ji]);
    response.stress[at.ij] = shear - 0.5 * direction(k) * limit;
    response.stress[at.ji] = shear + 0.5 * direction(k) * limit;
    const Slope<dim> mean = 0.5 * (response.tangent.row(at.ij) + response.tangent.row(at.ji));
    response.tangent.row(at.ij) = mean - 0.5 * slopes.row(k);
    response.tangent.row(at.ji) = mean + 0.5 * slopes.row(k);
  }
  return true;
}

double share_of_limit(double stress, std::optional<double> limit, double pressure) {
  if (!limit || !(*limit * pressure > 0.0)) return 0.0;
  return std::min(1.0, stress / (*limit * pressure));
}

template <int dim>
LimitsReached CosseratPart<dim>::reached(const CosseratParameters& cosserat, double least) const {
  LimitsReached reached;
  reached.parted = pressure() <= least;
  const auto is_at = [&](double mobilisation, std::optional<double> limit) {
    return !reached.parted && limit && (*limit == 0.0 || mobilisation >= kAtLimit);
  };
  reached.skew = is_at(skew_mobilisation(cosserat), cosserat.skew_limit);
  reached.couple = is_at(couple_mobilisation(cosserat), cosserat.plastic_length);
  const bool no_skew = !(contacts_kept > 0.0) || (cosserat.skew_limit && (reached.parted || reached.skew));
  const bool no_couple =
      !(contacts_kept > 0.0) || (cosserat.plastic_length && (reached.parted || reached.couple));
  reached.held = cosserat.has_rotations && no_skew && no_couple;
  return reached;
}

template <int dim>
Response<dim> CosseratPart<dim>::follow(const Increment<dim>& increment, const Response<dim>& cell,
                                        const CosseratParameters& cosserat, double kept) {
  const fem::StretchAndTurn<dim> step = fem::stretch_and_turn(increment);
  const typename Dimension::Vector strain = step.stretch.strain();
  const double couple_modulus = contacts_kept * cosserat.couple_modulus();
  skew_stress += 2.0 * contacts_kept * cosserat.cosserat_shear_modulus * skew_stress_of<dim>(strain);  // A.4
  couple_stress += couple_modulus * strain.template tail<Dimension::couples>();                        // A.4
  if (increment.configuration != Configuration::fixed) {
    typename Dimension::Vector turned = Dimension::Vector::Zero();
    turned.template tail<Dimension::couples>() = couple_stress;
    couple_stress = fem::rotated(turned, step.turn).template tail<Dimension::couples>();
    if constexpr (dim == 3) skew_stress = step.turn * skew_stress;
  }
  Response<dim> response = joined_to(cell, cosserat);
  if (response.quality == Quality::failed) return response;
  if (cosserat.skew_limit) limit_skew<dim>(response, *cosserat.skew_limit, cosserat.cosserat_shear_modulus);
  if (cosserat.plastic_length) limit_couple<dim>(response, *cosserat.plastic_length, couple_modulus);
  keep_within(cosserat, pressures_of<dim>(response.stress));
  contacts_kept = kept;
  return response;
}

template <int dim>
void CosseratPart<dim>::keep_within(const CosseratParameters& cosserat, const Pressures<dim>& new_pressures) {
  pressures = new_pressures;
  const auto limit = [](double factor, double pressure) { return factor * std::max(0.0, pressure); };
  if (cosserat.skew_limit)
    reduce(skew_stress, limit(*cosserat.skew_limit, pressure_about<dim>(pressures, skew_stress)));
  if (cosserat.plastic_length)
    reduce(couple_stress,
           limit(*cosserat.plastic_length, pressure_about_couples<dim>(pressures, couple_stress)));
}

template <int dim>
Response<dim> CosseratPart<dim>::joined_to(const Response<dim>& cell,
                                           const CosseratParameters& cosserat) const {
  Response<dim> response = cell;
  if (response.quality == Quality::failed) return response;
  response.stress = symmetric_part<dim>(response.stress);
  response.stress.template tail<Dimension::couples>() = couple_stress;
  response.tangent = symmetric_tangent<dim>(response.tangent);
  const double skew_modulus = std::max(contacts_kept, kHold) * cosserat.cosserat_shear_modulus;
  for (int k = 0; k < Dimension::rotations; ++k) {
    const CouplePair at = pair_of<dim>(k);
    response.stress[at.ij] -= 0.5 * skew_stress(k);
    response.stress[at.ji] += 0.5 * skew_stress(k);
    response.tangent(at.ij, at.ij) += skew_modulus;
    response.tangent(at.ji, at.ji) += skew_modulus;
    response.tangent(at.ij, at.ji) -= skew_modulus;
    response.tangent(at.ji, at.ij) -= skew_modulus;
  }
  const double couple_modulus = contacts_kept * cosserat.couple_modulus();
  for (int place = Dimension::stresses; place < Dimension::components; ++place)
    response.tangent(place, place) = couple_modulus;
  return response;
}

template <int dim>
double CosseratPart<dim>::skew_mobilisation(const CosseratParameters& cosserat) const {
  return share_of_limit(skew_stress.norm(), cosserat.skew_limit, pressure_about<dim>(pressures, skew_stress));
}

template <int dim>
double CosseratPart<dim>::couple_mobilisation(const CosseratParameters& cosserat) const {
  return share_of_limit(couple_stress.norm(), cosserat.plastic_length,
                        pressure_about_couples<dim>(pressures, couple_stress));
}

template struct CosseratPart<2>;
template struct CosseratPart<3>;
template Pressures<2> pressures_of<2>(const Vector7&);
template Pressures<3> pressures_of<3>(const Vector18&);
template Vector7 symmetric_part<2>(const Vector7&);
template Vector18 symmetric_part<3>(const Vector18&);
template Matrix7 symmetric_tangent<2>(const Matrix7&);
template Matrix18 symmetric_tangent<3>(const Matrix18&);
template double pressure_about<2>(const Pressures<2>&, const Skew<2>&);
template double pressure_about<3>(const Pressures<3>&, const Skew<3>&);
template double pressure_about_couples<2>(const Pressures<2>&, const Couples<2>&);
template double pressure_about_couples<3>(const Pressures<3>&, const Couples<3>&);
template Skew<2> skew_stress_of<2>(const Vector7&);
template Skew<3> skew_stress_of<3>(const Vector18&);
template bool limit_skew<2>(Response<2>&, double, double);
template bool limit_skew<3>(Response<3>&, double, double);

}  // namespace polargrain::coupler
