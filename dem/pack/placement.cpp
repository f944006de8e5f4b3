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
/// Of beds, about: it says how wide the box of a cube of grains is.
constexpr double kSolidOfBed = 0.8;
constexpr double kSolidOfBedInSpace = 0.6;
/// Layers of a mean diameter that fall besides what is kept, and those of them that lie below.
constexpr int kLayersAside = 5;
constexpr int kLayersBelow = 3;
constexpr int kMostTrials = 100'000;

double area_of_disc(double radius) {
  return std::numbers::pi * radius * radius;
}

double volume_of_sphere(double radius) {
  return 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
}

/// A box to be filled: its sides, m, and whether it has a floor and a top across x2.
struct Room {
  Eigen::Vector3d sides;
  bool floor = false;
};

bool overlap(const Grain& grain, const Grain& other, const Eigen::Vector3d& sides) {
  Eigen::Vector3d apart;
  apart << grain.position - other.position, grain.height - other.height;
  for (int axis = 0; axis < 3; ++axis) apart(axis) -= sides(axis) * std::round(apart(axis) / sides(axis));
  const double reach = grain.radius + other.radius;
  return apart.squaredNorm() < reach * reach;
}

/// The grains that have been placed, in bins no narrower than two grains that touch.
class Placed {
 public:
  /// @param axes 2 or 3
  Placed(const Eigen::Vector3d& sides, int axes, double largest_radius) : sides_(sides) {
    for (int axis = 0; axis < axes; ++axis)
      counts_[axis] = std::clamp(static_cast<int>(sides(axis) / (2.0 * largest_radius)), 1, kMostBins);
    bins_.resize(static_cast<std::size_t>(counts_[0]) * counts_[1] * counts_[2]);
  }
  void add(const Grain& grain) { bins_[number(bin_of(grain))].push_back(grain); }
  [[nodiscard]] bool leaves_room_for(const Grain& grain) const {
    const Eigen::Array3i home = bin_of(grain);
    // With fewer than three bins along an axis the same ones would be seen twice.
    Eigen::Array3i least, most;
    for (int axis = 0; axis < 3; ++axis) {
      least[axis] = counts_[axis] < 3 ? 0 : home[axis] - 1;
      most[axis] = counts_[axis] < 3 ? counts_[axis] - 1 : home[axis] + 1;
    }
    for (int z = least[2]; z <= most[2]; ++z)
      for (int y = least[1]; y <= most[1]; ++y)
        for (int x = least[0]; x <= most[0]; ++x)
          for (const Grain& other : bins_[number({x, y, z})])
            if (overlap(grain, other, sides_)) return false;
    return true;
  }

 private:
  static constexpr int kMostBins = 200;
  [[nodiscard]] Eigen::Array3i bin_of(const Grain& grain) const {
    const Eigen::Array3d place(grain.position.x(), grain.position.y(), grain.height);
    Eigen::Array3i bin;
    for (int axis = 0; axis < 3; ++axis)
      bin[axis] =
          std::clamp(static_cast<int>(place[axis] / sides_[axis] * counts_[axis]), 0, counts_[axis] - 1);
    return bin;
  }
  [[nodiscard]] std::size_t number(const Eigen::Array3i& bin) const {
    const Eigen::Array3i folded((bin[0] + counts_[0]) % counts_[0], (bin[1] + counts_[1]) % counts_[1],
                                (bin[2] + counts_[2]) % counts_[2]);
    return (static_cast<std::size_t>(folded[2]) * counts_[1] + folded[1]) * counts_[0] + folded[0];
  }

  Eigen::Vector3d sides_;
  Eigen::Array3i counts_ = Eigen::Array3i::Ones();
  std::vector<std::vector<Grain>> bins_;
};

/// Area or volume of all.
double filled_by(const std::vector<double>& radii, bool space) {
  double filled = 0.0;
  for (const double radius : radii) filled += space ? volume_of_sphere(radius) : area_of_disc(radius);
  return filled;
}

std::vector<double> radii_of(const PackingSpecification& specification, int grains, RandomNumbers& random) {
  SizeLaw law = specification.sizes;
  law.spheres = specification.spheres;
  return draw_radii(law, grains, random);
}

/// Fills the room with grains of these radii, at random.
Packing placed(const PackingSpecification& specification, const std::vector<double>& radii, const Room& room,
               RandomNumbers& random) {
  const bool space = specification.dimension == 3;
  const Eigen::Vector3d& sides = room.sides;
  Packing packing;
  packing.dimension = specification.dimension;
  packing.box << sides.x(), 0.0, 0.0, sides.y();
  packing.thickness = space ? sides.z() : specification.thickness;

  // The large ones first: they would find no room later. Names stay in the order of the draw.
  std::vector<std::size_t> order(radii.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return radii[a] > radii[b]; });
  Placed before(sides, specification.dimension, radii.empty() ? 1.0 : radii[order.front()]);
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
      grain.position.x() = sides.x() * random.uniform();
      grain.position.y() = random.uniform();
      if (room.floor)
        grain.position.y() = grain.radius + (sides.y() - 2.0 * grain.radius) * grain.position.y();
      else
        grain.position.y() *= sides.y();
      if (space) grain.height = sides.z() * random.uniform();
    } while (!before.leaves_room_for(grain));
    before.add(grain);
    packing.grains.push_back(grain);
  }
  std::sort(packing.grains.begin(), packing.grains.end(),
            [](const Grain& a, const Grain& b) { return a.id < b.id; });
  return packing;
}

}  // namespace

Packing place_grains(const PackingSpecification& specification) {
  RandomNumbers random(specification.seed);
  const bool space = specification.dimension == 3;
  const std::vector<double> radii = radii_of(specification, specification.grains, random);
  const double filled = filled_by(radii, space);
  const double side = space ? std::cbrt(filled / kSolidFractionInSpace) : std::sqrt(filled / kSolidFraction);
  return placed(specification, radii, {Eigen::Vector3d::Constant(side)}, random);
}

Packing place_rain(const PackingSpecification& specification) {
  RandomNumbers random(specification.seed);
  const bool space = specification.dimension == 3;
  const double solid = space ? kSolidOfBedInSpace : kSolidOfBed;
  // The width is that of a first draw of the packing's own grains; all are drawn again together with the others.
  const std::vector<double> own = radii_of(specification, specification.grains, random);
  const double filled = filled_by(own, space);
  const double width = space ? std::cbrt(filled / solid) : std::sqrt(filled / solid);
  const double floor_area = space ? width * width : width;
  const double mean_diameter =
      2.0 * std::accumulate(own.begin(), own.end(), 0.0) / static_cast<double>(own.size());
  const double others = kLayersAside * mean_diameter * floor_area * solid / filled;
  const int grains = specification.grains + static_cast<int>(std::ceil(others * specification.grains));
  const std::vector<double> radii = radii_of(specification, grains, random);
  const double height =
      filled_by(radii, space) / (space ? kSolidFractionInSpace : kSolidFraction) / floor_area;
  return placed(specification, radii, {{width, height, width}, true}, random);
}

std::size_t grains_below(std::size_t fallen, std::size_t kept) {
  return (fallen - kept) * kLayersBelow / kLayersAside;
}

}  // namespace polargrain::dem
