// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/element/triangle.hpp"

#include "fem/element/line.hpp"
#include "fem/element/quadrature.hpp"

namespace polargrain::fem {
namespace {

ShapeFunctions<2> quadratic(const Eigen::Vector2d& position) {
  const double x = position(0);
  const double y = position(1);
  const double z = 1.0 - x - y;
  ShapeFunctions<2> shape{Eigen::VectorXd(6), Eigen::MatrixX2d(6, 2)};
  shape.value << z * (2 * z - 1), x * (2 * x - 1), y * (2 * y - 1), 4 * x * z, 4 * x * y, 4 * y * z;
  shape.derivative << 1 - 4 * z, 1 - 4 * z,  //
      4 * x - 1, 0,                          //
      0, 4 * y - 1,                          //
      4 * (z - x), -4 * x,                   //
      4 * y, 4 * x,                          //
      -4 * y, 4 * (z - y);
  return shape;
}

constexpr int kVtkQuadraticTriangle = 22;

}  // namespace

ElementType<2> triangle6() {
  return {"T6",
          6,
          3,
          kVtkQuadraticTriangle,
          triangle_three_points(),
          {{0, 0}, {1, 0}, {0, 1}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}},
          quadratic,
          false,
          sides_of_polygon(3, true)};
}

}  // namespace polargrain::fem
