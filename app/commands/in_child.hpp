// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>
#include <functional>
#include <string>

#include "common/seconds.hpp"

namespace polargrain::app {

/// How far a child is, for whoever watches: one line that changes, on a terminal; else, in the file that a job writes, a
/// line now and then.
class ProgressLine {
 public:
  /// @param shown where it goes, negative for nowhere
  explicit ProgressLine(int shown);
  void say(const std::string& line);

 private:
  int shown_;
  bool terminal_;
  Clock::time_point said_ = Clock::now();
};

/// Works in a process of its own, because an error of the engine ends its process.
/// @param log takes all output of it and its engine, the message of an exception too; it is left there
/// @param work must write its results to files; given the line of progress
/// @returns whether it ended well @throws RunError when there can be no log or no process
bool run_in_child(const std::filesystem::path& log, const std::function<void(ProgressLine&)>& work,
                  bool shows_progress);

}  // namespace polargrain::app
