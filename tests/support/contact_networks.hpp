// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cmath>
#include <random>
#include <vector>

#include "common/packing.hpp"
#include "dem/contact/contact_recorder.hpp"

namespace polargrain::test {

/// `times` x `times` copies of a packing side by side.
inline Packing tiled(const Packing& one, int times) {
  Packing many = one;
  many.grains.clear();
  many.box = times * one.box;
  for (int i = 0; i < times; ++i)
    for (int j = 0; j < times; ++j)
      for (Grain grain : one.grains) {
        grain.position += one.box * Eigen::Vector2d(i, j);
        grain.id = static_cast<std::int64_t>(many.grains.size());
        many.grains.push_back(grain);
      }
  return many;
}

/// How contacts without an engine get their tangential forces and moments: by lot.
struct Mobilisation {
  double sliding = 0.0;  ///< fraction of contacts at the Coulomb limit, either sense
  double rolling = 0.0;  ///< fraction of contacts at the rolling limit, either sense
  unsigned seed = 1;
};

/// A contact of two discs with linear springs (k_n about 1e6 N/m, friction 0.55, rolling limit 0.4 R* f_n).
inline dem::Contact contact_of(int first, int second, const Eigen::Vector2d& branch, double radius_first,
                               double radius_second, const Mobilisation& mobilisation, std::mt19937& random) {
  const auto lot = [&random] {
    return static_cast<double>(random()) / static_cast<double>(std::mt19937::max());
  };
  dem::Contact contact;
  contact.first = first;
  contact.second = second;
  contact.branch.head<2>() = branch;
  const double overlap = radius_first + radius_second - branch.norm();
  const double radius = radius_first * radius_second / (radius_first + radius_second);
  contact.normal_stiffness = 1e6 * (1.0 + 0.1 * lot());
  contact.tangential_stiffness = 5e5;
  contact.rolling_stiffness = contact.tangential_stiffness * radius * radius;
  contact.arm_first = radius_first - 0.5 * overlap;
  contact.arm_second = radius_second - 0.5 * overlap;
  contact.friction = 0.55;
  const double normal_force = contact.normal_stiffness * overlap;
  const bool sliding = lot() < mobilisation.sliding;
  const double sense = lot() < 0.5 ? -1.0 : 1.0;
  const double tangential_force = sense * contact.friction * normal_force * (sliding ? 1.0 : 0.9 * lot());
  const Eigen::Vector3d n = contact.normal();
  contact.force = -normal_force * n + tangential_force * Eigen::Vector3d(-n.y(), n.x(), 0.0);
  contact.rolling_at_limit = lot() < mobilisation.rolling;
  contact.moment.z() = (lot() < 0.5 ? -0.4 : 0.4) * radius * normal_force;
  return contact;
}

/// The contacts of discs that overlap, in a right box.
inline std::vector<dem::Contact> contacts_of(const Packing& packing, const Mobilisation& mobilisation) {
  std::mt19937 random(mobilisation.seed);
  std::vector<dem::Contact> contacts;
  const int grains = static_cast<int>(packing.grains.size());
  for (int second = 0; second < grains; ++second)
    for (int first = 0; first < second; ++first) {
      const Grain& one = packing.grains[first];
      const Grain& other = packing.grains[second];
      Eigen::Vector2d branch = other.position - one.position;
      for (int k = 0; k < 2; ++k) branch(k) -= packing.box(k, k) * std::round(branch(k) / packing.box(k, k));
      if (branch.norm() < one.radius + other.radius)
        contacts.push_back(contact_of(first, second, branch, one.radius, other.radius, mobilisation, random));
    }
  return contacts;
}

}  // namespace polargrain::test
