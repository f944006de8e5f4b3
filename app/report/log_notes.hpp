// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string>
#include <vector>

#include "app/report/run_result.hpp"

namespace polargrain::app {

/// Warnings of one kind.
struct LogNote {
  std::string first;  ///< the first of them, as logged
  int count = 0;
  int first_step = -1;
  int last_step = -1;
  std::string meaning;  ///< and what helps; empty where nothing is known of it
};

/// The warnings of a log by kind, in the order in which the kinds appear.
std::vector<LogNote> notes_of(const std::vector<LoggedWarning>& warnings);

}  // namespace polargrain::app
