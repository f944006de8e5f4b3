// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string>
#include <vector>

#include "app/bench/bench_sizes.hpp"

namespace polargrain::app {

/// Error against seconds as an SVG image, both axes logarithmic: a circle a run, a square a packing that
/// bench made and a large one the mean of a size; a broken line where the scatter of a size lies.
/// @param y which of the curves @returns empty while there is nothing to show
std::string bench_plot(std::size_t y, const std::vector<BenchResult>& results,
                       const std::vector<SizeScatter>& sizes);

/// With what < > & and quotation marks mean in HTML taken away.
std::string escaped(const std::string& text);

}  // namespace polargrain::app
