// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/solver/residual.hpp"

#include <algorithm>
#include <cmath>

namespace polargrain::fem {

template <int dim>
Residual measure(const Eigen::VectorXd& unbalanced, const Constraints<dim>& constraints,
                 double reference_force, double reference_length) {
  double force = 0.0;
  double moment = 0.0;
  for (Eigen::Index entry = 0; entry < unbalanced.size(); ++entry) {
    if (!constraints.is_free(static_cast<std::size_t>(entry))) continue;
    (is_rotation(dof_at<dim>(entry)) ? moment : force) += std::abs(unbalanced(entry));
  }
  // Zero over zero: nothing is loaded and nothing is out of balance.
  if (force > 0.0 || !std::isfinite(force)) force /= reference_force;
  if (moment > 0.0 || !std::isfinite(moment)) moment /= reference_force * reference_length;
  return {force, moment};
}

template <int dim>
double sum_of_reactions(const Eigen::VectorXd& forces, const Constraints<dim>& constraints) {
  double sum = 0.0;
  for (Eigen::Index entry = 0; entry < forces.size(); ++entry) {
    if (!is_rotation(dof_at<dim>(entry)) && !constraints.is_free(static_cast<std::size_t>(entry)))
      sum += std::abs(forces(entry));
  }
  return sum;
}

bool StagnationWatch::stagnates(double excess) {
  constexpr double kProgress = 0.9;
  smallest_.push_back(smallest_.empty() ? excess : std::min(excess, smallest_.back()));
  if (smallest_.size() <= window_) return false;
  return smallest_.back() > kProgress * smallest_[smallest_.size() - 1 - window_];
}

template Residual measure<2>(const Eigen::VectorXd& unbalanced, const Constraints<2>& constraints,
                             double reference_force, double reference_length);
template Residual measure<3>(const Eigen::VectorXd& unbalanced, const Constraints<3>& constraints,
                             double reference_force, double reference_length);
template double sum_of_reactions<2>(const Eigen::VectorXd& forces, const Constraints<2>& constraints);
template double sum_of_reactions<3>(const Eigen::VectorXd& forces, const Constraints<3>& constraints);

}  // namespace polargrain::fem
