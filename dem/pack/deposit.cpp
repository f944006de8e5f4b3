// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/pack/deposit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/elementary_functions.hpp"
#include "common/error.hpp"
#include "dem/box/box.hpp"
#include "dem/cell/packed_grains.hpp"
#include "dem/pack/fix_gravity.hpp"
#include "dem/pack/placement.hpp"

namespace polargrain::dem {

namespace {

/// Of the force on a grain.
constexpr double kLocalDamping = 0.3;
/// Overlap of a grain with the floor, over its radius, under its share of the whole weight.
constexpr double kFloorOverlap = 0.02;
/// The bed rests where the resultants add up to this share of its weight.
constexpr double kRest = 0.01;
constexpr int kDepositChunk = 200;
constexpr int kDepositChunksOfProgress = 10;
/// Cuts that are tried, over a range of this share of the grains, and shifts of each.
constexpr int kCuts = 9;
constexpr double kRangeOfCuts = 0.05;
constexpr int kShifts = 32;
/// Of the width of the box; the engine's tilts go to half of it, and shearing is still to come.
constexpr double kMostShift = 0.35;

/// How a bed is cut and closed.
struct Seam {
  std::size_t first = 0;
  double shift = 0.0;   // of the second base vector along x1, m
  double height = 0.0;  // of the box, m
};

/// The height at which nothing overlaps when the lower grains lie on the upper ones, shifted along x1.
double closed_height(const Packing& bed, std::span<const std::size_t> upper,
                     std::span<const std::size_t> lower, double shift) {
  const double width = bed.box(0, 0);
  double height = 0.0;
  for (const std::size_t i : upper)
    for (const std::size_t j : lower) {
      const Grain& top = bed.grains[i];
      const Grain& bottom = bed.grains[j];
      const double reach = top.radius + bottom.radius;
      double x = bottom.position.x() + shift - top.position.x();
      x -= width * std::round(x / width);
      if (std::abs(x) >= reach) continue;
      double z = bottom.height - top.height;
      if (bed.dimension == 3) z -= bed.thickness * std::round(z / bed.thickness);
      const double left = reach * reach - x * x - z * z;
      if (left > 0.0) height = std::max(height, top.position.y() - bottom.position.y() + std::sqrt(left));
    }
  return height;
}

/// Grains by their height in the bed, the lowest first.
std::vector<std::size_t> upwards(const Packing& bed) {
  std::vector<std::size_t> order(bed.grains.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return bed.grains[a].position.y() < bed.grains[b].position.y();
  });
  return order;
}

/// The closest seam at this cut.
Seam seam_at(const Packing& bed, std::span<const std::size_t> kept, std::size_t first) {
  double largest = 0.0;
  for (const Grain& grain : bed.grains) largest = std::max(largest, grain.radius);
  // Only the outermost two diameters can meet those of the other side first.
  const auto height_of = [&](std::size_t k) { return bed.grains[k].position.y(); };
  std::vector<std::size_t> upper;
  std::vector<std::size_t> lower;
  for (const std::size_t k : kept) {
    if (height_of(k) > height_of(kept.back()) - 4.0 * largest) upper.push_back(k);
    if (height_of(k) < height_of(kept.front()) + 4.0 * largest) lower.push_back(k);
  }
  Seam best{first, 0.0, 1e300};
  for (int step = 0; step < kShifts; ++step) {
    const double shift = bed.box(0, 0) * kMostShift * (2.0 * step / (kShifts - 1) - 1.0);
    const double height = closed_height(bed, upper, lower, shift);
    if (height < best.height) best = {first, shift, height};
  }
  return best;
}

}  // namespace

void PressedBox::begin_fall(double acceleration, double floor_stiffness, double damping) {
  gravity_->begin(acceleration, floor_stiffness, damping);
}

double PressedBox::unrest() const {
  return gravity_->unrest();
}

