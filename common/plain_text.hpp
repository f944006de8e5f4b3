// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cstddef>
#include <string>
#include <string_view>

namespace polargrain {

/// Longest text from outside (another machine's words, a line of an engine's output) that goes into messages
/// and logs, in bytes.
inline constexpr std::size_t kLongestWords = 1000;

/// A text from outside as it may be shown: printable characters of UTF-8 only. Line ends and tabs become
/// spaces, all other control characters (those that steer a terminal among them) and bytes that are not UTF-8
/// become '?'. A longer text than `most_bytes` (at least 40) is cut and says how long it was. Plain text
/// comes back unchanged.
std::string plain_text(std::string_view text, std::size_t most_bytes = kLongestWords);

/// A text of several lines for a terminal or a log: line ends and tabs stay, every other control character becomes '?'. Bytes
/// that are no UTF-8 stay where no terminal takes them for a control character, so that names of files can be copied.
std::string without_control_characters(std::string_view text);

/// The first control character of a text, as people name it ("U+001B"); empty without one. Line ends and tabs are
/// control characters too.
std::string control_character_in(std::string_view text);

}  // namespace polargrain
