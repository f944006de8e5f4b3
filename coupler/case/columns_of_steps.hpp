// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string>
#include <vector>

namespace polargrain::coupler {

/// The columns of history.csv that describe a step, in their order; monitors follow them and may not have their names.
const std::vector<std::string>& columns_of_steps();
/// Further columns of a run with explicit steps, behind the columns of all steps.
const std::vector<std::string>& columns_of_explicit_steps();
/// A further column where stages have names: the number of the stage, 1 for the first; 0 in step 0.
inline constexpr const char* kStageColumn = "stage";
/// A further column of a run by `method: automatic`: iterations that were given up for explicit steps.
inline constexpr const char* kGivenUp = "given_up";

/// A further column of a run whose rate follows its error: speed over that at the start.
inline constexpr const char* kSpeed = "speed";
/// The last columns of a run in real time: where the energy is.
const std::vector<std::string>& columns_of_energies();

}  // namespace polargrain::coupler
