// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "common/cosserat.hpp"
#include "fem/solver/stages.hpp"
#include "fem/solver/time_table.hpp"

namespace polargrain::fem {

/// A scalar field at nodes beside displacements and micro-rotations: pore pressure, temperature. Its unknowns stand behind the
/// entries of node_dofs in every nodal vector (FieldPlaces). Contributions (contribution.hpp) give it its balance.
struct NodalField {
  std::string name;        ///< "p"; one problem has no two fields of one name
  std::string unit;        ///< of its values
  std::vector<int> nodes;  ///< that carry an unknown, each once
  /// Of its residual: the sum of its absolute unbalanced rows over the sum of the absolute parts of all its rows
  /// (NodalForces::parts).
  double tolerance = 1e-8;
  std::vector<double> initial = {};  ///< values at time 0, one a node of `nodes`; zero when empty
  bool tied = false;                 ///< whether a Tie joins its values too
  /// Elements of the mesh whose corners carry it. A node is no unknown in a stage without its elements; it keeps its last
  /// value. Empty: every node is one in every stage.
  std::vector<int> elements = {};
  bool is_motion = false;  ///< of the body, as displacements are: its rows times its values are work
};

/// Given values of a field, as PrescribedDof gives displacements: table times profile, plus offset. Nodes without an unknown of
/// the field are passed over.
template <int dim>
struct PrescribedField {
  using ByPlace = std::function<double(const typename Cosserat<dim>::Place&)>;
  std::string field;
  std::string on;  ///< boundary or node set
  TimeTable value;
  ByPlace profile = {};  ///< 1 everywhere when empty
  ByPlace offset = {};   ///< 0 everywhere when empty
  Lifetime life = {};
  bool from_here = false;  ///< as of PrescribedDof

  [[nodiscard]] double factor_at(const typename Cosserat<dim>::Place& x) const {
    return profile ? profile(x) : 1.0;
  }
  [[nodiscard]] double offset_at(const typename Cosserat<dim>::Place& x) const {
    return offset ? offset(x) : 0.0;
  }
};

/// Where nodal vectors keep the fields: displacements and micro-rotations of all nodes first, then the nodes of each field in turn.
template <int dim>
class FieldPlaces {
 public:
  FieldPlaces(std::size_t mesh_nodes, const std::vector<NodalField>& fields);

  /// Length of nodal vectors.
  [[nodiscard]] Eigen::Index size() const { return starts_.back(); }
  /// Number of the entries of displacements and micro-rotations, which come first.
  [[nodiscard]] Eigen::Index mechanics() const { return starts_.front(); }
  [[nodiscard]] std::size_t fields() const { return entries_.size(); }
  /// Entries of a field: start(field) ... start(field + 1) - 1, in the order of NodalField::nodes.
  [[nodiscard]] Eigen::Index start(std::size_t field) const { return starts_[field]; }
  /// Where the value of a field at a node is; -1 where the node lacks the field.
  [[nodiscard]] int entry(std::size_t field, int node) const {
    return entries_[field][static_cast<std::size_t>(node)];
  }

 private:
  std::vector<Eigen::Index> starts_;
  std::vector<std::vector<int>> entries_;  ///< by field and node of the mesh
};

/// Number of a field among others. @returns the number of fields when no field has that name
std::size_t number_of_field(const std::vector<NodalField>& fields, const std::string& name);

}  // namespace polargrain::fem
