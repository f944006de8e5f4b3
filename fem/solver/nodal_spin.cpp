// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/solver/nodal_spin.hpp"

#include "fem/element/dofs.hpp"

namespace polargrain::fem {
namespace {

/// Of an element, times its volume.
template <int dim>
struct Spin {
  typename Cosserat<dim>::Rotation sum = Cosserat<dim>::Rotation::Zero();
  double volume = 0.0;
};

template <int dim>
Spin<dim> spin_of(const Element<dim>& element, const Discretisation<dim>& discretisation, std::size_t e,
                  const Eigen::VectorXd& moved) {
  VectorRows<dim> nodes(static_cast<Eigen::Index>(element.nodes.size()), dim);
  for (std::size_t a = 0; a < element.nodes.size(); ++a)
    nodes.row(static_cast<Eigen::Index>(a)) =
        moved.template segment<dim>(static_cast<Eigen::Index>(entry_of<dim>(element.nodes[a])));
  Spin<dim> spin;
  for (std::size_t i = discretisation.first_point(e); i < discretisation.first_point(e + 1); ++i) {
    const PointGeometry<dim>& point = discretisation.point(i);
    const typename Cosserat<dim>::Gradient gradient = nodes.transpose() * point.gradient;
    for (int k = 0; k < Cosserat<dim>::rotations; ++k) {
      const int first = (Cosserat<dim>::axis(k) + 1) % 3;
      const int second = (Cosserat<dim>::axis(k) + 2) % 3;
      spin.sum(k) += point.volume * 0.5 * (gradient(second, first) - gradient(first, second));
    }
    spin.volume += point.volume;
  }
  return spin;
}

}  // namespace

template <int dim>
Eigen::VectorXd nodal_spin(const Problem<dim>& problem, const Discretisation<dim>& discretisation,
                           const Constraints<dim>& constraints, const Eigen::VectorXd& moved) {
  Eigen::VectorXd spin = Eigen::VectorXd::Zero(constraints.unknowns());
  if (problem.continuum == Continuum::cauchy) return spin;
  Eigen::VectorXd volume = Eigen::VectorXd::Zero(constraints.unknowns());
  for (std::size_t e = 0; e < discretisation.elements(); ++e) {
    if (!discretisation.is_there(e)) continue;
    const Element<dim>& element = problem.mesh.elements[e];
    const Spin<dim> here = spin_of(element, discretisation, e, moved);
    for (const int node : element.nodes)
      for (int k = 0; k < Cosserat<dim>::rotations; ++k) {
        const std::size_t entry =
            static_cast<std::size_t>(entry_of<dim>(node)) + static_cast<std::size_t>(dim + k);
        if (!constraints.is_free(entry)) continue;
        spin(constraints.equation(entry)) += here.sum(k);
        volume(constraints.equation(entry)) += here.volume;
      }
  }
  for (Eigen::Index k = 0; k < spin.size(); ++k)
    if (volume(k) > 0.0) spin(k) /= volume(k);
  return spin;
}

template Eigen::VectorXd nodal_spin<2>(const Problem<2>&, const Discretisation<2>&, const Constraints<2>&,
                                       const Eigen::VectorXd&);
template Eigen::VectorXd nodal_spin<3>(const Problem<3>&, const Discretisation<3>&, const Constraints<3>&,
                                       const Eigen::VectorXd&);

}  // namespace polargrain::fem
