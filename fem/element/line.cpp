// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/element/line.hpp"

#include "fem/element/quadrature.hpp"

namespace polargrain::fem {
namespace {

using Position = Eigen::Matrix<double, 1, 1>;

constexpr int kVtkLine = 3;
constexpr int kVtkQuadraticEdge = 21;

ShapeFunctions<1> linear(const Position& position) {
  const double x = position(0);
  return {Eigen::Vector2d(0.5 * (1 - x), 0.5 * (1 + x)), Eigen::Vector2d(-0.5, 0.5)};
}

ShapeFunctions<1> quadratic(const Position& position) {
  const double x = position(0);
  return {Eigen::Vector3d(0.5 * x * (x - 1), 0.5 * x * (x + 1), 1 - x * x),
          Eigen::Vector3d(x - 0.5, x + 0.5, -2 * x)};
}

std::vector<QuadraturePoint<1>> three_points() {
  std::vector<QuadraturePoint<1>> points;
  for (const LinePoint& point : gauss_line(3)) points.push_back({Position(point.position), point.weight});
  return points;
}

}  // namespace

const ElementType<1>& line2() {
  static const ElementType<1> type{
      "L2", 2, 2, kVtkLine, three_points(), {Position(-1.0), Position(1.0)}, linear, false, {}};
  return type;
}

const ElementType<1>& line3() {
  static const ElementType<1> type{
      "L3",      3,     2, kVtkQuadraticEdge, three_points(), {Position(-1.0), Position(1.0), Position(0.0)},
      quadratic, false, {}};
  return type;
}

std::vector<ElementSide<2>> sides_of_polygon(int corners, bool has_middle_nodes) {
  std::vector<ElementSide<2>> sides;
  for (int side = 0; side < corners; ++side) {
    ElementSide<2>& made = sides.emplace_back(ElementSide<2>{{side, (side + 1) % corners}, &line2()});
    if (!has_middle_nodes) continue;
    made.nodes.push_back(corners + side);
    made.type = &line3();
  }
  return sides;
}

}  // namespace polargrain::fem
