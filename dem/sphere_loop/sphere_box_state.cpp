// SPDX-License-Identifier: GPL-2.0-or-later
// States of a box of spheres: from a snapshot, and back.
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "common/error.hpp"
#include "dem/sphere_loop/sphere_box.hpp"

namespace polargrain::dem {

namespace {
using Place = Eigen::Map<Eigen::Vector3d>;
using ConstPlace = Eigen::Map<const Eigen::Vector3d>;
}  // namespace

void SphereBox::restore(const State& state) {
  restore(decode_snapshot<3>(state));
}

void SphereBox::restore(const Snapshot<3>& snapshot) {
  if (snapshot.grains.size() != spheres_.radii.size() || snapshot.code != spheres_.combination.code() ||
      snapshot.springs != springs_)
    throw RunError("this state belongs to a cell of another packing or another input script");
  if (const std::string fault = snapshot_fault(snapshot, spheres_.radii, time_step_); !fault.empty())
    throw RunError(fault);
  for (std::size_t k = 0; k < snapshot.grains.size(); ++k) {
    const GrainMotion<3>& from = snapshot.grains[k];
    double* const grain = &grains_[k * kGrainStride];
    std::copy(from.place.begin(), from.place.end(), grain);
    std::copy(from.velocity.begin(), from.velocity.end(), grain + 4);
    std::copy(from.spin.begin(), from.spin.end(), grain + 8);
    std::copy(from.turned.begin(), from.turned.end(), &turned_[k * 4]);
  }
  motion_ = BoxMotion<3>(BoxPath<3>(snapshot.box), std::nullopt, 1.0);
  CarriedSprings carried;
  carried.contacts.reserve(snapshot.contacts.size());
  carried.values.reserve(snapshot.contacts.size() * static_cast<std::size_t>(list_.spring_count));
  for (std::size_t c = 0; c < snapshot.contacts.size(); ++c) {
    const Snapshot<3>::Springs& contact = snapshot.contacts[c];
    carried.contacts.push_back(
        {contact.first, contact.second, {contact.image[0], contact.image[1], contact.image[2]}});
    for (int k = 0; k < list_.spring_count; ++k)
      carried.values.push_back(k < springs_ ? snapshot.values[c * static_cast<std::size_t>(springs_) + k]
                                            : 0.0);
  }
  find_candidates(carried);
}

void SphereBox::restore_moving(const State& state, const Eigen::Matrix3d& gradient,
                               const Eigen::Vector3d& spin) {
  restore(state);
  motion_.set_rates(gradient, spin);
}

StatePointer SphereBox::save_moving() {
  Snapshot<3> snapshot = decode_snapshot<3>(*save());
  for (std::size_t k = 0; k < snapshot.grains.size(); ++k) {
    GrainMotion<3>& sphere = snapshot.grains[k];
    const Eigen::Vector3d folded = ConstPlace(sphere.place.data()) - ConstPlace(&grains_[k * kGrainStride]);
    Place(sphere.velocity.data()) += motion_.gradient() * folded;
  }
  return encode(snapshot);
}

StatePointer SphereBox::save() {
  const Eigen::Matrix3d& old_base = motion_.box().base;
  Snapshot<3> snapshot;
  snapshot.box = motion_.box().reduced();
  snapshot.code = spheres_.combination.code();
  snapshot.springs = springs_;
  const Eigen::Matrix3d& base = snapshot.box.base;
  const Eigen::Matrix3d inverse = snapshot.box.inverse();
  // Base vectors of before in those of the reduced box: whole numbers.
  Eigen::Matrix3i whole;
  const Eigen::Matrix3d ratio = inverse * old_base;
  for (int k = 0; k < 9; ++k) whole(k) = static_cast<int>(std::lround(ratio(k)));

  std::vector<SpaceLattice> copies(spheres_.radii.size());
  snapshot.grains.resize(copies.size());
  for (std::size_t k = 0; k < copies.size(); ++k) {
    const double* const grain = &grains_[k * kGrainStride];
    copies[k] = copy_at(inverse, ConstPlace(grain));
    GrainMotion<3>& to = snapshot.grains[k];
    Place(to.place.data()) = ConstPlace(grain) - copies[k].of(base);
    std::copy_n(grain + 4, 3, to.velocity.data());
    std::copy_n(grain + 8, 3, to.spin.data());
    std::copy_n(&turned_[k * 4], 3, to.turned.data());
  }
  std::vector<int> order;  // candidates with springs, by their first sphere
  for (int c = 0; c < list_.count; ++c)
    if (list_.is_stressed(c, springs_)) order.push_back(c);
  std::stable_sort(order.begin(), order.end(),
                   [this](int a, int b) { return list_.first[a] < list_.first[b]; });
  for (const int c : order) {
    const SpaceLattice& image = list_.images[list_.image[c]];
    const SpaceLattice& home = copies[list_.first[c]];
    const SpaceLattice& away = copies[list_.second[c]];
    const Eigen::Vector3i seen = whole * Eigen::Vector3i(image.p, image.q, image.r) +
                                 Eigen::Vector3i(away.p - home.p, away.q - home.q, away.r - home.r);
    snapshot.contacts.push_back({list_.first[c], list_.second[c], {seen.x(), seen.y(), seen.z()}});
    for (int k = 0; k < springs_; ++k) snapshot.values.push_back(list_.springs[k][c]);
  }
  // A state that nobody could go on from is no answer.
  if (const std::string fault = snapshot_fault(snapshot, spheres_.radii, time_step_); !fault.empty())
    throw RunError(fault);
  return encode(snapshot);
}

}  // namespace polargrain::dem
