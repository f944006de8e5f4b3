// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <nlohmann/json.hpp>
#include <string>

#include "app/run/summary.hpp"

namespace polargrain::app {

/// The methods that a run by `method: automatic` has used, for summary.json: steps by Newton's method, explicit steps, and
/// iterations given up.
nlohmann::ordered_json automatic_figures(const RunRecord& record);

/// The same as a line under the table of a run; empty for other methods.
std::string automatic_text(const coupler::Case& the_case, const RunRecord& record);

}  // namespace polargrain::app
