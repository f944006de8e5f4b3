// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cstddef>
#include <filesystem>
#include <vector>

#include "band/sample.hpp"

namespace polargrain::band {

/// How the files of an image correlation are written.
struct FieldUnits {
  double length =
      1.0;  ///< m that 1 in the files stands for, > 0: the size of a pixel, where they are in pixels
  bool y_down = false;  ///< y and v point down, as in images; turned up when they are read
};

/// Displacements of the places of a body, as image correlation gives them.
struct DisplacementField {
  std::vector<Eigen::Vector2d> positions;      ///< in the reference image, m, each once
  std::vector<Eigen::Vector2d> displacements;  ///< m; both NaN where the correlation found no displacement
  std::size_t missing = 0;                     ///< places without a displacement
};

/// A CSV file with the columns x, y, u, v (others are skipped). An empty cell or "nan" in u or v: no displacement was
/// found there.
/// @throws InputError naming file and line: of a column or number that is not there, of a place that stands there twice
DisplacementField read_displacement_field(const std::filesystem::path& file, const FieldUnits& units);

/// The change between two fields over the same reference image, whose rows may be in any order.
struct FieldIncrement {
  std::vector<Eigen::Vector2d> positions;      ///< m, of the places that have both displacements
  std::vector<Eigen::Vector2d> before;         ///< displacements at the beginning, m
  std::vector<Eigen::Vector2d> displacements;  ///< of the increment, m
  std::size_t missing = 0;  ///< places that one of the fields or both have no displacement of
};

/// @param from null: everything stood at rest in its place
FieldIncrement increment_between(const DisplacementField* from, const DisplacementField& to);

/// Strains of an increment, by the displacement gradients at its places (local_strain.hpp); `rotation` is that of the field,
/// (h21 - h12) / 2.
/// @param radius of the neighbourhood that a strain is taken from, m; 0: kNeighbourhood mean distances of the places
/// @param current places stand where they are at the beginning of the increment, not in the reference image
/// @throws std::invalid_argument when there are places, and they fill no area
Samples samples_of(const FieldIncrement& increment, double radius, bool current);

}  // namespace polargrain::band
