// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <utility>
#include <vector>

namespace polargrain::fem {

/// A contribution that makes entries of nodal vectors one, such as the pressures on two sides that water passes freely.
class TiesEntries {
 public:
  virtual ~TiesEntries() = default;
  /// Pairs of entries that share one value in a stage. Where one of them is given, so is the other.
  [[nodiscard]] virtual std::vector<std::pair<int, int>> tied_entries(int stage) const = 0;
};

}  // namespace polargrain::fem
