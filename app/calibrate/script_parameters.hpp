// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string>
#include <utility>
#include <vector>

namespace polargrain::app {

/// A parameter of a script of cells is a variable of it, a line `variable NAME index VALUE` (or equal), read as ${NAME} or
/// v_NAME elsewhere.
/// @returns why the script has no such parameter that it reads; empty: it has
std::string parameter_fault(const std::string& script, const std::string& name);

/// The script with other values of its parameters; lines keep their places.
std::string with_parameters(const std::string& script,
                            const std::vector<std::pair<std::string, double>>& values);

}  // namespace polargrain::app
