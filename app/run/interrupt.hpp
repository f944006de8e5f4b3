// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "common/error.hpp"

namespace polargrain::app {

/// Somebody wants the program to stop. Ends it with exit status 3.
class Interrupted : public RunError {
 public:
  using RunError::RunError;
};

/// Signals that follow the first one within so many seconds say the same: batch systems and terminals send two.
constexpr double kSameWishSeconds = 1.0;

/// From now on the first SIGINT (Ctrl-C), SIGTERM or SIGHUP only leaves a note; one that comes kSameWishSeconds later
/// ends the program.
void note_interrupts();

/// @throws Interrupted when an interrupt was noted, with the name of the signal. To be called wherever a run
/// may stop in good order.
void stop_if_interrupted();
/// The same where there is nothing to go on from. @param when of the run, for the message
void stop_if_interrupted(const char* when);

}  // namespace polargrain::app
