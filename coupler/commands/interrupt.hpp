// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace polargrain::coupler {

/// From now on the first SIGINT (Ctrl-C), SIGTERM or SIGHUP only leaves a note; a second one ends the
/// program.
void note_interrupts();

/// @throws RunError when an interrupt was noted. To be called wherever a run may stop in good order.
void stop_if_interrupted();

}  // namespace polargrain::coupler
