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

/// For hash tables: a name is a hash already.
struct ContentNameHash {
  std::size_t operator()(const ContentName& name) const { return name.low; }
};

ContentName name_of(std::span<const std::byte> bytes);

/// Everything a cell needs to go on, as one immutable value. The meaning of the bytes is the business of whoever
/// made them (dem/); everybody else passes them on, keeps them, or compares names.
///
/// A state may also be known by its name alone while its bytes are somewhere else, with the worker that made
/// it (coupler/pool): most states are tried once and never needed again.
class State {
 public:
  explicit State(std::vector<std::byte> bytes);
  /// A state whose bytes are elsewhere. @param size their number
  State(const ContentName& name, std::size_t size) : size_(size), name_(name), is_here_(false) {}
  /// @throws RunError when they are elsewhere
  [[nodiscard]] std::span<const std::byte> bytes() const;
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] const ContentName& name() const { return name_; }
  [[nodiscard]] bool is_here() const { return is_here_; }

 private:
  std::vector<std::byte> bytes_;
  std::size_t size_;
  ContentName name_;
  bool is_here_ = true;
};

/// States are shared, never changed: rolling back is keeping the old pointer.
using StatePointer = std::shared_ptr<const State>;

}  // namespace polargrain
