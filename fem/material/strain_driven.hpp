// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "common/response.hpp"

namespace polargrain::fem {

/// The ability of laws that answer in place beyond plane strain: they take a strain along e_3 too. For tests of one point
/// (coupler/points); finite elements of the plane do not.
class StrainDriven {
 public:
  virtual ~StrainDriven() = default;
  [[nodiscard]] virtual bool takes_any_strain() const = 0;
  /// Material::evaluate of the first point, in small deformation, for a strain in the order of Component whose eps_33 may
  /// be anything. Only where takes_any_strain().
  virtual Response<2> evaluate_strain(const Vector7& strain) = 0;
};

/// The place of StrainDriven in laws of space, whose increments hold every strain.
class NotStrainDriven {};

}  // namespace polargrain::fem
