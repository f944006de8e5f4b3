// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/protocol/numbers.hpp"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstring>

#include "coupler/protocol/messages.hpp"

namespace polargrain::coupler {

static_assert(std::endian::native == std::endian::little,
              "blocks of doubles are copied as they lie in memory");

std::vector<double> numbers_of(std::span<const std::byte> bytes) {
  if (bytes.size() % sizeof(double) != 0) {
    throw ProtocolError(fmt::format("a block of doubles has {} bytes, no multiple of 8", bytes.size()));
  }
  std::vector<double> numbers(bytes.size() / sizeof(double));
  if (!numbers.empty()) std::memcpy(numbers.data(), bytes.data(), bytes.size());
  return numbers;
}

void require_finite(std::span<const double> numbers, const char* what) {
  for (const double number : numbers) {
    if (!std::isfinite(number)) throw FalseMessage(fmt::format("{} holds a number that is not finite", what));
  }
}

}  // namespace polargrain::coupler
