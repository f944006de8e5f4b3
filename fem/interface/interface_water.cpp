// SPDX-License-Identifier: GPL-2.0-or-later
// Pore water at interfaces: the law takes the effective stress, and the water between the sides pushes both of them. Its flow
// across a curve is WaterAcross (fem/water).
#include <algorithm>

#include "fem/interface/interface.hpp"
#include "fem/solver/problem.hpp"
#include "fem/water/pore_water.hpp"

namespace polargrain::fem {

template <int dim>
bool Interface<dim>::is_dry() const {
  return std::ranges::all_of(elements_, [](const Element& element) { return element.pressures.empty(); });
}

template <int dim>
void Interface<dim>::take_water(const Problem<dim>& problem) {
  const std::size_t field = number_of_field(problem.fields, kPorePressure);
  if (field == problem.fields.size()) return;
  const FieldPlaces<dim> places = problem.places();
  const std::vector<int>& wet = problem.fields[field].elements;
  const auto holds_water = [&](const std::vector<int>& neighbours, std::size_t side) {
    return side < neighbours.size() && std::ranges::binary_search(wet, neighbours[side]);
  };
  for (Element& element : elements_) {
    const InterfaceFace<dim>& face = element.face;
    const auto nodes = static_cast<Eigen::Index>(face.nodes_a.size());
    const auto corners = static_cast<Eigen::Index>(face.type->corners);
    double sides = 0.0;
    for (const std::size_t side : {0U, 1U}) {
      if (!holds_water(face.neighbours, side)) continue;
      sides += 1.0;
      const std::vector<int>& numbers = side == 0 ? face.nodes_a : face.nodes_b;
      for (Eigen::Index a = 0; a < corners; ++a)
        element.pressures.push_back(
            place_of(element, places.entry(field, numbers[static_cast<std::size_t>(a)])));
    }
    if (sides == 0.0) continue;
    const auto pressures = static_cast<Eigen::Index>(element.pressures.size());
    element.push.setZero(2 * dim * nodes, pressures);
    for (Point& point : element.points) {
      point.wet_shape.resize(pressures);
      for (Eigen::Index k = 0; k < pressures; ++k)
        point.wet_shape(k) = point.geometry.corner_shape(k % corners) / sides;
      const typename Cosserat<dim>::Place normal = point.geometry.axes.row(dim - 1).transpose();
      for (Eigen::Index a = 0; a < nodes; ++a) {
        const Eigen::MatrixXd pushed =
            (point.geometry.area * point.geometry.shape(a)) * normal * point.wet_shape.transpose();
        element.push.middleRows(dim * a, dim) += pushed;
        element.push.middleRows(dim * (nodes + a), dim) -= pushed;
      }
    }
  }
}

template <int dim>
double Interface<dim>::pressure_at(const Element& element, const Point& point,
                                   const Eigen::VectorXd& values) {
  return element.pressures.empty() ? 0.0 : point.wet_shape.dot(values(element.pressures));
}

template <int dim>
void Interface<dim>::add_water(const Element& element, const NodalStep& step, NodalForces& forces) {
  if (element.pressures.empty()) return;
  constexpr double kRounding =
      1e-6;  // NodalForces::parts: the gap is a small difference of two displacements
  const Eigen::VectorXd values = step.end(element.entries);
  const Eigen::VectorXd increments = step.increment(element.entries);
  const std::vector<int> displaced(element.places.begin(), element.places.begin() + element.push.rows());
  const Eigen::VectorXd pushed = element.push * values(element.pressures);
  for (std::size_t k = 0; k < displaced.size(); ++k)
    forces.internal(element.entries[static_cast<std::size_t>(displaced[k])]) +=
        pushed(static_cast<Eigen::Index>(k));
  const Eigen::VectorXd moved = increments(displaced);
  const Eigen::VectorXd taken = element.push.transpose() * moved;
  const Eigen::VectorXd parts =
      taken.cwiseAbs() + kRounding * (element.push.cwiseAbs().transpose() * moved.cwiseAbs());
  for (std::size_t k = 0; k < element.pressures.size(); ++k) {
    const int entry = element.entries[static_cast<std::size_t>(element.pressures[k])];
    forces.internal(entry) += taken(static_cast<Eigen::Index>(k));
    forces.parts(entry) += parts(static_cast<Eigen::Index>(k));
  }
}

template <int dim>
void Interface<dim>::add_water_tangent(const Element& element, Eigen::MatrixXd& tangent) {
  for (Eigen::Index i = 0; i < element.push.rows(); ++i)
    for (Eigen::Index k = 0; k < element.push.cols(); ++k) {
      const int displaced = element.places[static_cast<std::size_t>(i)];
      const int pressed = element.pressures[static_cast<std::size_t>(k)];
      tangent(displaced, pressed) += element.push(i, k);
      tangent(pressed, displaced) += element.push(i, k);
    }
}

template bool Interface<2>::is_dry() const;
template bool Interface<3>::is_dry() const;
template void Interface<2>::take_water(const Problem<2>&);
template void Interface<3>::take_water(const Problem<3>&);
template double Interface<2>::pressure_at(const Element&, const Point&, const Eigen::VectorXd&);
template double Interface<3>::pressure_at(const Element&, const Point&, const Eigen::VectorXd&);
template void Interface<2>::add_water(const Element&, const NodalStep&, NodalForces&);
template void Interface<3>::add_water(const Element&, const NodalStep&, NodalForces&);
template void Interface<2>::add_water_tangent(const Element&, Eigen::MatrixXd&);
template void Interface<3>::add_water_tangent(const Element&, Eigen::MatrixXd&);

}  // namespace polargrain::fem
