// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/solver/constraints.hpp"

#include <algorithm>
#include <map>
#include <numeric>

#include "fem/element/dofs.hpp"
#include "fem/solver/solver.hpp"
#include "fem/solver/ties_entries.hpp"

namespace polargrain::fem {
namespace {

template <int dim>
bool has_absent_contributions(const Problem<dim>& problem, int stage, const std::vector<char>& there) {
  return std::ranges::any_of(problem.contributions, [&](const auto& contribution) {
    for (std::size_t e = 0; e < contribution->elements(); ++e)
      if (!contribution->is_there(e, stage, there)) return true;
    return false;
  });
}

}  // namespace

template <int dim>
Constraints<dim>::Constraints(const Problem<dim>& problem, int stage, const Eigen::VectorXd& offsets)
    : places_(problem.places()),
      equation_(static_cast<std::size_t>(places_.size()), 0),
      has_ties_(!problem.ties.empty() || !problem.equal_dofs.empty()) {
  const Mesh<dim>& mesh = problem.mesh;
  for (const PrescribedDof<dim>* const given : in_precedence(problem, stage)) {
    const PrescribedDof<dim>& item = *given;
    for (const int node : mesh.nodes_on(item.on)) {
      const auto number = static_cast<std::size_t>(node);
      const std::size_t entry = entry_of<dim>(number, item.dof);
      // Two items of equal rank give one entry the same value (checked by faults); the first one stands.
      if (equation_[entry] < 0) continue;
      equation_[entry] = -1;
      Given& value = given_.emplace_back(
          Given{entry, item.profile ? item.profile(mesh.nodes[number]) : 1.0, &item.value});
      if (offsets.size() == 0) continue;
      (item.from_here ? value.offset : value.fading) = offsets(static_cast<Eigen::Index>(entry));
    }
  }
  for (const PrescribedField<dim>* const item : fields_in_precedence(problem, stage)) {
    const std::size_t field = number_of_field(problem.fields, item->field);
    for (const int node : mesh.nodes_on(item->on)) {
      const int entry = places_.entry(field, node);
      if (entry < 0 || equation_[static_cast<std::size_t>(entry)] < 0) continue;
      equation_[static_cast<std::size_t>(entry)] = -1;
      const typename Cosserat<dim>::Place& place = mesh.nodes[static_cast<std::size_t>(node)];
      Given& value = given_.emplace_back(Given{static_cast<std::size_t>(entry), item->factor_at(place),
                                               &item->value, item->offset_at(place)});
      if (offsets.size() > 0) (item->from_here ? value.offset : value.fading) += offsets(entry);
    }
  }
  const auto mechanics = static_cast<std::size_t>(places_.mechanics());
  if (problem.continuum == Continuum::cauchy) {
    for (std::size_t entry = 0; entry < mechanics; ++entry)
      if (is_rotation(dof_at<dim>(entry))) equation_[entry] = -1;
  }
  // Of entries that are tied, over any number of ties, the lowest number stands for all.
  std::vector<std::size_t> root(equation_.size());
  std::iota(root.begin(), root.end(), std::size_t{0});
  const auto find = [&](std::size_t entry) {
    while (root[entry] != entry) entry = root[entry];
    return entry;
  };
  const auto join = [&](std::size_t one, std::size_t other) {
    const std::size_t a = find(one);
    const std::size_t b = find(other);
    root[std::max(a, b)] = std::min(a, b);
  };
  for (const Tie& tie : problem.ties) {
    for (const auto& [follower, leader] : tied_nodes<dim>(mesh, tie).pairs) {
      for (const Dof dof : node_dofs<dim>())
        join(entry_of<dim>(static_cast<std::size_t>(follower), dof),
             entry_of<dim>(static_cast<std::size_t>(leader), dof));
      for (std::size_t field = 0; field < problem.fields.size(); ++field) {
        const int one = places_.entry(field, follower);
        const int other = places_.entry(field, leader);
        if (problem.fields[field].tied && one >= 0 && other >= 0)
          join(static_cast<std::size_t>(one), static_cast<std::size_t>(other));
      }
    }
  }
  std::vector<std::size_t> tied;
  const std::vector<char> has_element = nodes_of_elements(mesh, {});
  for (const auto& contribution : problem.contributions) {
    for (const auto& [one, other] : contribution->tied_nodes(stage)) {
      has_ties_ = true;
      for (const Dof dof : node_dofs<dim>()) {
        const auto first = entry_of<dim>(static_cast<std::size_t>(one), dof);
        const auto second = entry_of<dim>(static_cast<std::size_t>(other), dof);
        join(first, second);
        tied.insert(tied.end(), {first, second});
      }
    }
    const auto* const ties = dynamic_cast<const TiesEntries*>(contribution.get());
    if (ties == nullptr) continue;
    for (const auto& [one, other] : ties->tied_entries(stage)) {
      has_ties_ = true;
      join(static_cast<std::size_t>(one), static_cast<std::size_t>(other));
      tied.insert(tied.end(), {static_cast<std::size_t>(one), static_cast<std::size_t>(other)});
    }
  }
  for (const EqualDof& equal : problem.equal_dofs) {
    const std::vector<int> nodes = mesh.nodes_on(equal.on);
    for (const int node : nodes)
      join(entry_of<dim>(static_cast<std::size_t>(nodes.front()), equal.dof),
           entry_of<dim>(static_cast<std::size_t>(node), equal.dof));
  }
  leader_.resize(equation_.size());
  for (std::size_t entry = 0; entry < equation_.size(); ++entry) leader_[entry] = find(entry);
  // Entries that share a value with one that is given are given it too. Supports of a wall's own nodes do not hold the ground
  // around a wall that has not come yet.
  std::map<std::size_t, Given> given_at;  // by leader, the first one
  if (!tied.empty())
    for (const Given& item : given_)
      if (item.entry >= mechanics || has_element[item.entry / Cosserat<dim>::dofs] != 0)
        given_at.try_emplace(leader_[item.entry], item);
  for (const std::size_t entry : tied) {
    const auto given = given_at.find(leader_[entry]);
    if (given == given_at.end() || equation_[entry] < 0) continue;
    equation_[entry] = -1;
    carried_.emplace_back(entry, given->second.entry);
    given_.push_back(given->second);
    given_.back().entry = entry;
  }
  if (const std::vector<char> there = elements_in_stage(problem, stage);
      !there.empty() || has_absent_contributions(problem, stage, there)) {
    // An unknown that no element knows: neither at its own node nor at those tied to it.
    const std::vector<char> nodes = nodes_of_elements(mesh, there);
    std::vector<char> known(equation_.size(), 0);
    for (std::size_t entry = 0; entry < mechanics; ++entry)
      if (nodes[entry / Cosserat<dim>::dofs] != 0) known[leader_[entry]] = 1;
    for (const auto& contribution : problem.contributions)
      for (std::size_t e = 0; e < contribution->elements(); ++e)
        if (contribution->is_there(e, stage, there))
          for (const int entry : contribution->entries(e))
            known[leader_[static_cast<std::size_t>(entry)]] = 1;
    for (std::size_t entry = 0; entry < equation_.size(); ++entry)
      if (known[leader_[entry]] == 0) equation_[entry] = -1;
  }
  for (std::size_t entry = 0; entry < equation_.size(); ++entry) {
    if (entry == mechanics) mechanical_unknowns_ = unknowns_;
    if (equation_[entry] < 0) continue;
    const std::size_t first = leader_[entry];
    if (first == entry) {
      equation_[entry] = unknowns_++;
      first_.push_back(entry);
    } else {
      equation_[entry] = equation_[first];
    }
  }
  if (mechanics == equation_.size()) mechanical_unknowns_ = unknowns_;
  field_unknowns_ = unknowns_ - mechanical_unknowns_;
}

template <int dim>
void Constraints<dim>::release(const std::vector<std::size_t>& entries) {
  for (const std::size_t entry : entries) {
    std::erase_if(given_, [entry](const Given& item) { return item.entry == entry; });
    int& of_leader = equation_[leader_[entry]];
    if (of_leader < 0) {
      of_leader = unknowns_++;
      first_.push_back(leader_[entry]);
    }
    equation_[entry] = of_leader;
  }
}

template <int dim>
Eigen::VectorXd Constraints<dim>::new_offsets(const Problem<dim>& problem, const SolverState<dim>& state,
                                              int stage) {
  struct Giver {
    const void* item = nullptr;
    const TimeTable* value = nullptr;
    double factor = 1.0;
    double offset = 0.0;
    bool from_here = false;

    [[nodiscard]] double at(double time) const { return factor * value->at(time) + offset; }
  };
  const FieldPlaces<dim> places = problem.places();
  const auto givers_in = [&](int of) {
    std::vector<Giver> givers(static_cast<std::size_t>(state.displacement.size()));
    for (const PrescribedDof<dim>* const item : in_precedence(problem, of)) {
      for (const int node : problem.mesh.nodes_on(item->on)) {
        const auto number = static_cast<std::size_t>(node);
        Giver& giver = givers[entry_of<dim>(number, item->dof)];
        if (giver.item != nullptr) continue;
        giver = {item, &item->value, item->profile ? item->profile(problem.mesh.nodes[number]) : 1.0, 0.0,
                 item->from_here};
      }
    }
    for (const PrescribedField<dim>* const item : fields_in_precedence(problem, of)) {
      const std::size_t field = number_of_field(problem.fields, item->field);
      for (const int node : problem.mesh.nodes_on(item->on)) {
        const int entry = places.entry(field, node);
        if (entry < 0 || givers[static_cast<std::size_t>(entry)].item != nullptr) continue;
        const typename Cosserat<dim>::Place& place = problem.mesh.nodes[static_cast<std::size_t>(node)];
        givers[static_cast<std::size_t>(entry)] = {item, &item->value, item->factor_at(place),
                                                   item->offset_at(place), item->from_here};
      }
    }
    return givers;
  };
  const std::vector<Giver> before = givers_in(state.stage);
  const std::vector<Giver> now = givers_in(stage);
  Eigen::VectorXd offsets = Eigen::VectorXd::Zero(state.displacement.size());
  for (std::size_t k = 0; k < now.size(); ++k) {
    if (now[k].item == nullptr) continue;
    const auto entry = static_cast<Eigen::Index>(k);
    if (entry >= places.mechanics() && before[k].item == nullptr && !now[k].from_here) continue;
    if (now[k].item != before[k].item) {
      offsets(entry) = state.displacement(entry) - now[k].at(state.time);
    } else if (state.offsets.size() > 0 && now[k].from_here) {
      offsets(entry) = state.offsets(entry);
    }
  }
  return offsets;
}

template <int dim>
void Constraints<dim>::apply(double time, Eigen::VectorXd& nodal, double released) const {
  for (const Given& item : given_) {
    double& value = nodal(static_cast<Eigen::Index>(item.entry));
    value = item.factor * item.value->at(time);
    if (item.offset != 0.0) value += item.offset;
    if (item.fading != 0.0) value += (1.0 - released) * item.fading;
  }
}

template <int dim>
Eigen::VectorXd Constraints<dim>::slope(double time) const {
  Eigen::VectorXd nodal = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(equation_.size()));
  for (const Given& item : given_) {
    nodal(static_cast<Eigen::Index>(item.entry)) = item.factor * item.value->slope(time);
  }
  return nodal;
}

