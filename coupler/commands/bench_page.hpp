// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string>
#include <vector>

#include "coupler/commands/bench_results.hpp"

namespace polargrain::coupler {

/// The results as one HTML page without any other file: a plot of error against seconds for each y, both axes
/// logarithmic, and the table. @param y names of the curves, as in BenchResult::curves
std::string bench_page(const std::string& title, const std::string& x, const std::vector<std::string>& y,
                       const std::vector<BenchResult>& results);

/// The table of the page as Markdown, for standard output and a README.
std::string bench_table(const std::vector<std::string>& y, const std::vector<BenchResult>& results);

}  // namespace polargrain::coupler
