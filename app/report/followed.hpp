// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string>
#include <vector>

#include "app/report/run_result.hpp"

namespace polargrain::app {

/// Names of values that some of the runs have, without `x`: those that a case lists in its `output: table` first, then the
/// other monitors, then what every run has.
struct FollowedNames {
  std::vector<std::string> listed;  ///< in the table of a case; all of them where no run has a summary yet
  std::vector<std::string> others;
};
FollowedNames followed_names(const std::vector<RunResult>& results, const std::string& x);

/// "N/m"; empty: without one, or not known. Runs agree on it, or it is not known.
std::string unit_of_value(const std::vector<RunResult>& results, const std::string& name);

/// The x axis of curves: a strain by its name, else a displacement, that all runs have and that did change; of the table
/// first, then of the other values. Else `time`.
std::string value_moved(const std::vector<RunResult>& results);

}  // namespace polargrain::app
