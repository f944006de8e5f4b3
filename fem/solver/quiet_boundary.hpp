// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <array>
#include <map>
#include <vector>

#include "fem/solver/constraints.hpp"
#include "fem/solver/discretisation.hpp"

namespace polargrain::fem {

/// Boundaries that let waves out: dashpots with the impedance of the body behind them (Lysmer and Kuhlemeyer 1969). A
/// traction -rho c_p v along the normal and -rho c_s v across it answers to the velocity v, with
/// c_p = sqrt(C_nnnn / rho) and c_s = sqrt(G / rho) of the tangents at rest. Waves that come in straight leave without an
/// echo, slanting ones nearly so.
template <int dim>
class QuietBoundary {
 public:
  /// Energy that leaves through the boundary, J; in the plane per m.
  struct Absorbed {
    double over_step = 0.0;   ///< from half a step before to half a step behind
    double first_half = 0.0;  ///< of that, until now
  };
  using Dashpot = Eigen::Matrix<double, dim, dim>;

  /// @param answers of the points at rest @param densities kg/m^3, of each element
  QuietBoundary(const Problem<dim>& problem, const Discretisation<dim>& discretisation,
                const std::vector<Response<dim>>& answers, const std::vector<double>& densities);

  /// From values().
  explicit QuietBoundary(const std::vector<double>& values);
  /// Of each node its number and its dashpot, row by row.
  [[nodiscard]] std::vector<double> values() const;

  /// Joins the dashpots of nodes that are tied to each other: they move by the same equations.
  void join(const Constraints<dim>& constraints);

  /// Entries of nodal vectors: displacements of its nodes, but those that supports of other places hold or move.
  [[nodiscard]] std::vector<std::size_t> entries(const Problem<dim>& problem) const;
  /// Adds the nodal forces of the dashpots on the body. @param velocity in the order of the equations
  void add_forces(const Constraints<dim>& constraints, const Eigen::VectorXd& velocity,
                  Eigen::VectorXd& forces) const;

  /// The velocities half a step on, at the nodes of the boundary; other nodes keep their velocities.
  /// @param velocity before, and @param next the same after a step without dashpots, in the order of the equations
  /// @param masses in that order @param seconds of a step
  Absorbed apply(const Constraints<dim>& constraints, const Eigen::VectorXd& velocity,
                 const Eigen::VectorXd& masses, double seconds, Eigen::VectorXd& next) const;

 private:
  std::map<int, Dashpot> dashpots_;  ///< by node, N s/m; in the plane per m
};

}  // namespace polargrain::fem
