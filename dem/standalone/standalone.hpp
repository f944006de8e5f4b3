// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <functional>

namespace polargrain::dem {

/// LIGGGHTS as its own program is, with its own command line (-in SCRIPT, -var NAME VALUE, -log, -screen,
/// ...; under an MPI launcher in parallel), plus this project's contact models and fixes, libraries of contact laws
/// of the user's own (-contact FILE.so, may be repeated), and with its triclinic boxes repaired. Stock models run through the code compiled here, as in cells: the same digits as
/// the stock program (tests/verification/contact_standalone_test.cpp), less time. An engine error ends the
/// process with LIGGGHTS's words, then the script, line and text of the command.
/// @param add_models called before the script is read: a program's own contact models
/// @return exit status
int run_liggghts(int argc, char** argv, const std::function<void()>& add_models = {});

}  // namespace polargrain::dem
