// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/pack/sizes.hpp"

#include <cmath>
#include <numeric>

#include "common/elementary_functions.hpp"

namespace polargrain::dem {

namespace {

double normal_share(double value) {
  return 0.5 * complementary_error_function(-value / std::sqrt(2.0));
}

/// Cut at both ends: the share between them is all there is. Bisection, as there is no closed inverse.
double lognormal_radius(const SizeLaw& law, double u) {
  const double median = law.radii[1];
  const auto standard = [&](double radius) { return logarithm(radius / median) / law.deviation; };
  double low = standard(law.radii.front());
  double high = standard(law.radii.back());
  const double share = normal_share(low) + u * (normal_share(high) - normal_share(low));
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    (normal_share(middle) < share ? low : high) = middle;
  }
  return median * exponential(law.deviation * 0.5 * (low + high));
}

/// Index of the part that u falls into, and the fraction of it that lies before u.
std::pair<std::size_t, double> part_of(const std::vector<double>& weights, double u) {
  double left = u * std::accumulate(weights.begin(), weights.end(), 0.0);
  std::size_t k = 0;
  while (k + 1 < weights.size() && left >= weights[k]) left -= weights[k++];
  return {k, weights[k] > 0.0 ? std::min(1.0, left / weights[k]) : 0.0};
}

/// Between two sieves a and b the mass spreads evenly over the radius; a disc has a mass of r^2, so the
/// number goes as r^-2 and its integral as 1/a - 1/r; of spheres as r^-3 and (1/a^2 - 1/r^2) / 2.
double sieve_radius(const SizeLaw& law, double u) {
  const double degree = law.spheres ? 2.0 : 1.0;
  const auto integral = [degree](double a, double b) {
    return (power(a, -degree) - power(b, -degree)) / degree;
  };
  std::vector<double> numbers;
  for (std::size_t k = 0; k + 1 < law.radii.size(); ++k)
    numbers.push_back((law.shares[k + 1] - law.shares[k]) * integral(law.radii[k], law.radii[k + 1]) /
                      (law.radii[k + 1] - law.radii[k]));
  const auto [k, fraction] = part_of(numbers, u);
  const double least = power(law.radii[k], -degree);
  return power(least - degree * fraction * integral(law.radii[k], law.radii[k + 1]), -1.0 / degree);
}

}  // namespace

double radius_at(const SizeLaw& law, double u) {
  switch (law.kind) {
    case SizeLaw::Kind::lognormal:
      return lognormal_radius(law, u);
    case SizeLaw::Kind::list:
      return law.radii[part_of(law.shares, u).first];
    case SizeLaw::Kind::sieve:
      return sieve_radius(law, u);
    case SizeLaw::Kind::uniform:
      break;
  }
  return law.radii.front() + u * (law.radii.back() - law.radii.front());
}

std::vector<double> draw_radii(const SizeLaw& law, int count, RandomNumbers& random) {
  std::vector<double> radii;
  for (int k = 0; k < count; ++k) radii.push_back(radius_at(law, (k + random.uniform()) / count));
  random.shuffle(radii);
  return radii;
}

}  // namespace polargrain::dem
