// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "dem/contact/contact_recorder.hpp"
#include "dem/discs/laws.hpp"

namespace polargrain::dem {

/// The record of a contact once its laws have spoken.
/// @param dx, dy from the centre of the second disc to the centre of the first, m @param fx, fy force on the first, N
inline Contact take_down(int first, int second, double dx, double dy, const Touch& touch,
                         const PairParameters& p, const NormalAnswer& normal, double fx, double fy,
                         const RollingAnswer& rolling) {
  Contact contact;
  contact.first = first;
  contact.second = second;
  contact.branch = {-dx, -dy, 0.0};
  contact.force = {fx, fy, 0.0};
  contact.normal_stiffness = normal.slope * normal.kn;
  contact.tangential_stiffness = normal.kt;
  contact.normal_viscosity = normal.normal_dashpot;
  contact.tangential_viscosity = normal.tangential_dashpot;
  contact.arm_first = touch.arm_first;
  contact.arm_second = touch.arm_second;
  contact.friction = p.friction;
  contact.moment.z() = -rolling.moment;
  contact.rolling_stiffness = rolling.stiffness;
  contact.rolling_at_limit = rolling.at_limit;
  contact.rolling_limit = rolling.limit;
  return contact;
}

}  // namespace polargrain::dem
