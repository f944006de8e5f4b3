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
  for (Eigen::Index entry = 0; entry < constraints.places().mechanics(); ++entry) {
    if (!constraints.is_free(static_cast<std::size_t>(entry))) continue;
    (is_rotation(dof_at<dim>(entry)) ? moment : force) += std::abs(unbalanced(entry));
  }
  // Zero over zero: nothing is loaded and nothing is out of balance.
  if (force > 0.0 || !std::isfinite(force)) force /= reference_force;
  if (moment > 0.0 || !std::isfinite(moment)) moment /= reference_force * reference_length;
  return {force, moment};
}

template <int dim>
std::vector<double> measure_fields(const Eigen::VectorXd& unbalanced, const Eigen::VectorXd& parts,
                                   const Constraints<dim>& constraints) {
  const FieldPlaces<dim>& places = constraints.places();
  std::vector<double> residuals;
  for (std::size_t field = 0; field < places.fields(); ++field) {
    double sum = 0.0;
    double all = 0.0;
    for (Eigen::Index entry = places.start(field); entry < places.start(field + 1); ++entry) {
      all += std::abs(parts(entry));
      if (constraints.is_free(static_cast<std::size_t>(entry))) sum += std::abs(unbalanced(entry));
    }
    residuals.push_back(sum > 0.0 || !std::isfinite(sum) ? sum / all : 0.0);
  }
  return residuals;
}

template <int dim>
double sum_of_reactions(const Eigen::VectorXd& forces, const Constraints<dim>& constraints) {
  double sum = 0.0;
  for (Eigen::Index entry = 0; entry < constraints.places().mechanics(); ++entry) {
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
template std::vector<double> measure_fields<2>(const Eigen::VectorXd&, const Eigen::VectorXd&,
                                               const Constraints<2>&);
template std::vector<double> measure_fields<3>(const Eigen::VectorXd&, const Eigen::VectorXd&,
                                               const Constraints<3>&);
template double sum_of_reactions<2>(const Eigen::VectorXd& forces, const Constraints<2>& constraints);
template double sum_of_reactions<3>(const Eigen::VectorXd& forces, const Constraints<3>& constraints);

}  // namespace polargrain::fem