Packing cut_from_bed(const Packing& bed, std::size_t first, std::size_t count) {
  const std::vector<std::size_t> order = upwards(bed);
  const std::span<const std::size_t> grains(order);
  const auto range = static_cast<std::size_t>(kRangeOfCuts * static_cast<double>(count));
  const std::size_t lowest = first > range ? first - range : 0;
  const std::size_t highest = std::min(first + range, order.size() - count);
  Seam best{first, 0.0, 1e300};
  double least = 1e300;
  for (int cut = 0; cut < kCuts; ++cut) {
    const std::size_t from = lowest + (highest - lowest) * static_cast<std::size_t>(cut) / (kCuts - 1);
    const std::span<const std::size_t> kept = grains.subspan(from, count);
    const Seam seam = seam_at(bed, kept, from);
    double solid = 0.0;  // up to a factor
    for (const std::size_t k : kept) solid += std::pow(bed.grains[k].radius, bed.dimension);
    if (!(seam.height / solid < least)) continue;
    least = seam.height / solid;
    best = seam;
  }
  Packing closed = bed;
  closed.state = nullptr;
  closed.grains.clear();
  closed.box << bed.box(0, 0), best.shift, 0.0, best.height;
  const Box<2> box{closed.box};
  const double floor = bed.grains[order[best.first]].position.y();
  for (const std::size_t k : grains.subspan(best.first, count)) {
    Grain grain = bed.grains[k];
    grain.id = static_cast<std::int64_t>(closed.grains.size());
    grain.position.y() -= floor;
    grain.position = box.folded(grain.position);
    closed.grains.push_back(grain);
  }
  return closed;
}

Packing deposit(const PackingSpecification& specification, const Packing& rain,
                const MakingFriction& friction, const std::function<void(const PackingReached&)>& progress) {
  const std::unique_ptr<PressedBox> box = make_pressed_box(specification, rain, friction, Fall::yes);
  box->renew_time_step(0.0);
  const double floor_area = rain.box(0, 0) * rain.thickness;
  const double weight = specification.pressure * specification.share_of_axis[1] * floor_area;
  const double diameter = 2.0 * box->mean_radius();
  const double on_the_floor = floor_area / (diameter * (rain.dimension == 3 ? diameter : rain.thickness));
  box->begin_fall(weight / rain.grain_mass(), weight / on_the_floor / (kFloorOverlap * box->mean_radius()),
                  kLocalDamping);
  PackingReached reached;
  for (std::int64_t chunk = 1; chunk == 1 || box->unrest() > kRest; ++chunk) {
    if (reached.dem_steps > static_cast<double>(specification.most_steps))
      throw RunError(fmt::format(
          "the grains did not come to rest on the floor within {} DEM steps: their resultants add up to {:.2g} of "
          "their weight (at most {}); raise most_steps or the friction of the script",
          specification.most_steps, box->unrest(), kRest));
    box->move(Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), kDepositChunk, 0.0);
    box->renew_time_step(0.0);
    reached.dem_steps += kDepositChunk;
    if (!progress || chunk % kDepositChunksOfProgress != 0) continue;
    const PressedBox::Look seen = box->look();
    reached.coordination_number = seen.coordination_number;
    reached.void_ratio = seen.void_ratio;
    reached.unbalanced_force_ratio = seen.unbalanced_force_ratio;
    progress(reached);
  }
  const auto count = static_cast<std::size_t>(specification.grains);
  return cut_from_bed(box->packing(false), grains_below(rain.grains.size(), count), count);
}

PreparedPacking turned(PreparedPacking prepared, double angle) {
  if (angle == 0.0) return prepared;
  Packing& packing = prepared.packing;
  const auto [sine, cosine] = sine_and_cosine(angle);
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  turn.topLeftCorner<2, 2>() << cosine, -sine, sine, cosine;
  const Eigen::Matrix2d in_plane = turn.topLeftCorner<2, 2>();
  packing.box = in_plane * packing.box;
  packing.lean = in_plane * packing.lean;
  for (Grain& grain : packing.grains) grain.position = in_plane * grain.position;
  prepared.reached.stress = components(turn * tensor(prepared.reached.stress) * turn.transpose());
  prepared.reached.fabric = components(turn * tensor(prepared.reached.fabric) * turn.transpose());
  if (!packing.state) return prepared;
  // The engine's grains stay as they are: their box has a frame of its own, which turns.
  PackedGrains grains = decode_grains(*packing.state);
  const std::size_t count = grains.grains();
  if (grains.space)
    grains.space->orientation = turn * grains.space->orientation;
  else
    grains.box.orientation += angle;
  packing.state = encode(grains, count);
  return prepared;
}

}  // namespace polargrain::dem
