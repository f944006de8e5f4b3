// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

namespace polargrain::dem {

/// Random numbers that are the same with every standard library: the generator is laid down in the language,
/// its distributions are not.
class RandomNumbers {
 public:
  explicit RandomNumbers(std::uint64_t seed) : generator_(seed) {}
  /// Uniform in [0, 1), 53 bits.
  double uniform() { return static_cast<double>(generator_() >> 11) * 0x1p-53; }
  template <typename Value>
  void shuffle(std::vector<Value>& values) {
    for (std::size_t left = values.size(); left > 1; --left)
      std::swap(values[left - 1], values[static_cast<std::size_t>(uniform() * static_cast<double>(left))]);
  }

 private:
  std::mt19937_64 generator_;
};

}  // namespace polargrain::dem
