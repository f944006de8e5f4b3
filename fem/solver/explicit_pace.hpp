// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <algorithm>

#include "fem/solver/constraints.hpp"
#include "fem/solver/solver.hpp"

namespace polargrain::fem {

/// The loading time over a row of explicit steps: an even rate, which steps from rest come to evenly over a ramp. These are
/// so many more that the rate behind the ramp is that of the rows to follow.
class ExplicitPace {
 public:
  /// @param steps of a row without a ramp, at least 1 @param ramp steps; 0: the nodes move already
  ExplicitPace(double start, double end, int steps, int ramp)
      : start_(start), end_(end), ramp_(std::min(ramp, 2 * steps)), steps_(steps + ramp_ / 2) {}

  [[nodiscard]] int steps() const { return steps_; }
  /// Share of the way after this step, 1 after the last.
  [[nodiscard]] double fraction(int step) const { return step >= steps_ ? 1.0 : way(step) / way(steps_); }
  [[nodiscard]] double time(int step) const {
    return step >= steps_ ? end_ : start_ + fraction(step) * (end_ - start_);
  }

 private:
  /// Sum of the speeds min(1, k / ramp) of the first steps.
  [[nodiscard]] double way(int step) const {
    const double inside = std::min(step, ramp_);
    return (ramp_ > 0 ? inside * (inside + 1.0) / (2.0 * ramp_) : 0.0) + (step - inside);
  }

  double start_;
  double end_;
  int ramp_;
  int steps_;
};

/// ExplicitOptions::rotation_damping at the unknowns that are micro-rotations, zero at the others.
template <int dim>
Eigen::VectorXd damping_of_rotations(const Problem<dim>& problem, const Constraints<dim>& constraints,
                                     const ExplicitOptions& options) {
  Eigen::VectorXd damping = Eigen::VectorXd::Zero(constraints.unknowns());
  for (std::size_t entry = 0; entry < entry_of<dim>(problem.mesh.nodes.size()); ++entry)
    if (is_rotation(dof_at<dim>(entry)) && constraints.is_free(entry))
      damping(constraints.equation(entry)) = options.rotation_damping;
  return damping;
}

}  // namespace polargrain::fem
