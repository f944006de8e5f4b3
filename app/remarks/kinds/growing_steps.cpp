// SPDX-License-Identifier: GPL-2.0-or-later
// Steps of consolidation that grow so fast that pore pressures lag behind.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/remarks/kinds.hpp"

namespace polargrain::app {
namespace {

/// Pressures in a column under a load, over that load, lag by 1.3, 2.8, 5.5, 9.6 % at 1.125, 1.29, 1.75, 3.5.
constexpr double kMostGrowth = 2.5;
constexpr double kErrorOfGrowth = 0.09;  ///< over the logarithm of the growth

/// Largest ratio of a step to the one before it within a stage.
double growth_of(const std::vector<double>& times, std::size_t first, std::size_t last) {
  double largest = 1.0;
  for (std::size_t k = first + 1; k + 1 < last; ++k) {
    const double before = times[k] - times[k - 1];
    if (before > 0.0) largest = std::max(largest, (times[k + 1] - times[k]) / before);
  }
  return largest;
}

}  // namespace

void growing_steps(const Scene& scene, Remarks& remarks) {
  if (scene.find({"water"}) == nullptr || !scene.end_time() || scene.the_case().real_time) return;
  std::vector<double> times{0.0};
  for (const coupler::StepTarget& target : scene.the_case().plan) times.push_back(target.amount);
  std::vector<std::size_t> begins;
  for (const coupler::CaseStage& stage : scene.the_case().stages)
    begins.push_back(static_cast<std::size_t>(std::max(stage.first_step, 1)) - 1);
  if (begins.empty()) begins.push_back(0);
  begins.push_back(times.size());
  double growth = 1.0;
  for (std::size_t k = 0; k + 1 < begins.size(); ++k)
    growth = std::max(growth, growth_of(times, begins[k], std::min(begins[k + 1] + 1, times.size())));
  if (growth <= kMostGrowth) return;
  remarks.push_back(
      {Rank::doubtful, growth / kMostGrowth,
       scene.place({"steps"}).fault(fmt::format(
           "steps: a step is up to {:.2g} times the one before: pore pressures lag by some {:.0f} % of the load",
           growth, 100.0 * kErrorOfGrowth * std::log(growth))),
       fmt::format("give {:.0f} times as many steps, or a longer 'first'",
                   std::ceil(std::log(growth) / std::log(1.3)))});
}

}  // namespace polargrain::app
