// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/element/quadrilateral.hpp"

#include <array>
#include <utility>

#include "fem/element/line.hpp"
#include "fem/element/quadrature.hpp"

namespace polargrain::fem {
namespace {

const std::array<Eigen::Vector2d, 8> kNodes{
    {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {0, -1}, {1, 0}, {0, 1}, {-1, 0}}};

ShapeFunctions<2> bilinear(const Eigen::Vector2d& position) {
  ShapeFunctions<2> shape{Eigen::VectorXd(4), Eigen::MatrixX2d(4, 2)};
  for (int a = 0; a < 4; ++a) {
    const double s = 1.0 + position(0) * kNodes[a](0);
    const double t = 1.0 + position(1) * kNodes[a](1);
    shape.value(a) = 0.25 * s * t;
    shape.derivative.row(a) << 0.25 * kNodes[a](0) * t, 0.25 * kNodes[a](1) * s;
  }
  return shape;
}

ShapeFunctions<2> serendipity(const Eigen::Vector2d& position) {
  ShapeFunctions<2> shape{Eigen::VectorXd(8), Eigen::MatrixX2d(8, 2)};
  const double x = position(0);
  const double y = position(1);
  for (int a = 0; a < 4; ++a) {
    const double xa = kNodes[a](0);
    const double ya = kNodes[a](1);
    const double s = 1.0 + x * xa;
    const double t = 1.0 + y * ya;
    shape.value(a) = 0.25 * s * t * (x * xa + y * ya - 1.0);
    shape.derivative.row(a) << 0.25 * xa * t * (2.0 * x * xa + y * ya),
        0.25 * ya * s * (x * xa + 2.0 * y * ya);
  }
  for (int a = 4; a < 8; ++a) {
    const double xa = kNodes[a](0);
    const double ya = kNodes[a](1);
    if (xa == 0.0) {
      const double t = 1.0 + y * ya;
      shape.value(a) = 0.5 * (1.0 - x * x) * t;
      shape.derivative.row(a) << -x * t, 0.5 * (1.0 - x * x) * ya;
    } else {
      const double s = 1.0 + x * xa;
      shape.value(a) = 0.5 * (1.0 - y * y) * s;
      shape.derivative.row(a) << 0.5 * (1.0 - y * y) * xa, -y * s;
    }
  }
  return shape;
}

constexpr int kVtkQuad = 9;
constexpr int kVtkQuadraticQuad = 23;

ElementType<2> plane_serendipity_type(const char* name, int points) {
  return {name,
          8,
          4,
          kVtkQuadraticQuad,
          gauss_square(points),
          {kNodes.begin(), kNodes.end()},
          serendipity,
          false,
          sides_of_polygon(4, true)};
}

}  // namespace

ElementType<2> quadrilateral4() {
  return {"Q4",
          4,
          4,
          kVtkQuad,
          gauss_square(2),
          {kNodes.begin(), kNodes.begin() + 4},
          bilinear,
          true,
          sides_of_polygon(4, false)};
}
ElementType<2> quadrilateral4_one_point() {
  ElementType<2> type = quadrilateral4();
  type.name = "Q4R";
  type.averaged = std::move(type.quadrature);
  type.quadrature = gauss_square(1);
  type.mean_dilatation = false;
  return type;
}
ElementType<2> quadrilateral8_reduced() {
  return plane_serendipity_type("Q8R", 2);
}
ElementType<2> quadrilateral8() {
  return plane_serendipity_type("Q8", 3);
}

}  // namespace polargrain::fem
