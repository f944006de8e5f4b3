// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/element/quadrature.hpp"

#include <cmath>

namespace polargrain::fem {

std::vector<LinePoint> gauss_line(int n) {
  if (n == 1) return {{0.0, 2.0}};
  if (n == 2) {
    const double a = 1.0 / std::sqrt(3.0);
    return {{-a, 1.0}, {a, 1.0}};
  }
  const double a = std::sqrt(0.6);
  return {{-a, 5.0 / 9.0}, {0.0, 8.0 / 9.0}, {a, 5.0 / 9.0}};
}

std::vector<QuadraturePoint<2>> gauss_square(int n) {
  std::vector<QuadraturePoint<2>> points;
  for (const LinePoint& second : gauss_line(n)) {
    for (const LinePoint& first : gauss_line(n)) {
      points.push_back({{first.position, second.position}, first.weight * second.weight});
    }
  }
  return points;
}

std::vector<QuadraturePoint<3>> gauss_cube(int n) {
  std::vector<QuadraturePoint<3>> points;
  for (const LinePoint& third : gauss_line(n)) {
    for (const QuadraturePoint<2>& plane : gauss_square(n)) {
      points.push_back({{plane.position(0), plane.position(1), third.position}, plane.weight * third.weight});
    }
  }
  return points;
}

std::vector<QuadraturePoint<2>> triangle_three_points() {
  constexpr double a = 1.0 / 6.0;
  constexpr double b = 2.0 / 3.0;
  return {{{a, a}, a}, {{b, a}, a}, {{a, b}, a}};
}

std::vector<QuadraturePoint<3>> tetrahedron_four_points() {
  const double near = (5.0 + 3.0 * std::sqrt(5.0)) / 20.0;
  const double far = (5.0 - std::sqrt(5.0)) / 20.0;
  constexpr double weight = 1.0 / 24.0;
  return {{{far, far, far}, weight},
          {{near, far, far}, weight},
          {{far, near, far}, weight},
          {{far, far, near}, weight}};
}

std::vector<QuadraturePoint<3>> wedge_points(int n) {
  std::vector<QuadraturePoint<3>> points;
  for (const LinePoint& height : gauss_line(n))
    for (const QuadraturePoint<2>& plane : triangle_three_points())
      points.push_back(
          {{plane.position(0), plane.position(1), height.position}, plane.weight * height.weight});
  return points;
}

}  // namespace polargrain::fem
