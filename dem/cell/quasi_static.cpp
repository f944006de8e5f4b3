// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/cell/quasi_static.hpp"

#include <algorithm>
#include <cmath>

#include "common/error.hpp"
#include "dem/cell/averages.hpp"

namespace polargrain::dem {

namespace {

/// DEM steps between two looks at the contacts.
constexpr int kChunk = 20;

/// Share of the mean contact force of the packing that unbalanced forces are compared with at least. Grains
/// that press on each other less than that carry nothing that counts: without it a cell whose stress has gone
/// to zero could never be at rest, as what grains that barely touch are out of balance is all the force there
/// is.
constexpr double kLeastForce = 1e-3;

}  // namespace

std::vector<double> rotation_weights(std::span<const Contact> contacts, int grains) {
  std::vector<double> weights(static_cast<std::size_t>(grains), 0.0);
  std::vector<int> count(weights.size(), 0);
  for (const Contact& contact : contacts) {
    const double force = std::max(0.0, contact.normal_force());
    weights[contact.first] += contact.arm_first * force;
    weights[contact.second] += contact.arm_second * force;
    ++count[contact.first];
    ++count[contact.second];
  }
  double sum = 0.0;
  for (std::size_t k = 0; k < weights.size(); ++k) sum += weights[k] = count[k] < 2 ? 0.0 : weights[k];
  if (!(sum > 0.0)) weights.clear();
  for (double& weight : weights) weight /= sum;
  return weights;
}

Unbalanced unbalanced(const Imbalance& imbalance, std::span<const Contact> contacts, double mean_radius,
                      double least_force) {
  std::vector<bool> touched(static_cast<std::size_t>(imbalance.grains), false);
  for (const Contact& contact : contacts)
    touched[static_cast<std::size_t>(contact.first)] = touched[static_cast<std::size_t>(contact.second)] =
        true;
  Unbalanced found;
  found.carrying = static_cast<double>(std::count(touched.begin(), touched.end(), true));
  const double force = std::max(mean_contact_force(contacts), least_force);
  if (contacts.empty() || !(force > 0.0)) return found;
  found.force_ratio = imbalance.force / found.carrying / force;
  found.moment_ratio = imbalance.moment / found.carrying / (force * mean_radius);
  return found;
}

Equilibrium equilibrium_of(std::span<const Contact> contacts, const Imbalance& imbalance, double mean_radius,
                           double least_force, double box, double grain_sizes) {
  Equilibrium found;
  found.void_ratio = box / grain_sizes - 1.0;
  const Unbalanced ratios = unbalanced(imbalance, contacts, mean_radius, least_force);
  found.unbalanced_force_ratio = ratios.force_ratio;
  found.unbalanced_moment_ratio = ratios.moment_ratio;
  found.rattlers = 1.0 - ratios.carrying / imbalance.grains;
  found.coordination_number = 2.0 * static_cast<double>(contacts.size()) / imbalance.grains;
  return found;
}

void QuasiStatic::take_scales(const MeanGrain& grain, std::span<const Contact> at_rest, double pressure) {
  mean_radius_ = grain.radius;
  time_of_grain_ = 2.0 * grain.radius * std::sqrt(grain.density / pressure);
  damping_rate_ = 2.0 * control_.damping * std::sqrt(mean_normal_stiffness(at_rest) / grain.mass);
  least_force_ = kLeastForce * mean_contact_force(at_rest);
}

template <int dim>
Lead<dim> QuasiStatic::begin(const Box<dim>& box, const Increment<dim>& increment, double time_step) {
  const BoxPath<dim> whole({Box<dim>::Matrix::Identity()}, increment.displacement_gradient, 1);
  begin(largest_principal_strain(whole), RotationLoading<dim>::of(increment).against(whole).norm(),
        increment.curvature.norm(), time_step);
  return {BoxPath<dim>(box, increment.displacement_gradient, loading_), rotation_of(increment)};
}
template Lead<2> QuasiStatic::begin(const Box<2>&, const Increment<2>&, double);
template Lead<3> QuasiStatic::begin(const Box<3>&, const Increment<3>&, double);

void QuasiStatic::begin(double strain, double turn, double curvature, double time_step) {
  size_ = strain;
  if (controlled()) {
    // Grains that turn against the continuum slide on each other as fast as a shear strain of that size makes
    // them; a curvature turns them against each other by that times their distance.
    size_ = std::max({size_, turn, curvature * (2.0 * mean_radius_)});
  }
  const double steps = std::ceil(size_ * time_of_grain_ / (control_.inertial_number * time_step));
  if (!(steps < 1e9)) throw RunError("the increment asks for more than 1e9 DEM steps");
  loading_ = std::max(control_.least_steps, static_cast<int>(steps));
  done_ = 0;
}

int QuasiStatic::steps_to_next_look() const {
  if (loaded()) return kChunk - relaxed() % kChunk;
  const int left = loading_ - done_;
  return controlled() ? std::min(kChunk - done_ % kChunk, left) : left;
}

bool QuasiStatic::looks_now() const {
  return done_ == loading_ || (loaded() ? relaxed() : done_) % kChunk == 0;
}

QuasiStatic::ReadOut QuasiStatic::read_out(std::span<const Contact> contacts, const Eigen::Matrix3d& frame,
                                           double volume) const {
  ReadOut found;
  found.stress = frame * average_stress(contacts, volume) * frame.transpose();
  if (controlled()) found.couple_stress = frame * average_couple_stress(contacts, volume) * frame.transpose();
  return found;
}

}  // namespace polargrain::dem
