// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include "fem/solver/constraints.hpp"
#include "fem/solver/problem.hpp"

namespace polargrain::fem {

/// The given displacements that make a base of a body along an axis.
template <int dim>
struct BaseAlong {
  /// The first that is accelerated, or else the first of all where all move alike; null where there is no base.
  const PrescribedDof<dim>* item = nullptr;
  /// The first that moves or holds the body in another way; null where all move alike.
  const PrescribedDof<dim>* other = nullptr;
};

/// Quiet boundaries do not count: values given there end with the balance at the start.
/// @param dof a displacement
template <int dim>
BaseAlong<dim> base_along(const Problem<dim>& problem, int stage, Dof dof) {
  std::vector<const PrescribedDof<dim>*> items = in_precedence(problem, stage);
  std::erase_if(items, [&](const PrescribedDof<dim>* item) {
    return item->dof != dof || std::ranges::find(problem.quiet, item->on) != problem.quiet.end();
  });
  const auto first = [&](auto is_meant) {
    const auto found = std::ranges::find_if(items, is_meant);
    return found == items.end() ? nullptr : *found;
  };
  BaseAlong<dim> base;
  base.item = first([](const PrescribedDof<dim>* item) { return item->value.is_accelerated(); });
  if (base.item == nullptr)
    base.item = first([](const PrescribedDof<dim>* item) { return item->value.changes(); });
  if (base.item == nullptr) return base;
  base.other = first([&](const PrescribedDof<dim>* item) {
    return item->profile != nullptr || !(item->value == base.item->value);
  });
  // A plate that is pushed towards a support shakes nothing: the support is the base, and it stands.
  if (base.other != nullptr && !base.item->value.is_accelerated()) return {};
  return base;
}

/// The motion of the base that shakes a body: along each axis that of `accelerate` or `move`, where no support moves otherwise;
/// else there is no base along that axis.
template <int dim>
class BaseMotion {
 public:
  /// @param problem must outlive this object
  BaseMotion(const Problem<dim>& problem, const Constraints<dim>& constraints, int stage)
      : unknowns_(constraints.unknowns()) {
    for (const Dof dof : node_dofs<dim>()) {
      if (is_rotation(dof)) continue;
      const BaseAlong<dim> base = base_along(problem, stage, dof);
      if (base.item == nullptr || base.other != nullptr) continue;
      Axis& axis = axes_.emplace_back(Axis{&base.item->value, {}});
      for (std::size_t node = 0; node < problem.mesh.nodes.size(); ++node)
        if (const int equation = constraints.equation(entry_of<dim>(node, dof)); equation >= 0)
          axis.equations.push_back(equation);
    }
  }

  /// That all unknowns would have if the body moved along as a block, m/s, in the order of the equations.
  [[nodiscard]] Eigen::VectorXd velocity(double time) const {
    Eigen::VectorXd all = Eigen::VectorXd::Zero(unknowns_);
    for (const Axis& axis : axes_) {
      const double speed = axis.displacement->slope(time);
      for (const int equation : axis.equations) all(equation) = speed;
    }
    return all;
  }

 private:
  struct Axis {
    const TimeTable* displacement;
    std::vector<int> equations;
  };
  int unknowns_;
  std::vector<Axis> axes_;
};

}  // namespace polargrain::fem
