// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/interface/interface_face.hpp"

#include <Eigen/Geometry>
#include <array>

#include "fem/element/corner_shape.hpp"

namespace polargrain::fem {
namespace {

/// Closed rules of [-1, 1]: the ends are points.
std::vector<std::pair<double, double>> closed_line(bool quadratic) {
  if (quadratic) return {{-1.0, 1.0 / 3.0}, {0.0, 4.0 / 3.0}, {1.0, 1.0 / 3.0}};
  return {{-1.0, 1.0}, {1.0, 1.0}};
}

/// Six inner points of the triangle (0,0), (1,0), (0,1), exact for polynomials of degree 4 (Dunavant 1985).
std::vector<QuadraturePoint<2>> triangle_six_points() {
  std::vector<QuadraturePoint<2>> points;
  constexpr std::array<std::array<double, 2>, 2> orbits{
      {{0.445948490915965, 0.5 * 0.223381589678011}, {0.091576213509771, 0.5 * 0.109951743655322}}};
  for (const auto& [a, weight] : orbits)
    for (const auto& [x, y] : {std::pair(a, a), std::pair(1 - 2 * a, a), std::pair(a, 1 - 2 * a)})
      points.push_back({{x, y}, weight});
  return points;
}

std::vector<QuadraturePoint<1>> points_of(const ElementType<1>& type) {
  std::vector<QuadraturePoint<1>> points;
  for (const auto& [x, weight] : closed_line(type.nodes == 3))
    points.push_back({Eigen::Matrix<double, 1, 1>(x), weight});
  return points;
}

std::vector<QuadraturePoint<2>> points_of(const ElementType<2>& type) {
  if (type.corners == 3) return triangle_six_points();
  std::vector<QuadraturePoint<2>> points;
  // Three each way for four nodes too: two do not integrate a shape function on a face that is no parallelogram.
  for (const auto& [y, weight_y] : closed_line(true))
    for (const auto& [x, weight_x] : closed_line(true)) points.push_back({{x, y}, weight_x * weight_y});
  return points;
}

/// Axes and area per reference area. @param along d x / d xi, a column a reference coordinate
void set_axes(const Eigen::Vector2d& along, InterfacePoint<2>& point) {
  const double length = along.norm();
  const Eigen::Vector2d normal(along(1) / length, -along(0) / length);  // the element lies to the left
  point.axes << normal(1), -normal(0), normal(0), normal(1);
  point.area = length;
}

void set_axes(const Eigen::Matrix<double, 3, 2>& along, InterfacePoint<3>& point) {
  const Eigen::Vector3d across = along.col(0).cross(along.col(1));
  point.area = across.norm();
  const Eigen::Vector3d normal = across / point.area;
  const Eigen::Vector3d tangent = along.col(0).normalized();
  point.axes << tangent.transpose(), normal.cross(tangent).transpose(), normal.transpose();
}

}  // namespace

template <int dim>
std::vector<InterfacePoint<dim>> interface_points(const ElementType<dim - 1>& type,
                                                  const VectorRows<dim>& positions) {
  std::vector<InterfacePoint<dim>> points;
  for (const QuadraturePoint<dim - 1>& at : points_of(type)) {
    const ShapeFunctions<dim - 1> shape = type.shape_functions(at.position);
    InterfacePoint<dim>& point = points.emplace_back();
    point.place = positions.transpose() * shape.value;
    point.shape = shape.value;
    point.corner_shape = corner_shape_functions<dim - 1>(type, at.position).value;
    set_axes(positions.transpose() * shape.derivative, point);
    point.area *= at.weight;
  }
  return points;
}

template std::vector<InterfacePoint<2>> interface_points<2>(const ElementType<1>&, const VectorRows<2>&);
template std::vector<InterfacePoint<3>> interface_points<3>(const ElementType<2>&, const VectorRows<3>&);

}  // namespace polargrain::fem
