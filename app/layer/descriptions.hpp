// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "app/layer/lengths.hpp"
#include "app/layer/options.hpp"

namespace polargrain::app {

/// How columns of cells get a thickness: the lengths that are sought, and those found with each packing of cells.
struct Description {
  std::string name;
  std::vector<double> first, second;  ///< candidates
  bool spreads = false;               ///< slips, over the first length
  std::vector<FoundLengths> found = {};

  [[nodiscard]] std::size_t columns() const;
  [[nodiscard]] std::vector<double> misfits() const;
  /// Packings of cells whose best lengths are the first or last candidates.
  [[nodiscard]] int at_edge() const;
};

/// lc alone, lc and lp, and a spread of slips, as far as they are asked for.
std::vector<Description> descriptions_of(const LayerOptions& options);

/// The name of the description whose misfit is less than all others', packing by packing of cells, by more than the 95 %
/// interval of the difference; `undecided` when all differences are smaller.
std::string preferred(const std::vector<Description>& descriptions);

/// Misfits with their intervals, how much larger than the least one they are, and which description is preferred.
std::string comparison_of(const std::vector<Description>& descriptions);

}  // namespace polargrain::app
