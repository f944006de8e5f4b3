// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/run/interrupt.hpp"

#include <fmt/format.h>
#include <signal.h>
#include <string.h>
#include <time.h>

namespace polargrain::app {
namespace {

volatile sig_atomic_t noted = 0;
timespec noted_at{};  ///< written once, before `noted`, by a handler that no other signal of ours interrupts

double seconds_since_noted() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<double>(now.tv_sec - noted_at.tv_sec) +
         1e-9 * static_cast<double>(now.tv_nsec - noted_at.tv_nsec);
}

/// Only calls that a handler may make.
void note(int signal_number) {
  // A library that starts with the messages puts this handler back with flags of its own, for one signal only.
  note_interrupts();
  if (noted == 0) {
    clock_gettime(CLOCK_MONOTONIC, &noted_at);
    noted = signal_number;
  } else if (seconds_since_noted() >= kSameWishSeconds) {
    signal(signal_number, SIG_DFL);
    raise(signal_number);
  }
}

}  // namespace

void note_interrupts() {
  struct sigaction action {};
  action.sa_handler = note;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&action.sa_mask, signal);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaction(signal, &action, nullptr);
}

void stop_if_interrupted() {
  if (noted != 0) throw Interrupted(fmt::format("stopped by SIG{}", sigabbrev_np(noted)));
}

void stop_if_interrupted(const char* when) {
  if (noted != 0) throw Interrupted(fmt::format("stopped by SIG{} {}", sigabbrev_np(noted), when));
}

}  // namespace polargrain::app
