// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/increment.hpp"
#include "common/response.hpp"
#include "fem/element/kinematics.hpp"
#include "fem/mesh/mesh.hpp"

namespace polargrain::fem {

class Discretisation;

/// The base of a tangent: the answers of the points and, where the mesh moves along with the body, the
/// configurations they belong to.
struct Linearisation {
  struct Moving {
    const Discretisation& start;               ///< the increments refer to it
    const std::vector<Increment>& increments;  ///< that led to the answers
  };
  const std::vector<Response>& answers;
  std::optional<Moving> moving = {};  ///< nothing: small deformation
};

/// The way between nodes and integration points: gathers increments, scatters stresses. Nodal vectors have 3
/// entries a node (u1, u2, w). Loops run in the order of the elements, so sums have the same bits every time.
class Discretisation {
 public:
  /// @param mesh must outlive this object.
  Discretisation(const Mesh& mesh, Continuum continuum);

  /// Moves the nodes to where `nodal` displaces them from the mesh as it was made.
  /// @return a message naming an element that this turns inside out; empty when all is well.
  [[nodiscard]] std::string move_to(const Eigen::VectorXd& nodal);

  [[nodiscard]] std::size_t points() const { return points_.size(); }
  [[nodiscard]] const PointGeometry& point(std::size_t i) const { return points_[i]; }
  [[nodiscard]] int element_of_point(std::size_t i) const { return element_of_point_[i]; }
  [[nodiscard]] std::size_t elements() const { return dofs_.size(); }
  /// Entries of a nodal vector.
  [[nodiscard]] Eigen::Index nodal_size() const { return nodal_size_; }
  /// Points of element e are first_point(e) ... first_point(e + 1) - 1.
  [[nodiscard]] std::size_t first_point(std::size_t e) const { return first_point_[e]; }
  /// Places of the element's unknowns in nodal vectors.
  [[nodiscard]] const std::vector<int>& element_dofs(std::size_t e) const { return dofs_[e]; }

  [[nodiscard]] std::vector<Increment> increments(const Eigen::VectorXd& nodal) const;
  /// The same in large deformation, this discretisation being the start of the step.
  /// @param end where the nodal values lead to
  [[nodiscard]] std::vector<Increment> increments_to(const Discretisation& end,
                                                     const Eigen::VectorXd& nodal) const;
  /// Nodal forces of the stresses: the sum of B^T s times volume.
  [[nodiscard]] Eigen::VectorXd internal_forces(std::span<const Response> responses) const;
  /// Tangent times nodal displacements, without forming the tangent.
  [[nodiscard]] Eigen::VectorXd linearised_forces(const Linearisation& of,
                                                  const Eigen::VectorXd& nodal) const;
  /// The sum over the points of element e of B^T D B times volume; where the mesh moves along, with the terms of
  /// large_tangent.hpp, this discretisation being the end of the step.
  [[nodiscard]] Eigen::MatrixXd element_tangent(std::size_t e, const Linearisation& of) const;

 private:
  /// Volume of element e.
  [[nodiscard]] double volume_of(std::size_t e) const;
  [[nodiscard]] Eigen::VectorXd gather(std::size_t e, const Eigen::VectorXd& nodal) const;

  const Mesh& mesh_;
  Continuum continuum_;
  Eigen::Index nodal_size_;
  std::vector<PointGeometry> points_;
  std::vector<int> element_of_point_;
  std::vector<std::size_t> first_point_;
  std::vector<std::vector<int>> dofs_;
};

}  // namespace polargrain::fem
