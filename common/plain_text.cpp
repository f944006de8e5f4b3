// SPDX-License-Identifier: GPL-2.0-or-later
#include "common/plain_text.hpp"

#include <fmt/format.h>

#include <cstdint>

namespace polargrain {
namespace {

/// Bytes of the printable character beyond ASCII that begins here; 0 when nothing printable begins: no UTF-8, or one of
/// the control characters from U+0080 to U+009F.
std::size_t length_beyond_ascii(std::string_view text) {
  const auto byte = [&](std::size_t place) { return static_cast<std::uint8_t>(text[place]); };
  const std::uint8_t head = byte(0);
  const std::size_t length = head >= 0xf5 ? 0 : head >= 0xf0 ? 4 : head >= 0xe0 ? 3 : head >= 0xc2 ? 2 : 0;
  if (length == 0 || length > text.size()) return 0;
  for (std::size_t place = 1; place < length; ++place)
    if ((byte(place) & 0xc0) != 0x80) return 0;
  return head == 0xc2 && byte(1) < 0xa0 ? 0 : length;
}

}  // namespace

std::string plain_text(std::string_view text, std::size_t most_bytes) {
  const std::string cut =
      text.size() > most_bytes ? fmt::format(" ... (cut, {} bytes)", text.size()) : std::string();
  const std::size_t most = most_bytes - cut.size();
  std::string plain;
  for (std::size_t place = 0; place < text.size();) {
    const char c = text[place];
    const bool ascii = static_cast<std::uint8_t>(c) < 0x80;
    const std::size_t length = ascii ? 1 : length_beyond_ascii(text.substr(place));
    if (plain.size() + (length == 0 ? 1 : length) > most) break;
    if (length > 1)
      plain += text.substr(place, length);
    else if (c == '\n' || c == '\r' || c == '\t')
      plain += ' ';
    else
      plain += length == 1 && c >= 0x20 && c != 0x7f ? c : '?';
    place += length == 0 ? 1 : length;
  }
  return plain + cut;
}

std::string without_control_characters(std::string_view text) {
  std::string plain;
  plain.reserve(text.size());
  for (std::size_t place = 0; place < text.size();) {
    const auto byte = static_cast<std::uint8_t>(text[place]);
    const std::size_t length = byte < 0x80 ? 0 : length_beyond_ascii(text.substr(place));
    if (length > 0) {
      plain += text.substr(place, length);
    } else {
      const bool is_printable = byte < 0x80 ? byte >= 0x20 && byte != 0x7f : byte >= 0xa0;
      // Of U+0080 to U+009F two bytes are left, one for each of which a '?' stands.
      const bool begins_control = byte == 0xc2 && place + 1 < text.size() &&
                                  (static_cast<std::uint8_t>(text[place + 1]) & 0xe0) == 0x80;
      plain += (is_printable && !begins_control) || byte == '\n' || byte == '\t' ? text[place] : '?';
    }
    place += length == 0 ? 1 : length;
  }
  return plain;
}

std::string control_character_in(std::string_view text) {
  for (std::size_t place = 0; place < text.size(); ++place) {
    const auto byte = static_cast<std::uint8_t>(text[place]);
    const auto next = place + 1 < text.size() ? static_cast<std::uint8_t>(text[place + 1]) : std::uint8_t{0};
    if (byte < 0x20 || byte == 0x7f) return fmt::format("U+{:04X}", byte);
    if (byte == 0xc2 && next >= 0x80 && next < 0xa0) return fmt::format("U+{:04X}", next);
  }
  return {};
}

}  // namespace polargrain
