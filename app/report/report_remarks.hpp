// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string>
#include <vector>

#include "app/report/run_result.hpp"

namespace polargrain::app {

/// The remarks on the cases of runs as a table of a page, from their summaries; empty without remarks.
std::string remarks_section(const std::vector<RunResult>& results);

}  // namespace polargrain::app
