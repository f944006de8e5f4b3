// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <vector>

#include "dem/cell/time_step.hpp"

namespace polargrain::dem {

/// A fix that pushes grains by springs of its own: they count for the stable time step.
class FurtherSprings {
 public:
  virtual ~FurtherSprings() = default;
  /// Adds the springs as they are, as contacts, and the bodies behind them as grains; a body that does not move has
  /// infinite inertia. Called after forces have been computed.
  virtual void add_springs(std::vector<Contact>& contacts, Inertia& inertia) const = 0;
};

}  // namespace polargrain::dem
