// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/adaptivity/grain_measure.hpp"

#include <cmath>

#include "coupler/cells/cosserat_part.hpp"
#include "fem/material/rotation.hpp"

namespace polargrain::coupler {
namespace {

/// Weight of a volume change; the square root of its share of the curvature of the response in shear.
constexpr double kVolume = 0.35;

}  // namespace

template <int dim>
typename GrainMeasure<dim>::Vector GrainMeasure<dim>::strain(const Increment<dim>& increment) const {
  Vector strain = fem::stretch_and_turn(increment).stretch.strain();
  if (!controlled()) return symmetric_part<dim>(strain);
  strain.template tail<Cosserat<dim>::couples>() *= diameter_;
  return strain;
}

template <int dim>
typename GrainMeasure<dim>::Vector GrainMeasure<dim>::unmeasured(const Vector& strain) const {
  Vector plain = strain;
  if (controlled()) plain.template tail<Cosserat<dim>::couples>() /= diameter_;
  return plain;
}

template <int dim>
double GrainMeasure<dim>::size(const Increment<dim>& offset) const {
  Vector deviator = strain(offset);
  double sum = 0.0;
  for (int i = 0; i < dim; ++i) sum += deviator(Cosserat<dim>::stress_place(i, i));
  const double volume = sum / dim;
  for (int i = 0; i < dim; ++i) deviator(Cosserat<dim>::stress_place(i, i)) -= volume;
  return std::sqrt(deviator.squaredNorm() + dim * kVolume * kVolume * volume * volume);
}

template <>
double GrainMeasure<2>::stress(const Vector7& stress) const {
  const double shear = 0.5 * (stress[k12] + stress[k21]);
  double squared = stress[k11] * stress[k11] + stress[k22] * stress[k22] + 2.0 * shear * shear;
  if (controlled()) {
    const double skew = 0.5 * (stress[k21] - stress[k12]);
    squared += 2.0 * skew * skew + stress.tail<2>().squaredNorm() / (diameter_ * diameter_);
  }
  return std::sqrt(squared);
}

template <>
double GrainMeasure<3>::stress(const Vector18& stress) const {
  double squared = symmetric_part<3>(stress).squaredNorm();
  if (controlled())
    squared += 0.5 * skew_stress_of<3>(stress).squaredNorm() +
               stress.tail<9>().squaredNorm() / (diameter_ * diameter_);
  return std::sqrt(squared);
}

template class GrainMeasure<2>;
template class GrainMeasure<3>;

}  // namespace polargrain::coupler
