// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/output/probe.hpp"

#include <limits>

#include "fem/element/kinematics.hpp"
#include "fem/output/smooth.hpp"

namespace polargrain::fem {
namespace {

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

template Cosserat<2>::NodeValues displacement_at<2>(const Solver<2>&, const Probe<2>&);
template Cosserat<3>::NodeValues displacement_at<3>(const Solver<3>&, const Probe<3>&);
template Vector7 stress_at<2>(const Solver<2>&, const Probe<2>&);
template Vector18 stress_at<3>(const Solver<3>&, const Probe<3>&);

}  // namespace polargrain::fem
