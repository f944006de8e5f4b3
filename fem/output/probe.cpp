// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/output/probe.hpp"

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <optional>

#include "fem/element/kinematics.hpp"
#include "fem/output/smooth.hpp"

namespace polargrain::fem {
namespace {

constexpr double kInside = 1e-8;  ///< of the reference element: a place on a side belongs to both elements

/// Whether a place of the reference element lies in it: a square or cube from -1 to 1, or a simplex from 0.
template <int dim>
bool is_inside(const ElementType<dim>& type, const typename Cosserat<dim>::Place& reference) {
  const bool simplex = type.corners == dim + 1;
  if (simplex) return reference.minCoeff() >= -kInside && reference.sum() <= 1.0 + kInside;
  return reference.cwiseAbs().maxCoeff() <= 1.0 + kInside;
}

/// Newton's iteration for the reference coordinates of a place; nothing where it does not lie in the element.
template <int dim>
std::optional<typename Cosserat<dim>::Place> reference_of(const ElementType<dim>& type,
                                                          const VectorRows<dim>& nodes,
                                                          const typename Cosserat<dim>::Place& place) {
  constexpr int kMostIterations = 20;
  constexpr double kFound = 1e-12;
  typename Cosserat<dim>::Place reference = Cosserat<dim>::Place::Zero();
  if (type.corners == dim + 1) reference.setConstant(1.0 / (dim + 1));
  for (int iteration = 0; iteration < kMostIterations; ++iteration) {
    const ShapeFunctions<dim> shape = type.shape_functions(reference);
    const typename Cosserat<dim>::Place missing = place - nodes.transpose() * shape.value;
    const typename Cosserat<dim>::Gradient derivative = nodes.transpose() * shape.derivative;
    const typename Cosserat<dim>::Place step = derivative.partialPivLu().solve(missing);
    reference += step;
    if (!reference.allFinite()) return {};
    if (step.norm() < kFound)
      return is_inside<dim>(type, reference) ? std::optional(reference) : std::nullopt;
  }
  return {};
}

/// The mean over the elements of a place that are there. @param of (element, reference place)
template <class Value, int dim, class Of>
Value mean(const Solver<dim>& solver, const Probe<dim>& probe, Of of) {
  const std::vector<char> there = elements_in_stage(solver.problem(), solver.state().stage);
  Value sum = Value::Zero();
  int count = 0;
  for (const auto& inside : probe.elements) {
    if (!there.empty() && there[static_cast<std::size_t>(inside.element)] == 0) continue;
    sum += of(inside);
    ++count;
  }
  if (count == 0) return Value::Constant(std::numeric_limits<double>::quiet_NaN());
  return sum / count;
}

}  // namespace

template <int dim>
Probe<dim> find_place(const Mesh<dim>& mesh, const typename Cosserat<dim>::Place& place) {
  Probe<dim> probe;
  for (int e = 0; e < static_cast<int>(mesh.elements.size()); ++e) {
    const VectorRows<dim> nodes = mesh.element_positions(e);
    const typename Cosserat<dim>::Place low = nodes.colwise().minCoeff();
    const typename Cosserat<dim>::Place high = nodes.colwise().maxCoeff();
    const double near = 0.1 * (high - low).norm();  // curved sides may bulge beyond their nodes
    if (((place - low).array() < -near).any() || ((place - high).array() > near).any()) continue;
    const ElementType<dim>& type = *mesh.elements[static_cast<std::size_t>(e)].type;
    if (const auto reference = reference_of<dim>(type, nodes, place))
      probe.elements.push_back({e, *reference});
  }
  return probe;
}

template <int dim>
typename Cosserat<dim>::NodeValues displacement_at(const Solver<dim>& solver, const Probe<dim>& probe) {
  using Values = typename Cosserat<dim>::NodeValues;
  const Eigen::VectorXd shown = solver.shown_displacement();
  return mean<Values>(solver, probe, [&](const auto& inside) {
    const Element<dim>& element = solver.problem().mesh.elements[static_cast<std::size_t>(inside.element)];
    const Eigen::VectorXd shape = element.type->shape_functions(inside.reference).value;
    Values value = Values::Zero();
    for (std::size_t a = 0; a < element.nodes.size(); ++a)
      value += shape(static_cast<Eigen::Index>(a)) *
               shown.template segment<Cosserat<dim>::dofs>(entry_of<dim>(element.nodes[a]));
    return value;
  });
}

template <int dim>
typename Cosserat<dim>::Vector stress_at(const Solver<dim>& solver, const Probe<dim>& probe) {
  using Vector = typename Cosserat<dim>::Vector;
  std::vector<std::size_t> first(solver.problem().mesh.elements.size(), 0);
  for (std::size_t point = solver.points(); point-- > 0;)
    first[static_cast<std::size_t>(solver.element_of_point(point))] = point;
  return mean<Vector>(solver, probe, [&](const auto& inside) {
    const auto number = static_cast<std::size_t>(inside.element);
    const ElementType<dim>& type = *solver.problem().mesh.elements[number].type;
    const Eigen::RowVectorXd weights = extrapolation_to<dim>(type, {inside.reference}).row(0);
    Vector value = Vector::Zero();
    for (std::size_t p = 0; p < type.quadrature.size(); ++p)
      value += weights(static_cast<Eigen::Index>(p)) * solver.state().responses[first[number] + p].stress;
    return value;
  });
}

template Probe<2> find_place<2>(const Mesh<2>&, const Eigen::Vector2d&);
template Probe<3> find_place<3>(const Mesh<3>&, const Eigen::Vector3d&);
template Cosserat<2>::NodeValues displacement_at<2>(const Solver<2>&, const Probe<2>&);
template Cosserat<3>::NodeValues displacement_at<3>(const Solver<3>&, const Probe<3>&);
template Vector7 stress_at<2>(const Solver<2>&, const Probe<2>&);
template Vector18 stress_at<3>(const Solver<3>&, const Probe<3>&);

}  // namespace polargrain::fem
