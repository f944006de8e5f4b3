// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <nlohmann/json.hpp>

#include "coupler/case/case.hpp"

namespace polargrain::app {

/// For readers of summary.json: the values that a run follows, by name, those of the case's `output: table` first and in its
/// order. Each has `kind` (reaction, displacement, formula, built-in), `unit` (empty: without one, or of a formula with a
/// number whose unit is not given) and `table` (whether the case lists it there).
nlohmann::ordered_json monitor_notes(const coupler::Case& the_case);

}  // namespace polargrain::app
