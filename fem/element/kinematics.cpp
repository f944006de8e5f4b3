// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/element/kinematics.hpp"

#include "fem/element/averaged_places.hpp"
#include "fem/element/dofs.hpp"

#include <Eigen/LU>
#include <algorithm>

#include "fem/material/polar_decomposition.hpp"
#include "fem/material/rotation.hpp"

namespace polargrain::fem {
namespace {

/// The nodal values of an element, a column a node.
template <int dim>
using NodeColumns = Eigen::Map<const Eigen::Matrix<double, Cosserat<dim>::dofs, Eigen::Dynamic>>;

/// Rotation and curvature of the field of micro-rotations.
template <int dim>
void add_micro_rotation(const PointGeometry<dim>& point, const NodeColumns<dim>& values,
                        Increment<dim>& increment) {
  const auto rotations = values.template bottomRows<Cosserat<dim>::rotations>();
  if constexpr (dim == 2) {
    increment.micro_rotation = rotations.row(0).dot(point.shape);
    increment.curvature = (rotations.row(0) * point.gradient).transpose();
  } else {
    increment.rotation = rotations * point.shape;
    increment.curvature = rotations * point.gradient;
  }
}

/// In place, at places of the reference element.
template <int dim>
std::vector<PointGeometry<dim>> geometries_at(const std::vector<QuadraturePoint<dim>>& places,
                                              const ElementType<dim>& type, const VectorRows<dim>& nodes) {
  std::vector<PointGeometry<dim>> points;
  for (const QuadraturePoint<dim>& place : places) {
    const ShapeFunctions<dim> shape = type.shape_functions(place.position);
    const typename Cosserat<dim>::Gradient j = jacobian<dim>(nodes, shape);
    PointGeometry<dim> point;
    point.position = nodes.transpose() * shape.value;
    point.volume = place.weight * j.determinant();
    point.shape = shape.value;
    point.gradient = shape.derivative * j.inverse();
    points.push_back(std::move(point));
  }
  return points;
}

/// The point that stands for these: means over their volume. Where one of them is inside out its volume is not positive.
template <int dim>
PointGeometry<dim> mean_of(const std::vector<PointGeometry<dim>>& points) {
  PointGeometry<dim> mean = points.front();
  double volume = mean.volume;
  double least = mean.volume;
  mean.position *= mean.volume;
  mean.shape *= mean.volume;
  mean.gradient *= mean.volume;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const PointGeometry<dim>& point = points[i];
    volume += point.volume;
    least = std::min(least, point.volume);
    mean.position += point.volume * point.position;
    mean.shape += point.volume * point.shape;
    mean.gradient += point.volume * point.gradient;
  }
  mean.volume = least > 0.0 ? volume : least;
  mean.position /= volume;
  mean.shape /= volume;
  mean.gradient /= volume;
  return mean;
}

}  // namespace

template <int dim>
typename Cosserat<dim>::Gradient jacobian(const VectorRows<dim>& nodes, const ShapeFunctions<dim>& shape) {
  return nodes.transpose() * shape.derivative;
}

template <int dim>
std::vector<PointGeometry<dim>> averaged_places(const ElementType<dim>& type, const VectorRows<dim>& nodes) {
  return geometries_at(type.averaged, type, nodes);
}

template <int dim>
std::vector<PointGeometry<dim>> point_geometries(const ElementType<dim>& type, const VectorRows<dim>& nodes) {
  if (!type.averaged.empty()) return {mean_of(averaged_places<dim>(type, nodes))};
  std::vector<PointGeometry<dim>> points = geometries_at(type.quadrature, type, nodes);
  if (type.mean_dilatation) {
    double volume = 0.0;
    VectorRows<dim> mean = VectorRows<dim>::Zero(type.nodes, dim);
    for (const PointGeometry<dim>& point : points) {
      volume += point.volume;
      mean += point.volume * point.gradient;
    }
    mean /= volume;
    for (PointGeometry<dim>& point : points)
      point.dilatation_correction = (1.0 / dim) * (mean - point.gradient);
  }
  return points;
}

template <int dim>
Increment<dim> increment_at(const PointGeometry<dim>& point, Continuum continuum,
                            const Eigen::VectorXd& dofs) {
  Increment<dim> increment;
  const NodeColumns<dim> values(dofs.data(), Cosserat<dim>::dofs, point.shape.size());
  auto& h = increment.displacement_gradient;
  h = values.template topRows<dim>() * point.gradient;
  if (point.dilatation_correction.size() > 0) {
    const double correction = (values.template topRows<dim>() * point.dilatation_correction).trace();
    for (int i = 0; i < dim; ++i) h(i, i) += correction;
  }
  if (continuum == Continuum::cosserat) {
    add_micro_rotation<dim>(point, values, increment);
  } else if constexpr (dim == 2) {
    increment.micro_rotation = 0.5 * (h(1, 0) - h(0, 1));
  } else {
    increment.rotation = axial(h);
  }
  return increment;
}

