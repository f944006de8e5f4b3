// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "dem/discs/disc.hpp"
#include "dem/lanes/line_vector.hpp"
#include "dem/laws/law_settings.hpp"

namespace polargrain::dem {

/// Which copy of the box a place lies in. @param inverse of the base vectors, 1/m
/// @throws RunError when it is so far away, or nowhere, that this cannot be told: the grains are lost
LatticeVector copy_at(const Eigen::Matrix2d& inverse, double x, double y);

/// Pairs of discs of a periodic box whose surfaces are nearer than a skin, each pair once, by rows of the disc
/// with the lower number. The order depends on the positions alone.
struct CandidateList {
  std::vector<std::int32_t> rows;  ///< candidates of disc i: rows[i] to rows[i + 1]
  LineVector<int> first, second;   ///< the discs of each candidate, the second one seen at
  LineVector<int> image;           ///< this place in `images`
  /// The same in numbers of the rows that a DiscPass reads: no address asks for a product.
  LineVector<unsigned> first_row, second_row, image_row;
  LineVector<int> kind;  ///< place in the table of parameters by pair of types
  LineVector<double> radius_first, radius_second, harmonic;  ///< of the discs, and r_1 r_2 / (r_1 + r_2), m
  LineVector<long long>
      continues;  ///< all bits set where the candidate before has the same first disc, else zero
  std::vector<LatticeVector> images;                     ///< that occur; the first one is (0, 0)
  int spring_count = 0;                                  ///< of the springs of a contact that are in use
  std::array<LineVector<double>, kDiscSprings> springs;  ///< of the contacts; zero without contact
  LineVector<DiscForce> row_sums;                        ///< of the discs, for the pass over the contacts

  /// Finds the pairs, and fills up whole blocks (DiscPass) behind the last row with pairs at an image of their own, the
  /// one behind `images`; springs are zero.
  /// @param types of the discs, from 0; @param kinds types there are
  /// @param base columns are the base vectors of the box, m; @param skin largest gap taken, m
  /// @throws RunError as copy_at
  void find(std::span<const Disc> discs, std::span<const int> types, int kinds, const Eigen::Matrix2d& base,
            double skin);
  /// Takes over the springs of the pairs that another list has too.
  void take_springs(const CandidateList& other);
  /// Empties the list. Pairs with springs may then be added in the order of their rows, and the rows of all discs be
  /// closed: for lists that only hand springs over.
  void clear();
  void add(int first, int second, const LatticeVector& image, const double* springs);
  void close_rows(std::size_t discs);
  /// Whether any spring of a candidate is not zero.
  [[nodiscard]] bool is_stressed(int candidate) const;
};

}  // namespace polargrain::dem
