// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cstddef>
#include <string>

#include "common/state.hpp"

namespace polargrain::coupler {

/// A material whose points have grains that can be looked at.
class GrainsOfPoints {
 public:
  virtual ~GrainsOfPoints() = default;
  /// The committed state of the cell that a point of the material goes by: its own, or (adaptive) the one that it shares,
  /// which was run to another point of like history.
  [[nodiscard]] virtual StatePointer grains_of(std::size_t point) const = 0;
  /// How many of its points are, or have been, at a limit of their grains, in a sentence; empty: no point. For the end of a run.
  [[nodiscard]] virtual std::string at_limits() const = 0;
};

}  // namespace polargrain::coupler
