// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/element/hourglass.hpp"

#include "fem/element/kinematics.hpp"

namespace polargrain::fem {
namespace {

/// Reference coordinates whose products are the modes, from 0.
template <int dim>
const std::vector<std::vector<int>>& factors() {
  static const std::vector<std::vector<int>> all =
      dim == 2 ? std::vector<std::vector<int>>{{0, 1}}
               : std::vector<std::vector<int>>{{1, 2}, {2, 0}, {0, 1}, {0, 1, 2}};
  return all;
}

}  // namespace

template <int dim>
HourglassModes hourglass_modes(const ElementType<dim>& type, const VectorRows<dim>& nodes) {
  const PointGeometry<dim> mean = point_geometries<dim>(type, nodes).front();
  const auto centre = jacobian<dim>(nodes, type.shape_functions(type.quadrature.front().position));
  const auto count = static_cast<Eigen::Index>(factors<dim>().size());
  HourglassModes made{Eigen::MatrixXd(type.nodes, count), Eigen::VectorXd(count)};
  for (Eigen::Index mode = 0; mode < count; ++mode) {
    Eigen::VectorXd pattern = Eigen::VectorXd::Ones(type.nodes);
    double squares = 0.0;  // of the sides along these coordinates
    const std::vector<int>& axes = factors<dim>()[static_cast<std::size_t>(mode)];
    for (const int axis : axes) {
      for (int a = 0; a < type.nodes; ++a)
        pattern(a) *= type.node_positions[static_cast<std::size_t>(a)](axis);
      squares += 4.0 * centre.col(axis).squaredNorm();
    }
    // Less its linear part: gradients are means over the element, so they find linear fields exactly.
    made.modes.col(mode) = (pattern - mean.gradient * (nodes.transpose() * pattern)) / type.nodes;
    // u1 = x y / (h/2)^2 has the strain 2 y / (h/2) / h, whose mean square is 4 / (3 h^2).
    made.weights(mode) = mean.volume * 4.0 / 3.0 * static_cast<double>(axes.size()) / squares;
  }
  return made;
}

template HourglassModes hourglass_modes<2>(const ElementType<2>& type, const VectorRows<2>& nodes);
template HourglassModes hourglass_modes<3>(const ElementType<3>& type, const VectorRows<3>& nodes);

}  // namespace polargrain::fem
