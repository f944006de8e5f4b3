// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "app/layer/shearing.hpp"

namespace polargrain::app {

/// Columns with the cells of one packing, for every pair of candidates: `figures[i][j]` has lc `internal[i]` and lp `plastic[j]`.
struct Candidates {
  std::vector<double> internal;  ///< rising, in any one unit
  std::vector<double> plastic;   ///< rising; empty: no limit, and figures[i] has one entry
  std::vector<std::vector<LayerFigures>> figures;
};

/// The lengths whose column is most like the layers of grains.
struct FoundLengths {
  double internal = 0.0;
  std::optional<double> plastic;
  double misfit = 0.0;   ///< root of the mean square of the differences below
  bool at_edge = false;  ///< at the first or last candidate: the true ones may be beyond
  LayerFigures figures;  ///< of such a column, interpolated: halfway, end and thickness
};

/// Thickness (its logarithm), halfway and end of columns against their means over the layers, in standard deviations of a layer; between
/// candidates they are bilinear in the logarithms of the lengths, which are tried in hundredths of the way between candidates.
/// @param layers at least two
FoundLengths lengths_like(const std::vector<LayerFigures>& layers, const Candidates& candidates);

}  // namespace polargrain::app
