// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/solver/constraints.hpp"

#include "fem/element/dofs.hpp"

namespace polargrain::fem {

Constraints::Constraints(const Mesh& mesh, Continuum continuum, const std::vector<PrescribedDof>& prescribed)
    : equation_(entry_of(mesh.nodes.size()), 0) {
  for (const PrescribedDof& item : prescribed) {
    for (const int node : mesh.nodes_on(item.on)) {
      const auto number = static_cast<std::size_t>(node);
      const std::size_t entry = entry_of(number, item.dof);
      // What is given twice is given alike (checked by faults); the first one stands.
      if (equation_[entry] < 0) continue;
      equation_[entry] = -1;
      given_.push_back({entry, item.profile ? item.profile(mesh.nodes[number]) : 1.0, &item.value});
    }
  }
  if (continuum == Continuum::cauchy) {
    for (std::size_t node = 0; node < mesh.nodes.size(); ++node) equation_[entry_of(node, Dof::w)] = -1;
  }
  for (int& equation : equation_) {
    if (equation >= 0) equation = unknowns_++;
  }
}

void Constraints::apply(double time, Eigen::VectorXd& nodal) const {
  for (const Given& item : given_) {
    nodal(static_cast<Eigen::Index>(item.entry)) = item.factor * item.value->at(time);
  }
}

Eigen::VectorXd Constraints::slope(double time) const {
  Eigen::VectorXd nodal = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(equation_.size()));
  for (const Given& item : given_) {
    nodal(static_cast<Eigen::Index>(item.entry)) = item.factor * item.value->slope(time);
  }
  return nodal;
}

Eigen::VectorXd Constraints::restrict_to_free(const Eigen::VectorXd& nodal) const {
  Eigen::VectorXd unknowns(unknowns_);
  for (std::size_t entry = 0; entry < equation_.size(); ++entry) {
    if (equation_[entry] >= 0) unknowns(equation_[entry]) = nodal(static_cast<Eigen::Index>(entry));
  }
  return unknowns;
}

void Constraints::add_free(const Eigen::VectorXd& unknowns, Eigen::VectorXd& nodal) const {
  for (std::size_t entry = 0; entry < equation_.size(); ++entry) {
    if (equation_[entry] >= 0) nodal(static_cast<Eigen::Index>(entry)) += unknowns(equation_[entry]);
  }
}

}  // namespace polargrain::fem
