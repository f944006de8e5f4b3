// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

#include "common/state.hpp"

namespace polargrain::testing {

/// Spoils the bytes of states as faults and liars do, the same way for the same seed: bits, words of eight
/// bytes that stand for likely values, pieces cut off, repeated or taken out.
class Spoiler {
 public:
  explicit Spoiler(unsigned seed) : random_(seed) {}

  StatePointer operator()(const State& state) {
    std::vector<std::byte> bytes(state.bytes().begin(), state.bytes().end());
    for (std::size_t change = 1 + below(4); change > 0; --change) spoil(bytes);
    return std::make_shared<const State>(std::move(bytes));
  }

 private:
  std::size_t below(std::size_t end) { return end == 0 ? 0 : random_() % end; }

  /// Half of the changes fall into the first bytes, where the lengths are.
  std::size_t place_in(const std::vector<std::byte>& bytes) {
    return below(below(2) == 0 ? std::min<std::size_t>(bytes.size(), 128) : bytes.size());
  }

  void put_word(std::vector<std::byte>& bytes) {
    const std::array<double, 12> numbers{0.0,
                                         -1.0,
                                         1.0,
                                         1e300,
                                         -1e300,
                                         1e-320,
                                         47.0,
                                         1e9,
                                         std::numeric_limits<double>::quiet_NaN(),
                                         std::numeric_limits<double>::infinity(),
                                         -0.0,
                                         1e-3};
    const std::array<std::int64_t, 8> wholes{0, 1, 2, -1, INT32_MAX, INT32_MIN, INT64_MAX, 65537};
    if (bytes.size() < 8) return;
    const std::size_t place = std::min(place_in(bytes) / 8 * 8, bytes.size() - 8);
    if (below(2) == 0) {
      std::memcpy(&bytes[place], &numbers[below(numbers.size())], 8);
    } else {
      std::memcpy(&bytes[place], &wholes[below(wholes.size())], 8);
    }
  }

  void spoil(std::vector<std::byte>& bytes) {
    if (bytes.empty()) return;
    const std::size_t place = place_in(bytes);
    const std::size_t length = std::min(1 + below(64), bytes.size() - place);
    const auto at = bytes.begin() + static_cast<std::ptrdiff_t>(place);
    switch (below(12)) {
      case 0:
        bytes.resize(place);
        return;
      case 1:
        bytes.erase(at, at + static_cast<std::ptrdiff_t>(length));
        return;
      case 2: {
        const std::vector<std::byte> piece(at, at + static_cast<std::ptrdiff_t>(length));
        bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(place_in(bytes)), piece.begin(),
                     piece.end());
        return;
      }
      case 3:
      case 4:
      case 5:
      case 6:
        put_word(bytes);
        return;
      case 7:
        bytes[place] = static_cast<std::byte>(random_());
        return;
      default:
        bytes[place] ^= static_cast<std::byte>(1U << below(8));
    }
  }

  std::mt19937 random_;
};

}  // namespace polargrain::testing
