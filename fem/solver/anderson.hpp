// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <deque>
#include <functional>
#include <limits>

namespace polargrain::fem {

/// A change of the increment of a step.
struct Correction {
  Eigen::VectorXd displacement;  ///< nodal
  double time = 0.0;
};

/// Anderson acceleration of a Newton iteration whose tangent or stress is not quite true (Anderson 1965;
/// Walker and Ni 2011, SIAM J. Numer. Anal. 49:1715). The last iterations of a step say what the residual r
/// really did along the ways gone, dr over dx; with the tangent K at hand C = K^-1 dr should have been dx (r
/// is counted as unbalanced force: C = -dx). Where it was not, the correction c = K^-1 r becomes
///
///     c - (dX + C) g        with g that makes |c - C g| smallest.
///
/// With a true tangent dX + C is zero and nothing changes. Differences that are mostly noise are damped: g_j
/// costs (s_j |C_j|)^2, where s_j is the share of noise in the j-th difference.
///
/// A jump of the stresses does not count as stiffness. Where a correction has made the residual larger and the next one does not go
/// back along its way, as it does behind a tangent that was too soft, all places before are forgotten.
class Anderson {
 public:
  /// @param depth differences kept; 0 switches it off. @param reference_length m, weighs rotations.
  /// @param dimension of the nodal vectors, 2 or 3
  /// @param mechanics entries of displacements and rotations, which come first and alone count in what is made small
  Anderson(int depth, double reference_length, int dimension = 2,
           Eigen::Index mechanics = std::numeric_limits<Eigen::Index>::max())
      : depth_(depth), length_(reference_length), dimension_(dimension), mechanics_(mechanics) {}

  [[nodiscard]] bool is_on() const { return depth_ > 0; }
  /// A new step begins.
  void clear();
  /// Where the iteration has got to, counted from the committed state.
  /// @param unbalanced nodal forces, zero where displacements are given. @param noise absolute forces that
  /// noise alone leaves (residual_floor.hpp); empty without noise.
  void remember(const Correction& position, const Eigen::VectorXd& unbalanced, const Eigen::VectorXd& noise);
  /// @param correction K^-1 of the unbalanced forces at the place remembered last
  /// @param solve K^-1 of a nodal vector of forces, under the constraint of the step.
  void accelerate(Correction& correction, const std::function<Correction(const Eigen::VectorXd&)>& solve);

 private:
  struct Place {
    Correction position;
    Eigen::VectorXd unbalanced;
    double noise;           ///< sum of absolute forces, and of moments over the reference length
    double out_of_balance;  ///< the same of `unbalanced`
  };
  /// Whether the stresses have jumped between the last two places.
  [[nodiscard]] bool has_jumped(const Correction& correction) const;
  [[nodiscard]] Eigen::VectorXd weighted(Eigen::VectorXd nodal, double weight_of_rotations) const;

  int depth_;
  double length_;
  int dimension_;
  Eigen::Index mechanics_;
  std::deque<Place> places_;
};

}  // namespace polargrain::fem
