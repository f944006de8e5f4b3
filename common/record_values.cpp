// SPDX-License-Identifier: GPL-2.0-or-later
#include "common/record_values.hpp"

#include <fmt/format.h>

namespace polargrain {

std::int64_t RecordReader::next_integer(std::string_view name, std::int64_t least, std::int64_t most) {
  const std::int64_t value = next(values_.integers, integer_, name);
  if (value < least || value > most) {
    throw RunError(
        fmt::format("the field '{}' of {} is {}; expected {} to {}", name, what_, value, least, most));
  }
  return value;
}

void RecordReader::end() const {
  if (number_ != values_.numbers.size() || integer_ != values_.integers.size() ||
      text_ != values_.texts.size() || state_ != values_.states.size()) {
    throw RunError(what_ + " holds more than its fields");
  }
}

}  // namespace polargrain
