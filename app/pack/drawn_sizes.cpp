// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/pack/drawn_sizes.hpp"

#include <fmt/format.h>

#include <cmath>

namespace polargrain::app {
namespace {

constexpr double kOffTheCurve = 0.05;  // of the mass: a sieve analysis repeats within some per cent

}  // namespace

std::string remark_on_drawn_sizes(const PackingSpecification& asked, const Packing& packing) {
  const SizeLaw& law = asked.sizes;
  if (law.kind != SizeLaw::Kind::sieve) return "";
  const auto passing = [&](double radius) {
    double below = 0.0;
    double all = 0.0;
    for (const Grain& grain : packing.grains) {
      const double mass = asked.spheres ? std::pow(grain.radius, 3) : grain.radius * grain.radius;
      all += mass;
      if (grain.radius <= radius) below += mass;
    }
    return below / all;
  };
  std::size_t worst = 0;
  double farthest = 0.0;
  for (std::size_t k = 0; k < law.radii.size(); ++k)
    if (const double off = std::abs(passing(law.radii[k]) - law.shares[k]); off > farthest) {
      worst = k;
      farthest = off;
    }
  if (farthest <= kOffTheCurve) return "";
  return fmt::format(
      "{:.0f} % of the mass pass the sieve of {:.4g} mm, {:.0f} % were asked for: {} grains are too few for this grading; "
      "give more 'grains', or another 'seed'",
      100.0 * passing(law.radii[worst]), 2e3 * law.radii[worst], 100.0 * law.shares[worst],
      packing.grains.size());
}

}  // namespace polargrain::app
