// SPDX-License-Identifier: GPL-2.0-or-later
#include "common/plane_in_space.hpp"

#include <array>

namespace polargrain {
namespace {

/// Where s11 s22 s33 s12 s21 m1 m2 (Component) stand among s11 s12 ... s33 m11 ... m33: m1 is m13, m2 is m23.
constexpr std::array<int, 7> kPlaces{0, 4, 8, 1, 3, 11, 14};

}  // namespace

CellIncrement in_space(const Increment<2>& increment) {
  CellIncrement made;
  made.displacement_gradient.topLeftCorner<2, 2>() = increment.displacement_gradient;
  made.rotation(2) = increment.micro_rotation;
  made.curvature.row(2).head<2>() = increment.curvature.transpose();
  return made;
}

Increment<2> in_plane(const CellIncrement& increment) {
  Increment<2> made;
  made.displacement_gradient = increment.displacement_gradient.topLeftCorner<2, 2>();
  made.micro_rotation = increment.rotation(2);
  made.curvature = increment.curvature.row(2).head<2>().transpose();
  made.configuration = Configuration::start;
  return made;
}

std::string out_of_plane_fault(const CellIncrement& increment) {
  const CellIncrement within = in_space(in_plane(increment));
  if (within.displacement_gradient != increment.displacement_gradient)
    return "discs cannot move out of their plane: the displacement gradient of the increment must have zeros "
           "in its third row and column";
  if (within.rotation != increment.rotation || within.curvature != increment.curvature)
    return "discs turn about the normal of their plane alone: rotations about another axis, and curvatures "
           "but k31 and k32, must be zero";
  return {};
}

CellResponse in_space(const Response<2>& response, KnownComponents known) {
  CellResponse made;
  Vector18 all = Vector18::Zero();
  all(kPlaces) = response.stress;
  made.set_components(all);
  made.tangent(kPlaces, kPlaces) = response.tangent;
  made.known = known;
  static_cast<Trust&>(made) = response;
  return made;
}

Response<2> in_plane(const CellResponse& response) {
  Response<2> made;
  made.stress = response.components()(kPlaces);
  made.tangent = response.tangent(kPlaces, kPlaces);
  static_cast<Trust&>(made) = response;
  return made;
}

}  // namespace polargrain
