// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/run/interrupt.hpp"

#include <fmt/format.h>
#include <signal.h>
#include <string.h>

namespace polargrain::app {
namespace {

volatile sig_atomic_t noted = 0;

void note(int signal) {
  noted = signal;
}

}  // namespace

void note_interrupts() {
  struct sigaction action {};
  action.sa_handler = note;
  action.sa_flags = SA_RESETHAND;  // the second one does what it always does
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaction(signal, &action, nullptr);
}

void stop_if_interrupted() {
  if (noted != 0) throw Interrupted(fmt::format("stopped by SIG{}", sigabbrev_np(noted)));
}

}  // namespace polargrain::app
