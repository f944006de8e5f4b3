// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <utility>

namespace polargrain {

/// Opens /dev/null in the place of each of standard input, output and error that is closed. To be called first in main:
/// the next file that is opened would get the free number, and printed text would land in it.
void open_standard_streams();

/// From now on a pipe that nobody reads and a file that may not grow are errors of the write, not signals that end the
/// process. Programs that are started inherit it.
void make_signals_of_writes_errors();

/// Prints to a stream. Text that nobody can receive (a closed pipe, a full disk) is dropped. Names of the user's may stand in the
/// text: characters that steer a terminal become '?' here, whatever they came from.
/// @returns whether the stream took it
bool tell_text(std::FILE* stream, const std::string& text);

/// The same with a format of fmt.
template <class... Arguments>
bool tell(std::FILE* stream, fmt::format_string<Arguments...> format, Arguments&&... arguments) {
  return tell_text(stream, fmt::format(format, std::forward<Arguments>(arguments)...));
}

}  // namespace polargrain
