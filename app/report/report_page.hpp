// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "app/report/run_result.hpp"

namespace polargrain::app {

struct ReportContent {
  std::string x;  ///< value along the curves; empty: a monitor with "strain" in its name, or the time
  std::vector<std::string> fields;  ///< to be shown on the mesh; empty: the usual ones that are there
  /// HTML that shows grains of a result; empty: no grains are shown.
  std::function<std::string(const RunResult&)> grains = {};
  int refresh_seconds = 0;  ///< the page is loaded anew so often; 0: never
};

/// A page that shows these runs, each curve of all of them in one chart.
/// @param results at least one
/// @throws InputError when a value or a field that is asked for is not there
std::string report_page(const std::vector<RunResult>& results, const ReportContent& content);

}  // namespace polargrain::app
