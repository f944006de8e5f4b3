// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cstddef>
#include <string>

#include "common/seconds.hpp"

namespace polargrain::app {

/// Tells what is next, and how long what is like it has taken.
class Jobs {
 public:
  Jobs(std::size_t count, bool quiet) : count_(count), quiet_(quiet) {}

  /// @param there whether it was made before
  /// @throws Interrupted when the user has asked for the end
  void next(const std::string& what, bool there);

 private:
  std::size_t count_;
  bool quiet_;
  std::size_t number_ = 0;
  int made_ = 0;
  Clock::time_point start_ = Clock::now();
};

}  // namespace polargrain::app
