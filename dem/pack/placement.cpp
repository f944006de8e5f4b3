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

/// Random places, each free of those taken before, can fill a share of 0.547 of the plane with equal discs,
/// and 0.38 of space with equal spheres; well below it a place is found in a few trials.
constexpr double kSolidFraction = 0.4;
constexpr double kSolidFractionInSpace = 0.25;
constexpr int kMostTrials = 100'000;

double area_of_disc(double radius) {
  return std::numbers::pi * radius * radius;
}

double volume_of_sphere(double radius) {
  return 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
}

bool is_free(const Grain& grain, const std::vector<Grain>& placed, double side) {
  return std::none_of(placed.begin(), placed.end(), [&](const Grain& other) {
    Eigen::Vector3d apart;
    apart << grain.position - other.position, grain.height - other.height;
    for (double& component : apart) component -= side * std::round(component / side);
    const double reach = grain.radius + other.radius;
    return apart.squaredNorm() < reach * reach;
  });
}

}  // namespace

Packing place_grains(const PackingSpecification& specification) {
  RandomNumbers random(specification.seed);
  const bool space = specification.dimension == 3;
  SizeLaw law = specification.sizes;
  law.spheres = specification.spheres;
  std::vector<double> radii = draw_radii(law, specification.grains, random);
  double filled = 0.0;  // area or volume
  for (const double radius : radii) filled += space ? volume_of_sphere(radius) : area_of_disc(radius);
  const double side = space ? std::cbrt(filled / kSolidFractionInSpace) : std::sqrt(filled / kSolidFraction);
  Packing packing;
  packing.dimension = specification.dimension;
  packing.box = side * Eigen::Matrix2d::Identity();
  packing.thickness = space ? side : specification.thickness;

  // The large ones first: they would find no room later. Names stay in the order of the draw.
  std::vector<std::size_t> order(radii.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return radii[a] > radii[b]; });
  for (const std::size_t k : order) {
    Grain grain;
    grain.id = static_cast<std::int64_t>(k);
    grain.radius = radii[k];
    grain.mass =
        specification.density * (specification.spheres ? volume_of_sphere(radii[k])
                                                       : area_of_disc(radii[k]) * specification.thickness);
    grain.moment_of_inertia = (specification.spheres ? 0.4 : 0.5) * grain.mass * radii[k] * radii[k];
    int trials = 0;
    do {
      if (++trials > kMostTrials)
        throw RunError(
            "no room was found for a grain: the largest are too large for the box; take more grains");
      grain.position.x() = side * random.uniform();
      grain.position.y() = side * random.uniform();
      if (space) grain.height = side * random.uniform();
    } while (!is_free(grain, packing.grains, side));
    packing.grains.push_back(grain);
  }
  std::sort(packing.grains.begin(), packing.grains.end(),
            [](const Grain& a, const Grain& b) { return a.id < b.id; });
  return packing;
}

}  // namespace polargrain::dem
