// SPDX-License-Identifier: GPL-2.0-or-later
// The account of an attempt that failed (trouble.hpp).
#include <algorithm>
#include <cmath>
#include <numeric>

#include "fem/solver/newton.hpp"
#include "fem/solver/residual_floor.hpp"

namespace polargrain::fem {
namespace {

constexpr std::size_t kMostNodes = 4;
constexpr std::size_t kMostPoints = 3;

/// By node, what is out of balance of its forces.
template <int dim>
std::vector<double> unbalanced_by_node(const Eigen::VectorXd& forces, const Constraints<dim>& constraints) {
  const Eigen::Index entries = constraints.places().mechanics();
  std::vector<double> sums(static_cast<std::size_t>(entries / Cosserat<dim>::dofs), 0.0);
  for (std::size_t node = 0; node < sums.size(); ++node) {
    for (std::size_t i = 0; i < dim; ++i) {
      const std::size_t entry = entry_of<dim>(node) + i;
      if (constraints.is_free(entry)) sums[node] += std::abs(forces(static_cast<Eigen::Index>(entry)));
    }
  }
  return sums;
}

}  // namespace

template <int dim>
Trouble Newton<dim>::trouble(const std::string& reason, const StepReport& report) const {
  Trouble trouble;
  trouble.reason = reason;
  if (!report.force_residuals.empty()) {
    trouble.first_force_residual = report.force_residuals.front();
    trouble.last_force_residual = report.force_residuals.back();
    trouble.least_force_residual = std::ranges::min(report.force_residuals);
  }
  if (unbalanced_.size() == 0) return trouble;
  std::vector<std::size_t> order(trial_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::erase_if(order, [&](std::size_t point) { return trial_[point].quality == Quality::good; });
  trouble.not_good = order.size();
  std::ranges::stable_sort(order, {}, [&](std::size_t point) { return trial_[point].quality; });
  for (std::size_t k = 0; k < std::min(kMostPoints, order.size()); ++k)
    trouble.points.push_back({order[k], trial_[order[k]].message});
  if (!unbalanced_.allFinite()) return trouble;
  if (const Eigen::VectorXd noise = forces_of_noise<dim>(discretisation, problem.continuum, trial_);
      noise.size() > 0)
    trouble.force_noise = relative(noise).force;

  const std::vector<double> sums = unbalanced_by_node(constraints.folded(unbalanced_), constraints);
  const double all = std::accumulate(sums.begin(), sums.end(), 0.0);
  if (!(all > 0.0)) return trouble;
  order.resize(sums.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, std::greater(), [&](std::size_t node) { return sums[node]; });
  for (std::size_t k = 0; k < std::min(kMostNodes, order.size()); ++k)
    trouble.nodes.push_back({static_cast<int>(order[k]), sums[order[k]] / all});
  return trouble;
}

template Trouble Newton<2>::trouble(const std::string&, const StepReport&) const;
template Trouble Newton<3>::trouble(const std::string&, const StepReport&) const;

}  // namespace polargrain::fem
