// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string>
#include <vector>

#include "app/report/run_result.hpp"

namespace polargrain::app {

/// How much a warning takes from a result.
enum class NoteWeight {
  usual,   ///< such runs have it
  look,    ///< a figure may be off; look at it
  serious  ///< the result differs from the one asked for, or may be false
};

/// "serious"
std::string name_of(NoteWeight weight);

/// Warnings of one kind.
struct LogNote {
  std::string first;  ///< the first of them, as logged
  int count = 0;
  int first_step = -1;
  int last_step = -1;
  NoteWeight weight = NoteWeight::look;  ///< look, where nothing is known of it
  std::string meaning;                   ///< with the remedy; empty where nothing is known of it
};

/// The warnings of a log by kind, in the order in which the kinds appear.
std::vector<LogNote> notes_of(const std::vector<LoggedWarning>& warnings);

}  // namespace polargrain::app
