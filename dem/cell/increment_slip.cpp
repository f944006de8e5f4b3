// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/cell/increment_slip.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <tuple>

#include "common/elementary_functions.hpp"
#include "dem/cell/averages.hpp"

namespace polargrain::dem {

namespace {

Eigen::Vector3d turn_of(std::span<const double> rotations, int grain) {
  if (rotations.empty()) return Eigen::Vector3d::Zero();
  return Eigen::Map<const Eigen::Vector3d>(&rotations[3 * static_cast<std::size_t>(grain)]);
}

}  // namespace

double spring_left_along(double slip, double unloaded) {
  return slip > 0.0 ? unloaded / (slip + unloaded) : 1.0;
}

double spring_left_across(double slip, double limit) {
  const double x = slip / limit;
  constexpr double kTiny = 1e-8;  // below, 1 - exp(-x) loses its digits
  return x > kTiny ? (1.0 - exponential(-x)) / x : 1.0;
}

IncrementSlip::Springs IncrementSlip::springs_of(const Contact& contact, const Eigen::Matrix3d& frame) {
  Springs springs;
  springs.first = contact.first;
  springs.second = contact.second;
  springs.branch = frame * contact.branch;
  const Eigen::Vector3d n = springs.branch.normalized();
  const Eigen::Vector3d force = frame * contact.force;
  const Eigen::Vector3d moment = frame * contact.moment;
  const double torsion = moment.dot(n);
  springs.sliding.setZero();
  springs.rotation.setZero();
  if (contact.tangential_stiffness > 0.0)
    springs.sliding = (force - force.dot(n) * n) / contact.tangential_stiffness;
  if (contact.rolling_stiffness > 0.0) springs.rotation = (moment - torsion * n) / contact.rolling_stiffness;
  if (contact.torsion_stiffness > 0.0) springs.rotation += torsion / contact.torsion_stiffness * n;
  return springs;
}

void IncrementSlip::start(std::span<const Contact> contacts, const double* positions,
                          std::span<const double> rotations, const Box<3>& box, int grains) {
  box_ = box;
  places_.clear();
  turns_.clear();
  for (int grain = 0; grain < grains; ++grain) {
    places_.push_back(box.orientation *
                      Eigen::Map<const Eigen::Vector3d>(positions + 3 * static_cast<std::ptrdiff_t>(grain)));
    turns_.push_back(turn_of(rotations, grain));
  }
  springs_.clear();
  for (const Contact& contact : contacts) springs_.push_back(springs_of(contact, box.orientation));
  std::stable_sort(springs_.begin(), springs_.end(), [](const Springs& a, const Springs& b) {
    return std::tie(a.first, a.second) < std::tie(b.first, b.second);
  });
}

const IncrementSlip::Springs* IncrementSlip::found(const Contact& contact,
                                                   const Eigen::Vector3d& branch) const {
  const std::pair pair(contact.first, contact.second);
  auto at = std::lower_bound(
      springs_.begin(), springs_.end(), pair,
      [](const Springs& a, const std::pair<int, int>& b) { return std::pair(a.first, a.second) < b; });
  for (; at != springs_.end() && std::pair(at->first, at->second) == pair; ++at)
    if ((at->branch - branch).norm() < 0.5 * branch.norm()) return &*at;
  return nullptr;
}

std::vector<SpaceSlip> IncrementSlip::until(std::span<const Contact> contacts,
                                            std::span<const double> rotations, const Box<3>& box,
                                            const Eigen::Matrix3d& curvature) const {
  const Eigen::Matrix3d base = box_.orientation * box_.base;
  const Eigen::Matrix3d images = box_.inverse() * box_.orientation.transpose();
  const Eigen::Matrix3d back = base * box.inverse() * box.orientation.transpose();
  std::vector<SpaceSlip> slips;
  slips.reserve(contacts.size());
  for (const Contact& contact : contacts) {
    const Springs now = springs_of(contact, box.orientation);
    const Eigen::Vector3d n = now.branch.normalized();
    const auto first = static_cast<std::size_t>(contact.first);
    const auto second = static_cast<std::size_t>(contact.second);
    // The image of the second grain that the box has carried along to where it is now.
    Eigen::Vector3d before = places_[second] - places_[first];
    const Eigen::Vector3d away = images * (back * now.branch - before);
    before += base * Eigen::Vector3d(std::round(away.x()), std::round(away.y()), std::round(away.z()));

    // As the contact laws see the spins: with those of the curvature, from the middle of the branch.
    const Eigen::Vector3d half = 0.5 * curvature * now.branch;
    const Eigen::Vector3d turn_first = turn_of(rotations, contact.first) - turns_[first] - half;
    const Eigen::Vector3d turn_second = turn_of(rotations, contact.second) - turns_[second] + half;
    Eigen::Vector3d opening =
        now.branch - before + n.cross(contact.arm_first * turn_first + contact.arm_second * turn_second);
    Eigen::Vector3d turning = turn_second - turn_first;
    if (const Springs* then = found(contact, before)) {
      opening += then->sliding;
      turning += then->rotation;
    } else {
      const double overlap =
          contact.normal_stiffness > 0.0 ? contact.normal_force() / contact.normal_stiffness : 0.0;
      const double nearer = before.norm() - now.branch.norm();
      const double share = overlap > 0.0 && nearer > overlap ? overlap / nearer : 1.0;
      opening *= share;
      turning *= share;
    }
    opening -= now.sliding;
    turning -= now.rotation;
    SpaceSlip& slip = slips.emplace_back();
    const double twist = turning.dot(n);
    if (contact.tangential_stiffness > 0.0) slip.sliding = (opening - opening.dot(n) * n).norm();
    if (contact.rolling_stiffness > 0.0) slip.bending = (turning - twist * n).norm();
    if (contact.torsion_stiffness > 0.0) slip.torsion = std::abs(twist);
  }
  return slips;
}

}  // namespace polargrain::dem
