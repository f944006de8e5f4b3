// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace polargrain::testing {

/// Tries to start a program, to reach the network, to write outside of the own folder, to trace and to signal another
/// process, to make namespaces. Prints a line for each: "tried WHAT: refused" or "tried WHAT: allowed".
void try_what_no_engine_should();

}  // namespace polargrain::testing
