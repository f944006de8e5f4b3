// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <vector>

#include "dem/contact/contact_recorder.hpp"

namespace LAMMPS_NS {
class Fix;
class LAMMPS;
}  // namespace LAMMPS_NS

namespace polargrain::dem {

/// The internals of stock contact models that tangents, time steps and damping need: the slope of Hertz's normal
/// force, of which the engine tells force over overlap, and rolling stiffness and limit of the model epsd2.
class StockLaws {
 public:
  /// After the script's `pair_style`.
  explicit StockLaws(LAMMPS_NS::LAMMPS& lammps);
  /// Puts it into recorded contacts, once; nothing is done to those of other models.
  void complete(std::vector<Contact>& contacts) const;

 private:
  LAMMPS_NS::LAMMPS* lammps_;
  double slope_ = 1.0;                  ///< d force / d overlap over force / overlap
  LAMMPS_NS::Fix* friction_ = nullptr;  ///< coefficientRollingFriction; null unless the model is epsd2
};

}  // namespace polargrain::dem
