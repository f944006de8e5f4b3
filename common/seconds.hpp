// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <chrono>

namespace polargrain {

/// The clock of everything that is timed: it never goes back.
using Clock = std::chrono::steady_clock;

inline double seconds_of(Clock::duration duration) {
  return std::chrono::duration<double>(duration).count();
}
inline double seconds_since(Clock::time_point start) {
  return seconds_of(Clock::now() - start);
}

}  // namespace polargrain
