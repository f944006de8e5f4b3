// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <vector>

#include "fem/solver/problem.hpp"

namespace polargrain::fem {

template <int dim>
struct SolverState;

/// Which entries of a nodal vector are given, which are unknown, and which share an unknown.
template <int dim>
class Constraints {
 public:
  /// @param problem without faults; must outlive this object.
  explicit Constraints(const Problem<dim>& problem) : Constraints(problem, 0, {}) {}
  /// The constraints of a stage of construction. Nodes without an element have no unknowns and keep their values.
  /// @param offsets of given values, by entry of a nodal vector (new_offsets); may be empty in stage 0
  Constraints(const Problem<dim>& problem, int stage, const Eigen::VectorXd& offsets);

  /// The offsets when a stage begins: an entry that another item gives from now on is where it is, less the value of that
  /// item. An entry of a field that no item gave before takes its value at once, unless the item counts from here.
  /// @param state of the stage before @param stage that begins
  static Eigen::VectorXd new_offsets(const Problem<dim>& problem, const SolverState<dim>& state, int stage);

  /// Where nodal vectors keep the fields of the problem.
  [[nodiscard]] const FieldPlaces<dim>& places() const { return places_; }
  /// Number of unknowns: displacements and rotations, then those of fields, then what has been released.
  [[nodiscard]] int unknowns() const { return unknowns_; }
  [[nodiscard]] int mechanical_unknowns() const { return mechanical_unknowns_; }
  [[nodiscard]] int field_unknowns() const { return field_unknowns_; }
  /// Number of the unknown at an entry of a nodal vector; -1 where the entry is given.
  [[nodiscard]] int equation(std::size_t entry) const { return equation_[entry]; }
  [[nodiscard]] bool is_free(std::size_t entry) const { return equation_[entry] >= 0; }
  /// Entries that are given since one that they are tied to is, and that one: a reaction there belongs to its support.
  [[nodiscard]] const std::vector<std::pair<std::size_t, std::size_t>>& carried() const { return carried_; }

  /// Makes given displacements unknowns, behind those there are. @param entries of nodal vectors, those tied to them too; free
  /// ones stay as they are
  void release(const std::vector<std::size_t>& entries);

  /// Overwrites the given entries of a nodal vector by their values at `time`.
  /// @param released share of the way from where they were to values that do not count from there
  void apply(double time, Eigen::VectorXd& nodal, double released = 1.0) const;

  /// Nodal vector: change per time of the given entries just after `time`, zero at the free ones.
  [[nodiscard]] Eigen::VectorXd slope(double time) const;

  /// Nodal vector: the given entries at their largest magnitude at any time, zero at the free ones.
  [[nodiscard]] Eigen::VectorXd largest() const;

  /// Forces on the unknowns, in the order of the equations: the free entries of nodal forces, summed where entries
  /// share an unknown.
  [[nodiscard]] Eigen::VectorXd restrict_to_free(const Eigen::VectorXd& forces) const;
  /// Nodal forces, those of entries that share an unknown summed at the first of them and zero at the others: forces
  /// in a tie balance each other and are no imbalance.
  [[nodiscard]] Eigen::VectorXd folded(const Eigen::VectorXd& forces) const;
  /// Adds values of the unknowns to the free entries of a nodal vector.
  void add_free(const Eigen::VectorXd& unknowns, Eigen::VectorXd& nodal) const;

 private:
  struct Given {
    std::size_t entry;
    double factor;
    const TimeTable* value;
    double offset = 0.0;
    double fading = 0.0;  ///< an offset that goes as `released` grows
  };
  FieldPlaces<dim> places_;
  std::vector<Given> given_;
  std::vector<std::pair<std::size_t, std::size_t>> carried_;
  std::vector<int> equation_;
  std::vector<std::size_t> first_;   ///< of each equation: the entry where forces are summed
  std::vector<std::size_t> leader_;  ///< of each entry: the one that it moves with, itself without a tie
  bool has_ties_;
  int unknowns_ = 0;
  int mechanical_unknowns_ = 0;
  int field_unknowns_ = 0;
};

}  // namespace polargrain::fem
