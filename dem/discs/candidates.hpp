// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "dem/discs/disc.hpp"

namespace polargrain::dem {

/// Two discs that may touch before the list is made anew: the disc of the row and this one, seen at
/// `images[image]`.
struct Candidate {
  std::int32_t second = 0;
  std::uint16_t image = 0;  ///< place in CandidateList::images
  std::uint16_t kind = 0;   ///< place in the table of parameters by pair of types
  double harmonic = 0.0;    ///< r_1 r_2 / (r_1 + r_2), m
};

/// Which copy of the box a place lies in. @param inverse of the base vectors, 1/m
/// @throws RunError when it is so far away, or nowhere, that this cannot be told: the grains are lost
LatticeVector copy_at(const Eigen::Matrix2d& inverse, double x, double y);

/// Pairs of discs of a periodic box whose surfaces are nearer than a skin, each pair once, by rows of the disc
/// with the lower number. The order depends on the positions alone.
struct CandidateList {
  std::vector<std::int32_t> rows;  ///< candidates of disc i: rows[i] to rows[i + 1]
  std::vector<Candidate> pairs;
  std::vector<LatticeVector> images;  ///< that occur; the first one is (0, 0)
  int springs = 0;                    ///< values a pair
  std::vector<double> values;         ///< springs of the contacts, `springs` a pair; zero without contact

  /// Finds the pairs.
  /// @param types of the discs, from 0; @param kinds types there are
  /// @param base columns are the base vectors of the box, m; @param skin largest gap taken, m
  /// @throws RunError as copy_at
  void find(std::span<const Disc> discs, std::span<const int> types, int kinds, const Eigen::Matrix2d& base,
            double skin);
  /// Takes over the springs of the pairs that another list has too.
  void take_springs(const CandidateList& other);
};

}  // namespace polargrain::dem
