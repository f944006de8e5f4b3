// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <compare>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace polargrain {

/// 128-bit name of a sequence of bytes (XXH3): equal bytes have equal names, on every machine.
struct ContentName {
  std::uint64_t high = 0;
  std::uint64_t low = 0;
  auto operator<=>(const ContentName&) const = default;
  /// 32 hexadecimal digits.
  [[nodiscard]] std::string text() const;
};

ContentName name_of(std::span<const std::byte> bytes);

/// Everything a cell needs to go on, as one immutable value. What the bytes mean is the business of whoever
/// made them (dem/); everybody else passes them on, keeps them, or compares names.
class State {
 public:
  explicit State(std::vector<std::byte> bytes) : bytes_(std::move(bytes)), name_(name_of(bytes_)) {}
  [[nodiscard]] std::span<const std::byte> bytes() const { return bytes_; }
  [[nodiscard]] const ContentName& name() const { return name_; }

 private:
  std::vector<std::byte> bytes_;
  ContentName name_;
};

/// States are shared, never changed: rolling back is keeping the old pointer.
using StatePointer = std::shared_ptr<const State>;

}  // namespace polargrain
