// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string>

#include "fem/solver/solver.hpp"

namespace polargrain::app {

/// How the end of another run was taken over, for the log: one sentence each for states, imbalance and movement.
std::string text_of(const fem::StartReport& start);

}  // namespace polargrain::app
