// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "app/layer/shearing.hpp"

namespace polargrain::app {

/// Columns with the cells of one packing, for every pair of candidates of a description: lc and lp, lc alone, or a spread.
struct Candidates {
  std::vector<double> first;   ///< lengths, rising, in any one unit
  std::vector<double> second;  ///< lengths, rising; empty: figures[i] has one entry
  std::vector<std::vector<LayerFigures>> figures;
};

/// The lengths whose column is most like the layers of grains.
struct FoundLengths {
  double first = 0.0;
  std::optional<double> second;
  double misfit = 0.0;   ///< root of the mean square of the differences below
  bool at_edge = false;  ///< at the first or last candidate: the true ones may be beyond
  LayerFigures figures;  ///< of such a column, interpolated: halfway, end and thickness
};

/// Thickness (its logarithm), halfway and end of columns against their means over the layers, in standard deviations of a layer; between
/// candidates they are bilinear in the logarithms of the lengths, which are tried in hundredths of the way between candidates.
/// @param layers at least two
FoundLengths lengths_like(const std::vector<LayerFigures>& layers, const Candidates& candidates);

}  // namespace polargrain::app
