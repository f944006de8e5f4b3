// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string>
#include <vector>

#include "app/bench/bench_table.hpp"

namespace polargrain::app {

/// The results as one HTML page without any other file: for each y a chart of error against seconds and one of
/// the curves, and the table.
std::string bench_page(const std::string& title, const BenchAxes& axes,
                       const std::vector<BenchResult>& results, const std::vector<SizeScatter>& sizes,
                       const BenchTable& bench);

}  // namespace polargrain::app
