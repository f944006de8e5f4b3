// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <nlohmann/json.hpp>
#include <string>

#include "app/run/summary.hpp"

namespace polargrain::app {

/// Where the energy of a run in real time is at its end, and the largest error of the balance, for summary.json.
nlohmann::ordered_json energy_figures(const RunRecord& record);

/// The same as lines under the table of a run.
std::string energy_text(const RunRecord& record);

}  // namespace polargrain::app
