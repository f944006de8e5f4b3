// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <functional>
#include <optional>

namespace polargrain::fem {

struct GmresLimits {
  double tolerance = 1e-10;  ///< of the residual, over the right side
  int restart = 80;          ///< directions that are kept; then the iteration begins anew
  int most_iterations = 240;
  double least_progress =
      0.1;  ///< given up when the residual at a new begin is above this share of the last one
};

/// Generalised minimal residuals (Saad and Schultz 1986) for a square system, preconditioned from the right, so that the
/// residual that it measures is the true one. One thread and a fixed order of sums.
/// @param apply the matrix
/// @param precondition an approximate inverse, linear and always the same
/// @param iterations that it took
/// @return nothing when the limits do not lead to the tolerance, or a number is not finite
std::optional<Eigen::VectorXd> gmres(
    const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& apply,
    const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& precondition,
    const Eigen::VectorXd& right_side, const GmresLimits& limits, int& iterations);

}  // namespace polargrain::fem
