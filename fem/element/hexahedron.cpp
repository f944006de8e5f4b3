// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/element/hexahedron.hpp"

#include <array>
#include <utility>

#include "fem/element/faces.hpp"
#include "fem/element/quadrature.hpp"
#include "fem/element/quadrilateral.hpp"

namespace polargrain::fem {
namespace {

constexpr int kCornersOfHexahedron = 8;
constexpr int kVtkHexahedron = 12;
constexpr int kVtkQuadraticHexahedron = 25;

const std::array<Eigen::Vector3d, kCornersOfHexahedron> kCornerPositions{
    {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}}};
/// Corners of each edge, in the order of its middle node.
const std::vector<std::array<int, 2>> kEdgesOfHexahedron{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6},
                                                         {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
/// Corners of each face, counter-clockwise seen from outside.
const std::vector<std::vector<int>> kFacesOfHexahedron{{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                                       {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};

ShapeFunctions<3> trilinear(const Eigen::Vector3d& position) {
  ShapeFunctions<3> shape{Eigen::VectorXd(kCornersOfHexahedron), VectorRows<3>(kCornersOfHexahedron, 3)};
  for (int a = 0; a < kCornersOfHexahedron; ++a) {
    const Eigen::Vector3d& at = kCornerPositions[static_cast<std::size_t>(a)];
    const Eigen::Array3d f = 1.0 + position.array() * at.array();
    shape.value(a) = 0.125 * f(0) * f(1) * f(2);
    shape.derivative.row(a) << 0.125 * at(0) * f(1) * f(2), 0.125 * at(1) * f(0) * f(2),
        0.125 * at(2) * f(0) * f(1);
  }
  return shape;
}

ShapeFunctions<3> serendipity(const Eigen::Vector3d& position) {
  const int nodes = kCornersOfHexahedron + static_cast<int>(kEdgesOfHexahedron.size());
  ShapeFunctions<3> shape{Eigen::VectorXd(nodes), VectorRows<3>(nodes, 3)};
  for (int a = 0; a < kCornersOfHexahedron; ++a) {
    const Eigen::Array3d at = kCornerPositions[static_cast<std::size_t>(a)].array();
    const Eigen::Array3d product = position.array() * at;
    const Eigen::Array3d f = 1.0 + product;
    const double rest = product.sum() - 2.0;
    shape.value(a) = 0.125 * f(0) * f(1) * f(2) * rest;
    for (int i = 0; i < 3; ++i)
      shape.derivative(a, i) = 0.125 * at(i) * f((i + 1) % 3) * f((i + 2) % 3) * (rest + f(i));
  }
  for (std::size_t edge = 0; edge < kEdgesOfHexahedron.size(); ++edge) {
    const Eigen::Array3d at = 0.5 * (kCornerPositions[static_cast<std::size_t>(kEdgesOfHexahedron[edge][0])] +
                                     kCornerPositions[static_cast<std::size_t>(kEdgesOfHexahedron[edge][1])])
                                        .array();
    const int a = kCornersOfHexahedron + static_cast<int>(edge);
    int along = 0;  // the axis of the edge
    while (at(along) != 0.0) ++along;
    const int second = (along + 1) % 3;
    const int third = (along + 2) % 3;
    const double bubble = 1.0 - position(along) * position(along);
    const double s = 1.0 + position(second) * at(second);
    const double t = 1.0 + position(third) * at(third);
    shape.value(a) = 0.25 * bubble * s * t;
    shape.derivative(a, along) = -0.5 * position(along) * s * t;
    shape.derivative(a, second) = 0.25 * bubble * at(second) * t;
    shape.derivative(a, third) = 0.25 * bubble * s * at(third);
  }
  return shape;
}

std::vector<Eigen::Vector3d> positions(bool with_edges) {
  std::vector<Eigen::Vector3d> all(kCornerPositions.begin(), kCornerPositions.end());
  if (!with_edges) return all;
  for (const auto& [first, second] : kEdgesOfHexahedron)
    all.push_back(0.5 * (all[static_cast<std::size_t>(first)] + all[static_cast<std::size_t>(second)]));
  return all;
}

ElementType<3> serendipity_type(const char* name, int points) {
  static const ElementType<2> face = quadrilateral8();
  return {name,
          kCornersOfHexahedron + static_cast<int>(kEdgesOfHexahedron.size()),
          kCornersOfHexahedron,
          kVtkQuadraticHexahedron,
          gauss_cube(points),
          positions(true),
          serendipity,
          false,
          faces(kFacesOfHexahedron, kEdgesOfHexahedron, kCornersOfHexahedron, face)};
}

}  // namespace

ElementType<3> hexahedron20_reduced() {
  return serendipity_type("H20R", 2);
}
ElementType<3> hexahedron20() {
  return serendipity_type("H20", 3);
}
ElementType<3> hexahedron8_one_point() {
  ElementType<3> type = hexahedron8();
  type.name = "H8R";
  type.averaged = std::move(type.quadrature);
  type.quadrature = gauss_cube(1);
  type.mean_dilatation = false;
  return type;
}
ElementType<3> hexahedron8() {
  static const ElementType<2> face = quadrilateral4();
  return {"H8",
          kCornersOfHexahedron,
          kCornersOfHexahedron,
          kVtkHexahedron,
          gauss_cube(2),
          positions(false),
          trilinear,
          true,
          faces(kFacesOfHexahedron, {}, kCornersOfHexahedron, face)};
}

}  // namespace polargrain::fem
