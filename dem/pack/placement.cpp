// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/pack/placement.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "common/error.hpp"
#include "dem/pack/sizes.hpp"

namespace polargrain::dem {

namespace {

/// Random places, each free of those taken before, can fill a share of 0.547 of the plane with equal discs;
/// well below it a place is found in a few trials.
constexpr double kSolidFraction = 0.4;
constexpr int kMostTrials = 100'000;

bool is_free(const Grain& grain, const std::vector<Grain>& placed, double side) {
  return std::none_of(placed.begin(), placed.end(), [&](const Grain& other) {
    Eigen::Vector2d apart = grain.position - other.position;
    for (double& component : apart) component -= side * std::round(component / side);
    const double reach = grain.radius + other.radius;
    return apart.squaredNorm() < reach * reach;
  });
}

}  // namespace

Packing place_grains(const PackingSpecification& specification) {
  RandomNumbers random(specification.seed);
  std::vector<double> radii = draw_radii(specification.sizes, specification.grains, random);
  double area = 0.0;
  for (const double radius : radii) area += std::numbers::pi * radius * radius;
  const double side = std::sqrt(area / kSolidFraction);
  Packing packing;
  packing.box = side * Eigen::Matrix2d::Identity();
  packing.thickness = specification.thickness;

  // The large ones first: they would find no room later. Names stay in the order of the draw.
  std::vector<std::size_t> order(radii.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return radii[a] > radii[b]; });
  for (const std::size_t k : order) {
    Grain grain;
    grain.id = static_cast<std::int64_t>(k);
    grain.radius = radii[k];
    grain.mass = specification.density * std::numbers::pi * radii[k] * radii[k] * specification.thickness;
    grain.moment_of_inertia = 0.5 * grain.mass * radii[k] * radii[k];
    int trials = 0;
    do {
      if (++trials > kMostTrials)
        throw RunError(
            "no room was found for a grain: the largest are too large for the box; take more grains");
      grain.position.x() = side * random.uniform();
      grain.position.y() = side * random.uniform();
    } while (!is_free(grain, packing.grains, side));
    packing.grains.push_back(grain);
  }
  std::sort(packing.grains.begin(), packing.grains.end(),
            [](const Grain& a, const Grain& b) { return a.id < b.id; });
  return packing;
}

}  // namespace polargrain::dem
