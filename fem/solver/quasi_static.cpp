// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/solver/quasi_static.hpp"

#include <algorithm>
#include <cmath>

#include "fem/element/dofs.hpp"

namespace polargrain::fem {
namespace {

/// Weights by which values add up to the end of the straight line through the means of the first and of the second half of them.
std::vector<double> weights_of_means(const std::vector<double>& times) {
  const std::size_t half = times.size() / 2;
  const auto count = static_cast<double>(half);
  const std::size_t first = times.size() - 2 * half;
  double earlier = 0.0;
  double later = 0.0;
  for (std::size_t k = 0; k < half; ++k) {
    earlier += times[first + k] / count;
    later += times[first + half + k] / count;
  }
  const double onward = (times.back() - later) / (later - earlier);
  std::vector<double> weights(times.size(), 0.0);
  for (std::size_t k = 0; k < half; ++k) {
    weights[first + k] = -onward / count;
    weights[first + half + k] = (1.0 + onward) / count;
  }
  return weights;
}

}  // namespace

double QuasiStatic::error() const {
  // Ten packings, three paces: 95, 98 and 91 % of the rows before the peak are within this (docs/theory/explicit.md); at the
  // slowest pace the reference is no better known.
  constexpr double kWaves = 1.0;
  constexpr double kDrag = 2.0;
  return kWaves * reaction_difference + kDrag * grains_unbalanced;
}

template <int dim>
RowOfForces<dim>::RowOfForces(const Constraints<dim>& constraints, int steps,
                              const std::vector<double>& times)
    : constraints_(constraints),
      weights_(times.size() < 2 ? std::vector<double>{1.0} : weights_of_means(times)),
      steps_(steps) {}

template <int dim>
void RowOfForces<dim>::add(const Eigen::VectorXd& supplied) {
  if (reactions_.size() == 0) reactions_ = Eigen::VectorXd::Zero(supplied.size());
  const int from_end = steps_ - ++step_;
  const auto count = static_cast<int>(weights_.size());
  const double weight = from_end < count ? weights_[static_cast<std::size_t>(count - 1 - from_end)] : 0.0;
  typename Cosserat<dim>::Place unbalanced = Cosserat<dim>::Place::Zero();
  for (Eigen::Index entry = 0; entry < supplied.size(); ++entry) {
    const Eigen::Index direction = entry % Cosserat<dim>::dofs;
    if (!constraints_.is_free(static_cast<std::size_t>(entry))) {
      reactions_(entry) += weight * supplied(entry);
    } else if (direction < dim) {
      unbalanced(direction) += supplied(entry);
    }
  }
  squares_ += unbalanced.cwiseAbs2();
}

template <int dim>
double RowOfForces<dim>::difference(const Eigen::VectorXd& loads) const {
  if (step_ == 0) return 0.0;
  // Half of all forces on the body: they come in on one side and leave on the other.
  typename Cosserat<dim>::Place through = Cosserat<dim>::Place::Zero();
  for (Eigen::Index entry = 0; entry < loads.size(); ++entry) {
    if (entry % Cosserat<dim>::dofs < dim)
      through(entry % Cosserat<dim>::dofs) += 0.5 * (std::abs(reactions_(entry)) + std::abs(loads(entry)));
  }
  double worst = 0.0;
  for (Eigen::Index direction = 0; direction < dim; ++direction) {
    if (through(direction) > 0.0)
      worst =
          std::max(worst, std::sqrt(squares_(direction) / static_cast<double>(step_)) / through(direction));
  }
  return worst;
}

template class RowOfForces<2>;
template class RowOfForces<3>;

}  // namespace polargrain::fem
