// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string>

#include "app/report/run_result.hpp"

namespace polargrain::app {

/// Charts of the values along the lines that a run has written, of some of its steps, the last one always. Empty without any.
std::string profiles_section(const RunResult& result);

}  // namespace polargrain::app
