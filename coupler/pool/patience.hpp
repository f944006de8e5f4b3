// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace polargrain::coupler {

/// When a worker that does not answer is taken for hung. For processes of our own time counts in which they run or
/// wait for something; not that in which they are ready to run and others have the processors.
struct PatienceLimits {
  /// A worker at work that has given no sign of life for so long is given up; alive, it says so thirty times
  /// as often.
  double silence_seconds = 30.0;
  /// A cell may take so long even if its worker says all the while that it works ...
  double cell_seconds = 600.0;
  /// ... or this many times as long as the longest of its definition that was answered, whichever is more.
  double times_longest = 20.0;
};

}  // namespace polargrain::coupler
