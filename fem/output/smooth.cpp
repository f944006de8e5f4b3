// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/output/smooth.hpp"

#include <Eigen/QR>
#include <map>

namespace polargrain::fem {
template <int dim>
Eigen::MatrixXd extrapolation_to(const ElementType<dim>& type,
                                 const std::vector<typename Cosserat<dim>::Place>& places) {
  const auto points = static_cast<Eigen::Index>(type.quadrature.size());
  const Eigen::Index terms = points < dim + 1 ? 1 : dim + 1;
  const auto rows_of = [terms](Eigen::MatrixXd& rows, Eigen::Index row,
                               const typename Cosserat<dim>::Place& position) {
    rows(row, 0) = 1.0;
    if (terms > 1) rows.row(row).template tail<dim>() = position.transpose();
  };
  Eigen::MatrixXd at_points(points, terms);
  for (Eigen::Index p = 0; p < points; ++p)
    rows_of(at_points, p, type.quadrature[static_cast<std::size_t>(p)].position);
  Eigen::MatrixXd at_places(static_cast<Eigen::Index>(places.size()), terms);
  for (Eigen::Index a = 0; a < at_places.rows(); ++a)
    rows_of(at_places, a, places[static_cast<std::size_t>(a)]);
  return at_places * at_points.completeOrthogonalDecomposition().pseudoInverse();
}

template <int dim>
Field smoothed(const Solver<dim>& solver, const Field& at_points, const std::vector<bool>& known) {
  const Mesh<dim>& mesh = solver.problem().mesh;
  const auto width = static_cast<std::size_t>(at_points.components);
  std::map<const ElementType<dim>*, Eigen::MatrixXd> extrapolations;
  std::vector<double> sums(mesh.nodes.size() * width, 0.0);
  std::vector<double> volumes(mesh.nodes.size(), 0.0);
  std::size_t begin = 0;
  while (begin < solver.points()) {
    const int number = solver.element_of_point(begin);
    const Element<dim>& element = mesh.elements[static_cast<std::size_t>(number)];
    const auto count = static_cast<Eigen::Index>(element.type->quadrature.size());
    const std::size_t first = begin;
    begin += static_cast<std::size_t>(count);
    if (!solver.is_there(first)) continue;
    if (!known.empty() && !known[first]) continue;  // an element is of one material
    auto matrix = extrapolations.find(element.type);
    if (matrix == extrapolations.end())
      matrix = extrapolations
                   .emplace(element.type, extrapolation_to<dim>(*element.type, element.type->node_positions))
                   .first;
    double volume = 0.0;
    for (std::size_t p = first; p < begin; ++p) volume += solver.volume_of_point(p);
    const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> values(
        at_points.values.data() + first * width, count, at_points.components);
    const Eigen::MatrixXd of_nodes = matrix->second * values;
    for (std::size_t a = 0; a < element.nodes.size(); ++a) {
      const auto node = static_cast<std::size_t>(element.nodes[a]);
      volumes[node] += volume;
      for (std::size_t i = 0; i < width; ++i)
        sums[node * width + i] +=
            volume * of_nodes(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(i));
    }
  }
  for (std::size_t i = 0; i < sums.size(); ++i)
    if (volumes[i / width] > 0.0) sums[i] /= volumes[i / width];
  Field field = at_points;
  field.values = std::move(sums);
  return field;
}

template Eigen::MatrixXd extrapolation_to<2>(const ElementType<2>&, const std::vector<Eigen::Vector2d>&);
template Eigen::MatrixXd extrapolation_to<3>(const ElementType<3>&, const std::vector<Eigen::Vector3d>&);
template Field smoothed<2>(const Solver<2>& solver, const Field& at_points, const std::vector<bool>& known);
template Field smoothed<3>(const Solver<3>& solver, const Field& at_points, const std::vector<bool>& known);

}  // namespace polargrain::fem
