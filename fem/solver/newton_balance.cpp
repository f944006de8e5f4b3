// SPDX-License-Identifier: GPL-2.0-or-later
// Whether an iterate is a place to stop at: balanced, and not one where nothing can be told from rounding.
#include <algorithm>

#include "fem/element/dofs.hpp"
#include "fem/material/polar_decomposition.hpp"
#include "fem/material/rotation.hpp"
#include "fem/solver/newton.hpp"
#include "fem/solver/residual_floor.hpp"

namespace polargrain::fem {

template <int dim>
bool Newton<dim>::has_gone_astray() const {
  return std::any_of(increments_.begin(), increments_.end(), [](const Increment<dim>& increment) {
    return stretch_and_turn(increment)
               .stretch.strain()
               .template head<Cosserat<dim>::stresses>()
               .cwiseAbs()
               .maxCoeff() > 1.0;
  });
}

// A body that nothing holds any more, as where all points of an interface slip, is sent so far by one iteration that forces are
// lost in the rounding of places: any imbalance would pass.
template <int dim>
bool Newton<dim>::is_out_of_sight(const Eigen::VectorXd& increment) const {
  constexpr double kSight = 1e3;  // sizes of the body
  double moved = 0.0;
  for (std::size_t node = 0; node < problem.mesh.nodes.size(); ++node) {
    const auto entry = static_cast<Eigen::Index>(entry_of<dim>(node, Dof::u1));
    moved = std::max(moved, increment.template segment<dim>(entry).cwiseAbs().maxCoeff());
  }
  return !(moved <= kSight * body_size_);
}

template <int dim>
Newton<dim>::Balance Newton<dim>::balance_of(const Iterate& iterate, bool last_chance) const {
  const Residual& residual = iterate.residual;
  if (is_out_of_sight(iterate.displacement)) return Balance::none;
  if (excess(residual) <= 1.0) return Balance::within_tolerance;
  const auto within = [&](const Eigen::VectorXd& forces, double factor) {
    const Residual floor = relative(forces);
    for (std::size_t k = 0; k < residual.fields.size(); ++k)
      if (!(residual.fields[k] <= problem.fields[k].tolerance)) return false;
    return residual.force <= std::max(options.force_tolerance, factor * floor.force) &&
           residual.moment <= std::max(options.moment_tolerance, factor * floor.moment);
  };
  if (options.noise_factor > 0.0) {
    const Eigen::VectorXd noise = forces_of_noise<dim>(discretisation, problem.continuum, trial_);
    if (noise.size() > 0 && within(noise, options.noise_factor)) return Balance::within_noise;
  }
  // The stresses of such strains round so much that any imbalance would pass.
  if (last_chance && !has_gone_astray() &&
      within(forces_of_rounding<dim>(discretisation, problem.continuum, trial_, iterate.displacement), 1.0)) {
    return Balance::within_rounding;
  }
  return Balance::none;
}

template bool Newton<2>::has_gone_astray() const;
template bool Newton<3>::has_gone_astray() const;
template bool Newton<2>::is_out_of_sight(const Eigen::VectorXd&) const;
template bool Newton<3>::is_out_of_sight(const Eigen::VectorXd&) const;
template Newton<2>::Balance Newton<2>::balance_of(const Iterate&, bool) const;
template Newton<3>::Balance Newton<3>::balance_of(const Iterate&, bool) const;

}  // namespace polargrain::fem
