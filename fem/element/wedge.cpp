// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/element/wedge.hpp"

#include "fem/element/faces.hpp"
#include "fem/element/quadrature.hpp"
#include "fem/element/quadrilateral.hpp"
#include "fem/element/triangle.hpp"

namespace polargrain::fem {
namespace {

constexpr int kCornersOfWedge = 6;
constexpr int kOfTriangle = 3;
constexpr int kVtkQuadraticWedge = 26;

const std::vector<std::array<int, 2>> kEdgesOfWedge{{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5},
                                                    {5, 3}, {0, 3}, {1, 4}, {2, 5}};
/// Corners of each face, counter-clockwise seen from outside.
const std::vector<std::vector<int>> kTriangles{{0, 2, 1}, {3, 4, 5}};
const std::vector<std::vector<int>> kQuadrilaterals{{0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}};

/// A linear function of one coordinate or of two, with its slope in the reference element.
struct Linear {
  double value;
  Eigen::RowVector3d slope;
};

/// Share of each corner of the triangle.
std::array<Linear, kOfTriangle> shares(const Eigen::Vector3d& position) {
  return {
      {{1.0 - position(0) - position(1), {-1, -1, 0}}, {position(0), {1, 0, 0}}, {position(1), {0, 1, 0}}}};
}

/// 1 + zeta at the upper triangle, 1 - zeta at the lower one.
Linear towards(bool upper, const Eigen::Vector3d& position) {
  const double sign = upper ? 1.0 : -1.0;
  return {1.0 + sign * position(2), {0, 0, sign}};
}

ShapeFunctions<3> wedge_serendipity(const Eigen::Vector3d& position) {
  const int nodes = kCornersOfWedge + static_cast<int>(kEdgesOfWedge.size());
  ShapeFunctions<3> shape{Eigen::VectorXd(nodes), VectorRows<3>(nodes, 3)};
  const std::array<Linear, kOfTriangle> share = shares(position);
  const Linear bubble{1.0 - position(2) * position(2), {0, 0, -2.0 * position(2)}};
  for (int a = 0; a < kCornersOfWedge; ++a) {
    const auto& [l, dl] = share[static_cast<std::size_t>(a % kOfTriangle)];
    const auto [t, dt] = towards(a >= kOfTriangle, position);
    shape.value(a) = 0.5 * l * ((2.0 * l - 1.0) * t - bubble.value);
    shape.derivative.row(a) =
        0.5 * (((4.0 * l - 1.0) * t - bubble.value) * dl + l * ((2.0 * l - 1.0) * dt - bubble.slope));
  }
  for (std::size_t edge = 0; edge < kEdgesOfWedge.size(); ++edge) {
    const auto [first, second] = kEdgesOfWedge[edge];
    const int a = kCornersOfWedge + static_cast<int>(edge);
    const auto& [l, dl] = share[static_cast<std::size_t>(first % kOfTriangle)];
    if (second - first == kOfTriangle) {
      shape.value(a) = l * bubble.value;
      shape.derivative.row(a) = bubble.value * dl + l * bubble.slope;
      continue;
    }
    const auto& [m, dm] = share[static_cast<std::size_t>(second % kOfTriangle)];
    const auto [t, dt] = towards(first >= kOfTriangle, position);
    shape.value(a) = 2.0 * l * m * t;
    shape.derivative.row(a) = 2.0 * (m * t * dl + l * t * dm + l * m * dt);
  }
  return shape;
}

}  // namespace

ElementType<3> wedge15() {
  static const ElementType<2> triangle = triangle6();
  static const ElementType<2> quadrilateral = quadrilateral8();
  std::vector<Eigen::Vector3d> positions{{0, 0, -1}, {1, 0, -1}, {0, 1, -1}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
  for (const auto& [first, second] : kEdgesOfWedge)
    positions.push_back(
        0.5 * (positions[static_cast<std::size_t>(first)] + positions[static_cast<std::size_t>(second)]));
  std::vector<ElementSide<3>> sides = faces(kTriangles, kEdgesOfWedge, kCornersOfWedge, triangle);
  for (ElementSide<3>& side : faces(kQuadrilaterals, kEdgesOfWedge, kCornersOfWedge, quadrilateral))
    sides.push_back(std::move(side));
  return {"W15",
          kCornersOfWedge + static_cast<int>(kEdgesOfWedge.size()),
          kCornersOfWedge,
          kVtkQuadraticWedge,
          wedge_points(3),
          positions,
          wedge_serendipity,
          false,
          std::move(sides)};
}

}  // namespace polargrain::fem
