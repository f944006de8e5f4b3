// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <vector>

#include "fem/material/unrest.hpp"
#include "fem/solver/constraints.hpp"

namespace polargrain::fem {

/// How far a row of explicit steps was from equilibrium (docs/theory/explicit.md). Shares; all are zero at rest.
struct QuasiStatic {
  /// Root mean square over the steps of the forces that supports and loads leave unbalanced, over those that go through the
  /// mesh, in the worse direction: reactions of a moved and of a held boundary differ by so much.
  double reaction_difference = 0.0;
  /// Largest kinetic energy over the internal work so far. It is that of the chosen masses (nodal_masses), not of true ones.
  double kinetic_share = 0.0;
  double nodes_unbalanced = 0.0;  ///< mean over the steps of the force residual of the nodes
  double grains_unbalanced =
      0.0;  ///< mean over steps and points of what the points hold inside; 0: they hold nothing
  double hot_points = 0.0;  ///< share of those points that do not come to rest, see Unrest

  /// Estimate of the error of a reaction, as a share of it, meant to be too large rather than too small: from the waves in the
  /// mesh and the drag of the grains' damping. Measured, not derived (docs/theory/explicit.md has the scenes). It knows
  /// nothing of two paths that part behind a peak.
  [[nodiscard]] double error() const;
};

/// Gathers the forces of the steps of a row: those that the supports supply at its end, and by how much they leave the mesh
/// unbalanced.
///
/// The reactions of an instant swing with the waves in the mesh, and their mean over a row lags behind by half of it. So
/// two means are taken, each over the time that a wave needs there and back, and the straight line through them is
/// followed to the end of the row. Swings of that time vanish, and an even growth is exact. Rows shorter than two such
/// times keep the reactions of the instant.
template <int dim>
class RowOfForces {
 public:
  /// @param constraints must outlive this object @param steps of the row
  /// @param times rising, of the last steps: twice as many as a wave needs there and back; fewer than two: the row is shorter
  RowOfForces(const Constraints<dim>& constraints, int steps, const std::vector<double>& times);

  /// @param supplied nodal: internal forces less loads; at free entries with the sign that supports there would have
  void add(const Eigen::VectorXd& supplied);

  /// Nodal forces of the supports at the end of the row, zero at free entries.
  [[nodiscard]] const Eigen::VectorXd& reactions() const { return reactions_; }
  /// QuasiStatic::reaction_difference. @param loads nodal, at the end of the row
  [[nodiscard]] double difference(const Eigen::VectorXd& loads) const;

 private:
  const Constraints<dim>& constraints_;
  std::vector<double> weights_;  ///< of the last steps in the reactions
  int steps_;
  int step_ = 0;
  Eigen::VectorXd reactions_;
  typename Cosserat<dim>::Place squares_ = Cosserat<dim>::Place::Zero();
};

}  // namespace polargrain::fem
