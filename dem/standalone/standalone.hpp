// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace polargrain::dem {

/// Where stock combinations of contact models run: in the engine's library, or in this project's compiled
/// copy of the same templates with its own loop over pairs, as in cells.
enum class ContactCode { of_the_library, compiled_here };

/// LIGGGHTS as its own program is, with its own command line (-in SCRIPT, -var NAME VALUE, -log, -screen,
/// ...; under an MPI launcher in parallel), plus this project's contact models and fixes, and with its
/// triclinic boxes repaired. An engine error ends the
/// process with LIGGGHTS's words, then the script, line and text of the command.
/// @return exit status
int run_liggghts(int argc, char** argv, ContactCode stock_models = ContactCode::of_the_library);

}  // namespace polargrain::dem
