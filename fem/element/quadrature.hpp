// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <vector>

#include "fem/element/element_type.hpp"

namespace polargrain::fem {

/// A place of [-1, 1] and its weight; the weights add up to 2.
struct LinePoint {
  double position;
  double weight;
};

/// Gauss points of [-1, 1], exact for polynomials of degree 2 n - 1. @param n 1, 2 or 3.
std::vector<LinePoint> gauss_line(int n);
/// n x n Gauss points of [-1, 1]^2.
std::vector<QuadraturePoint<2>> gauss_square(int n);
/// n x n x n Gauss points of [-1, 1]^3, the first coordinate fastest.
std::vector<QuadraturePoint<3>> gauss_cube(int n);
/// Three inner points of the triangle (0,0), (1,0), (0,1), exact for quadratic polynomials.
std::vector<QuadraturePoint<2>> triangle_three_points();
/// Four inner points of the tetrahedron with corners at the origin and at 1 on each axis, exact for quadratic polynomials.
std::vector<QuadraturePoint<3>> tetrahedron_four_points();
/// The three points of the triangle times n Gauss points along the third coordinate, from -1 to 1.
std::vector<QuadraturePoint<3>> wedge_points(int n);

}  // namespace polargrain::fem
