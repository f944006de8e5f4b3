// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <span>

#include "dem/cell/increment_slip.hpp"
#include "dem/contact/contact_recorder.hpp"

namespace polargrain::dem {

/// A cell of spheres as its tangents see it; see ContactNetwork.
struct SpaceNetwork {
  std::span<const Contact> contacts;
  int grains = 0;         ///< contacts refer to 0 .. grains - 1
  Eigen::Matrix3d frame;  ///< turns vectors of the contacts into the frame of the tangent
  double volume = 0.0;    ///< m^3
  double hold = 0.0;      ///< spring on each grain, over the mean normal stiffness
  /// Of the contacts over the increment that the tangent is the derivative by; empty: by a further one, infinitely small.
  std::span<const SpaceSlip> slips = {};
};

}  // namespace polargrain::dem
