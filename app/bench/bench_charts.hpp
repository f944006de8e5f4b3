// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string>
#include <vector>

#include "app/bench/bench_table.hpp"

namespace polargrain::app {

/// Error against seconds as a chart of a page, both axes logarithmic: a disc a run, a square a packing that
/// bench made and a large one the mean of a size; a broken line where the scatter of a size lies.
/// @param y which of the curves @returns empty while there is nothing to show
std::string error_chart(std::size_t y, const std::vector<BenchResult>& results,
                        const std::vector<SizeScatter>& sizes);

/// The curves themselves, the reference first. @returns empty while there is nothing to show
std::string curve_chart(std::size_t y, const BenchAxes& axes, const std::vector<BenchResult>& results);

}  // namespace polargrain::app
