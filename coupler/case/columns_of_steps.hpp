// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string>
#include <vector>

namespace polargrain::coupler {

/// The columns of history.csv that describe a step, in their order; monitors follow them and may not have their names.
const std::vector<std::string>& columns_of_steps();
/// Those behind them that a run with explicit steps has besides.
const std::vector<std::string>& columns_of_explicit_steps();
/// The column behind these, where stages have names: the number of the stage, 1 for the first; 0 in step 0.
inline constexpr const char* kStageColumn = "stage";
/// The one behind them that a run by `method: automatic` has: iterations that were given up for explicit steps.
inline constexpr const char* kGivenUp = "given_up";

/// The one behind that of a run whose rate follows its error: speed over that at the start.
inline constexpr const char* kSpeed = "speed";
/// Those behind them all that a run in real time has: where the energy is.
const std::vector<std::string>& columns_of_energies();

}  // namespace polargrain::coupler
