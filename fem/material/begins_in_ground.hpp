// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cstddef>

#include "common/cosserat.hpp"

namespace polargrain::fem {

/// A material that has no stress by a formula and can be led to one before a run begins: boxes of grains, to the stress of level
/// ground at their depth. A second base of materials; their initial stress is given here instead of by
/// Material::set_initial_stress.
template <int dim>
class BeginsInGround {
 public:
  virtual ~BeginsInGround() = default;
  /// The stress that a point is to begin with, between allocate and the first evaluation. Normal stresses across the vertical that
  /// are no numbers are the material's own: those that compression without strain across leaves (earth pressure at rest).
  /// @throws RunError where it cannot be led there
  virtual void set_ground_stress(std::size_t point, const typename Cosserat<dim>::Vector& stress) = 0;
  /// Leads all points there, once; to be called before a run evaluates anything. Nothing happens where no stress was set, and in a
  /// run that goes on from a checkpoint. @throws RunError where they cannot be led there
  virtual void begin_in_ground() = 0;
};

}  // namespace polargrain::fem
