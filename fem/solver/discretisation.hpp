// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "common/increment.hpp"
#include "common/response.hpp"
#include "fem/element/kinematics.hpp"
#include "fem/mesh/mesh.hpp"

namespace polargrain::fem {

template <int dim>
class Discretisation;

/// The base of a tangent: the answers of the points and, where the mesh moves along with the body, the
/// configurations they belong to.
template <int dim>
struct Linearisation {
  struct Moving {
    const Discretisation<dim>& start;               ///< the increments refer to it
    const std::vector<Increment<dim>>& increments;  ///< that led to the answers
  };
  const std::vector<Response<dim>>& answers;
  std::optional<Moving> moving = {};  ///< nothing: small deformation
};

/// The way between nodes and integration points: gathers increments, scatters stresses. Nodal vectors have the
/// entries of node_dofs for each node. Loops run in the order of the elements, so sums have the same bits every time.
template <int dim>
class Discretisation {
 public:
  /// @param mesh must outlive this object. @param field_entries of nodal vectors, behind the entries of node_dofs
  Discretisation(const Mesh<dim>& mesh, Continuum continuum, Eigen::Index field_entries = 0);

  /// From now on elements that are not there have increments of zero and no forces. @param there as elements_in_stage has it
  void set_there(std::vector<char> there) { there_ = std::move(there); }
  [[nodiscard]] bool is_there(std::size_t e) const { return there_.empty() || there_[e] != 0; }

  /// Moves the nodes to where `nodal` displaces them from the mesh as it was made.
  /// @return a message naming an element that this turns inside out; empty when all is well.
  [[nodiscard]] std::string move_to(const Eigen::VectorXd& nodal);

  [[nodiscard]] std::size_t points() const { return points_.size(); }
  [[nodiscard]] const PointGeometry<dim>& point(std::size_t i) const { return points_[i]; }
  [[nodiscard]] int element_of_point(std::size_t i) const { return element_of_point_[i]; }
  [[nodiscard]] std::size_t elements() const { return dofs_.size(); }
  /// Entries of a nodal vector.
  [[nodiscard]] Eigen::Index nodal_size() const { return nodal_size_; }
  /// Points of element e are first_point(e) ... first_point(e + 1) - 1.
  [[nodiscard]] std::size_t first_point(std::size_t e) const { return first_point_[e]; }
  /// Places of the element's unknowns in nodal vectors.
  [[nodiscard]] const std::vector<int>& element_dofs(std::size_t e) const { return dofs_[e]; }

  [[nodiscard]] std::vector<Increment<dim>> increments(const Eigen::VectorXd& nodal) const;
  /// The same in large deformation, this discretisation being the start of the step.
  /// @param end where the nodal values lead to
  [[nodiscard]] std::vector<Increment<dim>> increments_to(const Discretisation<dim>& end,
                                                          const Eigen::VectorXd& nodal) const;
  /// Nodal forces of the stresses: the sum of B^T s times volume.
  [[nodiscard]] Eigen::VectorXd internal_forces(std::span<const Response<dim>> responses) const;
  /// Tangent times nodal displacements, without forming the tangent.
  [[nodiscard]] Eigen::VectorXd linearised_forces(const Linearisation<dim>& of,
                                                  const Eigen::VectorXd& nodal) const;
  /// The sum over the points of element e of B^T D B times volume; where the mesh moves along, with the terms of
  /// large_tangent.hpp, this discretisation being the end of the step.
  [[nodiscard]] Eigen::MatrixXd element_tangent(std::size_t e, const Linearisation<dim>& of) const;

 private:
  /// Volume of element e.
  [[nodiscard]] double volume_of(std::size_t e) const;
  [[nodiscard]] Eigen::VectorXd gather(std::size_t e, const Eigen::VectorXd& nodal) const;

  const Mesh<dim>& mesh_;
  Continuum continuum_;
  Eigen::Index nodal_size_;
  std::vector<PointGeometry<dim>> points_;
  std::vector<int> element_of_point_;
  std::vector<std::size_t> first_point_;
  /// averaged_places of each element; all empty where no element has them.
  std::vector<std::vector<PointGeometry<dim>>> averaged_;
  std::vector<std::vector<int>> dofs_;
  std::vector<char> there_;  ///< by element; empty: all of them
};

}  // namespace polargrain::fem
