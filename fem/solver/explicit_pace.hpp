// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <optional>
#include <vector>

#include "fem/solver/constraints.hpp"
#include "fem/solver/solver.hpp"

namespace polargrain::fem {

/// The loading time over a row of explicit steps: an even rate, which steps from rest come to evenly over a ramp, in this
/// row or over several. Rows are so much longer for it that the rate behind the ramp is the same in all.
class ExplicitPace {
 public:
  /// @param steps of a row without a ramp, at least 1 @param ramp steps @param since_rest steps of the rows before, since
  /// the nodes were at rest
  /// @param speed_before at the end of the row before, over the even speed of this one, which it comes to over `change` steps
  ExplicitPace(double start, double end, int steps, int ramp, int since_rest, double speed_before = 1.0,
               int change = 0)
      : start_(start),
        end_(end),
        ramp_(ramp),
        before_(std::min(since_rest, ramp)),
        surplus_(before_ < ramp ? 0.0 : speed_before - 1.0),
        change_(std::max(1, change)) {
    while (way(steps_) < steps) ++steps_;
  }

  [[nodiscard]] int steps() const { return steps_; }
  /// Share of the way after this step, 1 after the last.
  [[nodiscard]] double fraction(int step) const { return step >= steps_ ? 1.0 : way(step) / way(steps_); }
  [[nodiscard]] double time(int step) const {
    return step >= steps_ ? end_ : start_ + fraction(step) * (end_ - start_);
  }
  /// Of the last `count` steps; empty where there are fewer.
  [[nodiscard]] std::vector<double> last_times(int count) const {
    std::vector<double> last;
    if (count > steps_) return last;
    for (int step = steps_ - count + 1; step <= steps_; ++step) last.push_back(time(step));
    return last;
  }

 private:
  /// Sum of the speeds min(1, k / ramp) of the first steps of the row.
  [[nodiscard]] double way(int step) const {
    const double changing = std::min(step, change_);
    const double surplus = surplus_ * (changing - changing * (changing + 1.0) / (2.0 * change_));
    return way_from_rest(before_ + step) - way_from_rest(before_) + surplus;
  }
  [[nodiscard]] double way_from_rest(int step) const {
    const double inside = std::min(step, ramp_);
    return (ramp_ > 0 ? inside * (inside + 1.0) / (2.0 * ramp_) : 0.0) + (step - inside);
  }

  double start_;
  double end_;
  int ramp_;
  int before_;      ///< steps of the ramp that are behind
  double surplus_;  ///< of the speed at first, over the even one
  int change_;      ///< steps in which it goes
  int steps_ = 1;
};

/// Shares that a step takes away, by unknown.
struct DampingOfSteps {
  /// Of the velocity relative to the base: in real time ExplicitOptions::mass_damping times the step.
  Eigen::VectorXd speed;
  Eigen::VectorXd lag;  ///< of the speed of a micro-rotation over the spin of the continuum there
};

/// @param seconds of a step in real time; nothing: it has no real time
template <int dim>
DampingOfSteps damping_of_steps(const Problem<dim>& problem, const Constraints<dim>& constraints,
                                const ExplicitOptions& options, std::optional<double> seconds) {
  // Without any, micro-rotations swing up in a body that collapses.
  constexpr double kInRealTime = 0.01;
  DampingOfSteps damping{
      Eigen::VectorXd::Constant(constraints.unknowns(), seconds ? options.mass_damping * *seconds : 0.0),
      Eigen::VectorXd::Zero(constraints.unknowns())};
  for (std::size_t entry = 0; entry < entry_of<dim>(problem.mesh.nodes.size()); ++entry)
    if (constraints.is_free(entry) && is_rotation(dof_at<dim>(entry)))
      damping.lag(constraints.equation(entry)) = seconds ? kInRealTime : options.rotation_damping;
  return damping;
}

}  // namespace polargrain::fem
