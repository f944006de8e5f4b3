// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cstddef>
#include <new>
#include <vector>

namespace polargrain::dem {

/// Memory that begins with a cache line, so that no vector of a block lies across two.
template <typename Item>
struct LineAllocator {
  using value_type = Item;
  static constexpr std::align_val_t kLine{64};
  LineAllocator() = default;
  template <typename Other>
  LineAllocator(const LineAllocator<Other>&) {}  // NOLINT(google-explicit-constructor): as allocators are
  Item* allocate(std::size_t count) {
    return static_cast<Item*>(::operator new(count * sizeof(Item), kLine));
  }
  void deallocate(Item* place, std::size_t) { ::operator delete(place, kLine); }
  template <typename Other>
  bool operator==(const LineAllocator<Other>&) const {
    return true;
  }
};
template <typename Item>
using LineVector = std::vector<Item, LineAllocator<Item>>;

}  // namespace polargrain::dem
