// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <utility>
#include <vector>

#include "fem/solver/problem.hpp"

namespace polargrain::fem {

/// Derivative of the nodal forces of one side with respect to the nodal values of its nodes.
struct LoadStiffness {
  std::vector<int> entries;  ///< of nodal vectors
  Eigen::MatrixXd values;    ///< a row a force, a column a displacement
};

/// The part of a boundary that belongs to one node of one of its sides.
template <int dim>
struct ShareOfSide {
  int element;
  int node;
  double area;                           ///< m^2; in the plane per unit thickness, m
  typename Cosserat<dim>::Place normal;  ///< outward, of length 1, in the middle of the side
};

/// All of them: areas by the squares of the shape functions, scaled to the whole side, so that all are positive.
template <int dim>
std::vector<ShareOfSide<dim>> shares_of_boundary(const Mesh<dim>& mesh, const std::string& boundary);

/// Nodal forces of the loads of a problem, consistent with the shape functions. Loads keep their direction
/// and the area they act on, so each is one nodal vector times its table; only pressures follow the boundary,
/// when move_to says where it is.
template <int dim>
class Loads {
 public:
  /// The loads of a stage of construction, on what is there. @param problem must outlive this object.
  explicit Loads(const Problem<dim>& problem, int stage = 0);

  /// Lets the pressures act on the boundary where `nodal` displaces it; all else acts as on the mesh as it
  /// was made.
  void move_to(const Eigen::VectorXd& nodal);

  /// Adds nodal forces that stay as they are.
  void hold(const Eigen::VectorXd& forces);

  /// Nodal vector: forces in N, moments in N m; in the plane N/m and N.
  [[nodiscard]] Eigen::VectorXd at(double time) const;
  /// Change of at() per time just after `time`.
  [[nodiscard]] Eigen::VectorXd slope(double time) const;
  /// How the forces of the pressures change as the boundary moves from where it is, at `time`: an item a side. Empty in
  /// small deformation.
  [[nodiscard]] std::vector<LoadStiffness> stiffness(double time) const;
  /// Product of that stiffness and nodal displacements.
  [[nodiscard]] Eigen::VectorXd linearised(double time, const Eigen::VectorXd& nodal) const;
  /// Sum over all loads and nodes of the largest absolute nodal force (not moments), N/m.
  [[nodiscard]] double largest_force() const;
  /// The same of the moments, N.
  [[nodiscard]] double largest_moment() const;
  /// The largest forces again, of what changes after `time`.
  [[nodiscard]] double largest_change(double time) const;

 private:
  struct Part {
    Eigen::VectorXd forces;  ///< for the value 1 of the table
    const TimeTable* factor;
  };
  void add_boundary_load(const Problem<dim>& problem, const BoundaryLoad<dim>& load, int stage);
  void add_node_load(const Problem<dim>& problem, const NodeLoad& load);
  void add_body_load(const Problem<dim>& problem, const BodyLoad<dim>& load);

  /// Over the entries of displacements, or of rotations.
  template <class Factor>
  [[nodiscard]] double sum_of(bool rotations, Factor factor_of) const;

  const Problem<dim>* problem_;
  std::vector<char> there_;  ///< by element; empty: all of them
  Eigen::Index size_;        ///< of the parts that know displacements and rotations alone
  Eigen::Index nodal_size_;  ///< fields included
  std::vector<Part> parts_;
  struct Pressure {
    std::size_t part;
    const BoundaryLoad<dim>* load;
    std::vector<BoundarySide> sides;
    std::vector<LoadStiffness> stiffness;  ///< of a unit pressure; empty in small deformation
  };
  std::vector<Pressure> pressures_;
};

}  // namespace polargrain::fem