template <int dim>
Eigen::VectorXd Constraints<dim>::largest() const {
  Eigen::VectorXd nodal = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(equation_.size()));
  for (const Given& item : given_)
    nodal(static_cast<Eigen::Index>(item.entry)) = item.factor * item.value->largest_magnitude();
  return nodal;
}

template <int dim>
Eigen::VectorXd Constraints<dim>::restrict_to_free(const Eigen::VectorXd& forces) const {
  Eigen::VectorXd unknowns = Eigen::VectorXd::Zero(unknowns_);
  for (std::size_t entry = 0; entry < equation_.size(); ++entry) {
    if (equation_[entry] >= 0) unknowns(equation_[entry]) += forces(static_cast<Eigen::Index>(entry));
  }
  return unknowns;
}

template <int dim>
Eigen::VectorXd Constraints<dim>::folded(const Eigen::VectorXd& forces) const {
  if (!has_ties_) return forces;
  Eigen::VectorXd sums = forces;
  for (std::size_t entry = 0; entry < equation_.size(); ++entry) {
    if (equation_[entry] < 0) continue;
    const std::size_t first = first_[static_cast<std::size_t>(equation_[entry])];
    if (first == entry) continue;
    sums(static_cast<Eigen::Index>(first)) += forces(static_cast<Eigen::Index>(entry));
    sums(static_cast<Eigen::Index>(entry)) = 0.0;
  }
  return sums;
}

template <int dim>
void Constraints<dim>::add_free(const Eigen::VectorXd& unknowns, Eigen::VectorXd& nodal) const {
  for (std::size_t entry = 0; entry < equation_.size(); ++entry) {
    if (equation_[entry] >= 0) nodal(static_cast<Eigen::Index>(entry)) += unknowns(equation_[entry]);
  }
}

template class Constraints<2>;
template class Constraints<3>;

}  // namespace polargrain::fem
