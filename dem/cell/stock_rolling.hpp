// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <vector>

#include "dem/contact/contact_recorder.hpp"

namespace LAMMPS_NS {
class Fix;
class LAMMPS;
}  // namespace LAMMPS_NS

namespace polargrain::dem {

/// Rolling stiffness and limit of recorded contacts where the stock model epsd2 keeps them to itself.
class StockRolling {
 public:
  /// After the script's `pair_style`.
  explicit StockRolling(LAMMPS_NS::LAMMPS& lammps);
  /// Adds what is missing; nothing with any other rolling model.
  void complete(std::vector<Contact>& contacts) const;

 private:
  LAMMPS_NS::LAMMPS* lammps_;
  LAMMPS_NS::Fix* friction_ = nullptr;  ///< coefficientRollingFriction; null unless the model is epsd2
};

}  // namespace polargrain::dem
