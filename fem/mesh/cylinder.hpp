// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string_view>

#include "fem/mesh/mesh.hpp"

namespace polargrain::fem {

/// A circular cylinder about x3 from the plane x3 = 0 up, of hexahedra: an inner square with bulging sides, and rings around it.
///
/// Boundaries bottom, top and side; of a half also front (x2 = 0), of a quarter also front and left (x1 = 0). Node sets axis,
/// bottom_axis and top_axis (its ends); bottom_side and top_side (the rims); the lines side_right (x1 = radius), side_back,
/// side_left and side_front, and their ends bottom_side_right and so on; all. Region all.
struct CylinderSpecification {
  enum class Sector {
    whole,
    half,    ///< x2 >= 0
    quarter  ///< x1 >= 0 and x2 >= 0
  };
  double radius;  ///< m, positive
  double height;  ///< m, positive
  int quarter;    ///< elements along a quarter of the circumference: even, at least 2
  int rings;      ///< elements between the inner square and the side, at least 1
  int layers;     ///< elements along the axis, at least 1
  Sector sector = Sector::whole;
};

/// Elements that the mesh will have.
double number_of_elements(const CylinderSpecification& specification);

/// @throws RunError when a size or a number is out of its range, or the element is no hexahedron.
Mesh<3> cylinder(const CylinderSpecification& specification, std::string_view element = "H20R");

}  // namespace polargrain::fem
