// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <chrono>
#include <thread>

namespace polargrain::testing {

/// How long a test waits for what must happen. No verdict hangs on it: it ends a test that has failed.
constexpr std::chrono::minutes kPatience{5};

/// Does something again and again until a condition holds. @returns whether it does
template <class Condition, class Meanwhile>
bool eventually(Condition condition, Meanwhile meanwhile) {
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    meanwhile();
  }
  return true;
}

template <class Condition>
bool eventually(Condition condition) {
  return eventually(condition, [] { std::this_thread::sleep_for(std::chrono::milliseconds(5)); });
}

}  // namespace polargrain::testing
