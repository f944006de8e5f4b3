// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "fem/mesh/mesh.hpp"

namespace polargrain::app {

/// A face of an element that no other element has.
struct OuterFace {
  int element;
  std::vector<int> corners;        ///< nodes, counter-clockwise seen from outside
  std::vector<std::string> names;  ///< boundaries that it belongs to
  Eigen::Vector3d centre;          ///< m
  Eigen::Vector3d normal;          ///< outward, of length one
  double area;                     ///< of the polygon of the corners, m^2
};

/// In the order of the elements and their sides.
std::vector<OuterFace> outer_faces(const fem::Mesh<3>& mesh);

}  // namespace polargrain::app
