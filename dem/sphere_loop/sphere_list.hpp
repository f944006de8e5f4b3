// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "dem/lanes/line_vector.hpp"
#include "dem/sphere_loop/sphere_pass.hpp"

namespace polargrain::dem {

/// A lattice vector p b_1 + q b_2 + r b_3 of the periodic box.
struct SpaceLattice {
  std::int32_t p = 0, q = 0, r = 0;
  bool operator==(const SpaceLattice&) const = default;
  [[nodiscard]] bool is_home() const { return p == 0 && q == 0 && r == 0; }
  [[nodiscard]] Eigen::Vector3d of(const Eigen::Matrix3d& base) const {
    return base * Eigen::Vector3d(p, q, r);
  }
};

/// Which copy of the box a place lies in. @param inverse of the base vectors, 1/m
/// @throws RunError when it is so far away, or nowhere, that this cannot be told: the grains are lost
SpaceLattice copy_at(const Eigen::Matrix3d& inverse, const Eigen::Vector3d& place);

/// Two spheres that may touch. @param gap m
struct SpherePair {
  int first = 0, second = 0, image = 0;
  double gap = 0.0;
};
/// Pairs in the zones of a SpherePass; those that are near in order of their gaps.
using SphereZones = std::array<std::vector<SpherePair>, 4>;

/// Springs of contacts on their way from one list of pairs to the next, or from a state into a list.
struct CarriedSprings {
  struct Contact {
    int first = 0, second = 0;
    SpaceLattice image;
  };
  std::vector<Contact> contacts;
  std::vector<double> values;  ///< `spring_count` of each
};

/// Pairs of spheres of a periodic box whose surfaces are nearer than a skin, each pair once, in the zones of
/// SpherePass. The order depends on the positions alone.
struct SphereList {
  LineVector<int> first, second, image;  ///< of the candidates; grains from `grains` on are dummies
  /// The same in numbers of the rows that a SpherePass reads: no address asks for a product.
  LineVector<unsigned> first_row, second_row, image_row;
  LineVector<double> radius_first, radius_second;              ///< m
  std::array<LineVector<double>, kSphereConstants> constants;  ///< empty where no law asks for them
  std::array<LineVector<double>, kSphereSprings> springs;      ///< zero without contact
  std::vector<SpaceLattice> images;  ///< that occur; the first one is the box itself
  std::vector<double> gaps;          ///< least of each block, m
  std::vector<unsigned char> active;
  int grains = 0;
  int spring_count = 0;  ///< of them are in use
  int touching = 0, interior = 0, touching_across = 0, count = 0;

  /// Finds the pairs; springs are zero.
  /// @param rows of the grains, places and radii (kGrainStride) @param base columns are the base vectors, m
  /// @param skin largest gap taken, m @throws RunError as copy_at
  void find(const double* rows, int grains, const Eigen::Matrix3d& base, double skin);
  /// Takes pairs that are known; springs are zero. Each zone is filled up with dummies.
  /// @param rows of the grains, places and radii (kGrainStride)
  void take(SphereZones zones, const double* rows, int grains);
  /// Whether one of the first `how_many` springs of a candidate is not zero. Dummies do not count.
  [[nodiscard]] bool is_stressed(int candidate, int how_many) const;
  /// The springs of contacts that have any.
  [[nodiscard]] CarriedSprings carried() const;
  /// Puts them to the pairs that touch; the others have parted, and forget.
  void take_springs(const CarriedSprings& carried);
};

}  // namespace polargrain::dem
