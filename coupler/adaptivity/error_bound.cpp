// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/adaptivity/error_bound.hpp"

#include <cmath>
#include <numeric>

namespace polargrain::coupler {
namespace {

constexpr double kRisk = 0.05;

/// The chance that a sum of n exponentially distributed numbers of mean 1 is at most x (Erlang).
double chance_below(double x, std::size_t n) {
  double term = std::exp(-x);
  double above = term;
  for (std::size_t k = 1; k < n; ++k) {
    term *= x / static_cast<double>(k);
    above += term;
  }
  return 1.0 - above;
}

}  // namespace

double exponential_bound_factor(std::size_t n) {
  const auto count = static_cast<double>(n);
  // Beyond 500 the exponential of -x leaves the range of numbers; Wilson and Hilferty (1931) is then good to 1e-5.
  if (n > 500) {
    const double ninth = 1.0 / (9.0 * count);
    return std::pow(1.0 - ninth - 1.6448536269514722 * std::sqrt(ninth), -3.0);
  }
  double low = 0.0;
  double high = count;  // the mean: less than half of the sums are below the quantile
  while (high - low > 1e-12 * count) {
    const double middle = 0.5 * (low + high);
    (chance_below(middle, n) < kRisk ? low : high) = middle;
  }
  return count / high;
}

double mean_at_most(std::span<const double> sample, std::size_t population) {
  if (population == 0) return 0.0;
  if (sample.empty()) return HUGE_VAL;
  const double sum = std::accumulate(sample.begin(), sample.end(), 0.0);
  const double mean = sum / static_cast<double>(sample.size());
  const double rest = static_cast<double>(population - sample.size());
  return (sum + rest * exponential_bound_factor(sample.size()) * mean) / static_cast<double>(population);
}

}  // namespace polargrain::coupler
