// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/element/tetrahedron.hpp"

#include "fem/element/faces.hpp"
#include "fem/element/quadrature.hpp"
#include "fem/element/triangle.hpp"

namespace polargrain::fem {
namespace {

constexpr int kCornersOfTetrahedron = 4;
constexpr int kVtkQuadraticTetrahedron = 24;

const std::vector<std::array<int, 2>> kEdgesOfTetrahedron{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
/// Corners of each face, counter-clockwise seen from outside.
const std::vector<std::vector<int>> kFacesOfTetrahedron{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};

ShapeFunctions<3> quadratic(const Eigen::Vector3d& position) {
  const Eigen::Vector4d share(1.0 - position.sum(), position(0), position(1), position(2));
  Eigen::Matrix<double, kCornersOfTetrahedron, 3> slope;
  slope << -1, -1, -1, 1, 0, 0, 0, 1, 0, 0, 0, 1;
  const int nodes = kCornersOfTetrahedron + static_cast<int>(kEdgesOfTetrahedron.size());
  ShapeFunctions<3> shape{Eigen::VectorXd(nodes), VectorRows<3>(nodes, 3)};
  for (int a = 0; a < kCornersOfTetrahedron; ++a) {
    shape.value(a) = share(a) * (2.0 * share(a) - 1.0);
    shape.derivative.row(a) = (4.0 * share(a) - 1.0) * slope.row(a);
  }
  for (std::size_t edge = 0; edge < kEdgesOfTetrahedron.size(); ++edge) {
    const auto [first, second] = kEdgesOfTetrahedron[edge];
    const int a = kCornersOfTetrahedron + static_cast<int>(edge);
    shape.value(a) = 4.0 * share(first) * share(second);
    shape.derivative.row(a) = 4.0 * (share(second) * slope.row(first) + share(first) * slope.row(second));
  }
  return shape;
}

}  // namespace

ElementType<3> tetrahedron10() {
  static const ElementType<2> face = triangle6();
  std::vector<Eigen::Vector3d> positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const auto& [first, second] : kEdgesOfTetrahedron)
    positions.push_back(
        0.5 * (positions[static_cast<std::size_t>(first)] + positions[static_cast<std::size_t>(second)]));
  return {"T10",
          kCornersOfTetrahedron + static_cast<int>(kEdgesOfTetrahedron.size()),
          kCornersOfTetrahedron,
          kVtkQuadraticTetrahedron,
          tetrahedron_four_points(),
          positions,
          quadratic,
          false,
          faces(kFacesOfTetrahedron, kEdgesOfTetrahedron, kCornersOfTetrahedron, face)};
}

}  // namespace polargrain::fem