template <int dim>
Increment<dim> large_increment_at(const PointGeometry<dim>& start, Continuum continuum,
                                  const Eigen::VectorXd& dofs, double dilatation) {
  using Gradient = typename Cosserat<dim>::Gradient;
  Increment<dim> increment;
  increment.configuration = Configuration::start;
  const NodeColumns<dim> values(dofs.data(), Cosserat<dim>::dofs, start.shape.size());
  Gradient& h = increment.displacement_gradient;
  h = values.template topRows<dim>() * start.gradient;
  if (dilatation != 1.0) h = dilatation * h + (dilatation - 1.0) * Gradient::Identity();
  if (continuum == Continuum::cosserat) {
    add_micro_rotation<dim>(start, values, increment);
  } else if constexpr (dim == 2) {
    increment.micro_rotation = rotation_angle(increment);
  } else {
    increment.rotation = rotation_vector(increment);
  }
  return increment;
}

template <int dim>
StrainMatrix<dim> strain_matrix(const PointGeometry<dim>& point, Continuum continuum) {
  using Counts = Cosserat<dim>;
  const auto nodes = point.shape.size();
  StrainMatrix<dim> b(Counts::components, entry_of<dim>(nodes));
  b.setZero();
  for (Eigen::Index a = 0; a < nodes; ++a) {
    const auto gradient = point.gradient.row(a);
    auto node = b.template middleCols<Counts::dofs>(entry_of<dim>(a));
    for (int j = 0; j < dim; ++j) node(Counts::stress_place(j, j), j) = gradient(j);
    if (point.dilatation_correction.size() > 0) {
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j)
          node(Counts::stress_place(i, i), j) += point.dilatation_correction(a, j);
    }
    for (int i = 0; i < dim; ++i) {
      for (int j = 0; j < dim; ++j) {
        if (i == j) continue;
        const int row = Counts::stress_place(i, j);
        if (continuum == Continuum::cauchy) {
          node(row, i) = 0.5 * gradient(j);
          node(row, j) = 0.5 * gradient(i);
          continue;
        }
        node(row, j) = gradient(i);
        for (int k = 0; k < Counts::rotations; ++k)
          if (const int sign = permutation(i, j, Counts::axis(k)); sign != 0)
            node(row, dim + k) = -sign * point.shape(a);
      }
    }
    if (continuum == Continuum::cauchy) continue;
    for (int i = 0; i < dim; ++i)
      for (int k = 0; k < Counts::rotations; ++k) node(Counts::couple_place(i, k), dim + k) = gradient(i);
  }
  return b;
}

template Cosserat<2>::Gradient jacobian<2>(const VectorRows<2>& nodes, const ShapeFunctions<2>& shape);
template Cosserat<3>::Gradient jacobian<3>(const VectorRows<3>& nodes, const ShapeFunctions<3>& shape);
template std::vector<PointGeometry<2>> averaged_places<2>(const ElementType<2>& type,
                                                          const VectorRows<2>& nodes);
template std::vector<PointGeometry<3>> averaged_places<3>(const ElementType<3>& type,
                                                          const VectorRows<3>& nodes);
template std::vector<PointGeometry<2>> point_geometries<2>(const ElementType<2>& type,
                                                           const VectorRows<2>& nodes);
template std::vector<PointGeometry<3>> point_geometries<3>(const ElementType<3>& type,
                                                           const VectorRows<3>& nodes);
template Increment<2> increment_at<2>(const PointGeometry<2>& point, Continuum continuum,
                                      const Eigen::VectorXd& dofs);
template Increment<3> increment_at<3>(const PointGeometry<3>& point, Continuum continuum,
                                      const Eigen::VectorXd& dofs);
template Increment<2> large_increment_at<2>(const PointGeometry<2>& start, Continuum continuum,
                                            const Eigen::VectorXd& dofs, double dilatation);
template Increment<3> large_increment_at<3>(const PointGeometry<3>& start, Continuum continuum,
                                            const Eigen::VectorXd& dofs, double dilatation);
template StrainMatrix<2> strain_matrix<2>(const PointGeometry<2>& point, Continuum continuum);
template StrainMatrix<3> strain_matrix<3>(const PointGeometry<3>& point, Continuum continuum);

}  // namespace polargrain::fem
