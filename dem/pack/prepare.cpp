// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/pack/prepare.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "common/error.hpp"
#include "dem/cell/packing_check.hpp"
#include "dem/pack/placement.hpp"
#include "dem/pack/pressed_box.hpp"

namespace polargrain::dem {

namespace {

/// DEM steps between two looks at the stress; the box makes one smooth move in between.
constexpr int kChunk = 20;
constexpr int kChunksOfProgress = 100;

using Progress = std::function<void(const PackingReached&)>;

/// One packing brought to rest under its pressure with one friction, or with the script's own.
class Compression {
 public:
  Compression(const PackingSpecification& specification, const Packing& start,
              const std::optional<MakingFriction>& friction)
      : specification_(specification),
        axes_(specification.dimension),
        planes_(axes_ == 3 ? 3 : 1),
        keep_contacts_(!friction || friction->sliding > 0.0),
        pressure_(specification.one_dimensional_from.value_or(specification.pressure)),
        box_(specification.dimension == 3 ? make_space_box(specification, start, friction)
                                          : make_plane_box(specification, start, friction)) {
    reached_.friction = friction ? friction->sliding : 0.0;
    box_->renew_time_step(0.0);
  }

  /// @throws RunError after too many steps
  PreparedPacking compress(const Progress& progress) {
    come_to_rest(progress);
    if (specification_.one_dimensional_from) {
      width_kept_ = true;
      pressure_ = specification_.pressure;
      come_to_rest(progress);
    }
    if (too_large(now_.overlaps))
      throw RunError(
          fmt::format("at rest under {:.5g} kPa {}: the contacts are too soft for the pressure; take a "
                      "stiffer script, or a lower pressure",
                      1e-3 * reached_.pressure, description(now_.overlaps)));
    PreparedPacking prepared{box_->packing(keep_contacts_), reached_, specification_.text};
    prepared.packing.pressure = reached_.pressure;
    return prepared;
  }

 private:
  void come_to_rest(const Progress& progress) {
    Eigen::Vector3d strain = Eigen::Vector3d::Zero();
    Eigen::Vector3d shear = Eigen::Vector3d::Zero();
    do {
      if (reached_.dem_steps > static_cast<double>(specification_.most_steps)) give_up();
      box_->move(strain, shear, kChunk, damping_rate_);
      reached_.dem_steps += kChunk;
      measure();
      for (int axis = first_axis(); axis < axes_; ++axis)
        strain(axis) = step_towards(-wanted(axis) - now_.stress(axis), now_.stiffness(axis), -1.0);
      // A right box would keep whatever shear stress its grains jam with.
      for (int plane = 0; plane < planes_; ++plane)
        shear(plane) = step_towards(-now_.shear(plane), now_.shear_stiffness(plane), 0.0);
      if (progress && ++chunk_ % kChunksOfProgress == 0) progress(reached_);
    } while (!done());
  }

  /// Of those that are strained.
  [[nodiscard]] int first_axis() const { return width_kept_ ? axes_ - 1 : 0; }
  /// Pressure asked of an axis, Pa.
  [[nodiscard]] double wanted(int axis) const {
    return pressure_ * specification_.share_of_axis[static_cast<std::size_t>(axis)];
  }

  /// The strain that adds the missing stress if the grains moved affinely, no faster than allowed.
  /// @param otherwise the direction to go in while nothing resists
  [[nodiscard]] double step_towards(double missing, double stiffness, double otherwise) const {
    const double time_of_grain = 2.0 * box_->mean_radius() * std::sqrt(specification_.density / pressure_);
    const double most = specification_.inertial_number / time_of_grain * kChunk * box_->time_step();
    return std::clamp(stiffness > 0.0 ? missing / stiffness : otherwise * most, -most, most);
  }

  void measure() {
    now_ = box_->look();
    damping_rate_ = std::max(
        damping_rate_, 2.0 * specification_.damping * std::sqrt(now_.normal_stiffness / box_->mean_mass()));
    box_->renew_time_step(damping_rate_);
    const Eigen::VectorXd stress = now_.stress.head(axes_);
    const double mean = stress.mean();
    reached_.void_ratio = now_.void_ratio;
    reached_.coordination_number = now_.coordination_number;
    reached_.rattlers = now_.rattlers;
    reached_.pressure = -mean;
    if (now_.contacts == 0 || mean == 0.0) return;
    reached_.anisotropy = 0.5 * (stress.maxCoeff() - stress.minCoeff()) / std::abs(mean);
    int plane = 0;
    now_.shear.cwiseAbs().maxCoeff(&plane);
    reached_.shear = now_.shear(plane) / mean;
    reached_.unbalanced_force_ratio = now_.unbalanced_force_ratio;
    reached_.unbalanced_moment_ratio = now_.unbalanced_moment_ratio;
  }

  [[nodiscard]] bool done() const {
    const double allowed = specification_.pressure_tolerance * pressure_;
    bool fits = now_.shear.cwiseAbs().maxCoeff() <= allowed;
    for (int axis = first_axis(); axis < axes_; ++axis)
      fits = fits && std::abs(now_.stress(axis) + wanted(axis)) <= allowed;
    return fits && now_.contacts > 0 &&
           reached_.unbalanced_force_ratio <= specification_.unbalanced_force_ratio &&
           reached_.unbalanced_moment_ratio <= specification_.unbalanced_force_ratio;
  }

  [[noreturn]] void give_up() const {
    throw RunError(fmt::format(
        "the packing did not come to rest under its stresses within {} DEM steps: mean pressure {:.6g} kPa "
        "(asked {:.6g}), "
        "anisotropy {:.1e}, shear {:.1e} (each within {:.1e}), unbalanced force ratio {:.1e}, "
        "moment ratio {:.1e} "
        "(at most {:.1e}), coordination number {:.2f}; raise pressure_tolerance, "
        "unbalanced_force_ratio, damping or "
        "most_steps",
        specification_.most_steps, 1e-3 * reached_.pressure, 1e-3 * pressure_, reached_.anisotropy,
        reached_.shear, specification_.pressure_tolerance, reached_.unbalanced_force_ratio,
        reached_.unbalanced_moment_ratio, specification_.unbalanced_force_ratio,
        reached_.coordination_number));
  }

  const PackingSpecification& specification_;
  int axes_;
  int planes_;               // that can be sheared
  bool keep_contacts_;       // with friction, what lies ready in tangential springs belongs to the packing
  double pressure_;          // that is aimed at, Pa
  bool width_kept_ = false;  // the last axis alone is strained, and `pressure_` is its own
  std::int64_t chunk_ = 0;
  std::unique_ptr<PressedBox> box_;
  double damping_rate_ = 0.0;
  PressedBox::Look now_;
  PackingReached reached_;
};

/// What a packing is made with: rolling friction in proportion to the sliding one, and none without it.
MakingFriction friction_of(const PackingSpecification& specification, double sliding) {
  MakingFriction friction{sliding, specification.rolling_friction};
  if (friction.rolling) *friction.rolling *= sliding > 0.0 ? sliding / specification.friction : 0.0;
  return friction;
}

/// Looks for a void ratio.
class Search {
 public:
  Search(const PackingSpecification& specification, const Packing& loose, const Progress& progress)
      : specification_(specification),
        wanted_(*specification.void_ratio),
        loose_(loose),
        progress_(progress) {}

  PreparedPacking find() {
    PreparedPacking dense = made(loose_, 0.0);
    if (fits(dense)) return dense;
    PreparedPacking loosest = made(loose_, specification_.friction);
    if (fits(loosest)) return loosest;
    if (wanted_ < dense.reached.void_ratio || wanted_ > loosest.reached.void_ratio)
      throw RunError(fmt::format(
          "a void ratio of {:.4g} is out of reach: friction from 0 to {:.4g} gives {:.4f} to {:.4f}; "
          "ask for one in between, or raise friction (while the packing is made) for "
          "looser ones",
          wanted_, specification_.friction, dense.reached.void_ratio, loosest.reached.void_ratio));
    // More friction while compressed leaves more voids, on the whole.
    const double slope = specification_.friction / (loosest.reached.void_ratio - dense.reached.void_ratio);
    double low = 0.0;
    double high = specification_.friction;
    for (int trial = 0; trial < kBisections; ++trial) {
      const double friction = 0.5 * (low + high);
      PreparedPacking packing = made(loose_, friction);
      if (fits(packing)) return packing;
      (packing.reached.void_ratio < wanted_ ? low : high) = friction;
    }
    return redrawn(0.5 * (low + high), slope);
  }

 private:
  static constexpr int kBisections = 6;
  static constexpr int kRedraws = 24;
  static constexpr double kCautious = 0.3;  // part of a correction: most of the difference is scatter

  PreparedPacking made(const Packing& start, double friction) {
    Compression compression(specification_, start, friction_of(specification_, friction));
    PreparedPacking packing = compression.compress(progress_);
    closest_ = std::min(closest_, std::abs(packing.reached.void_ratio - wanted_));
    return packing;
  }

  [[nodiscard]] bool fits(const PreparedPacking& packing) const {
    return std::abs(packing.reached.void_ratio - wanted_) <= specification_.void_ratio_tolerance;
  }

  /// Where grains give way all at once, the void ratio jumps over the one wanted. Other places of the grains
  /// jump elsewhere: they are drawn anew, with numbers that follow from the seed.
  /// @param slope friction over void ratio, on the whole
  PreparedPacking redrawn(double friction, double slope) {
    PackingSpecification other = specification_;
    for (int draw = 1; draw <= kRedraws; ++draw) {
      other.seed = specification_.seed + 1'000'003ULL * static_cast<std::uint64_t>(draw);
      PreparedPacking packing = made(place_grains(other), friction);
      if (fits(packing)) return packing;
      friction = std::clamp(friction + kCautious * slope * (wanted_ - packing.reached.void_ratio), 0.0,
                            specification_.friction);
    }
    throw RunError(fmt::format(
        "no packing with a void ratio of {:.4g} within {:.1e} was found; the closest was {:.1e} off. Raise "
        "void_ratio_tolerance, take more grains (the void ratio then changes less from try to try) or "
        "another seed",
        wanted_, specification_.void_ratio_tolerance, closest_));
  }

  const PackingSpecification& specification_;
  double wanted_;
  const Packing& loose_;
  const Progress& progress_;
  double closest_ = 1e300;
};

}  // namespace

PreparedPacking prepare_packing(const PackingSpecification& specification,
                                const std::function<void(const PackingReached&)>& progress) {
  const Packing loose = place_grains(specification);
  if (specification.void_ratio) return Search(specification, loose, progress).find();
  return Compression(specification, loose, friction_of(specification, specification.friction))
      .compress(progress);
}

PreparedPacking settle_packing(const PackingSpecification& specification, const PreparedPacking& packing,
                               const std::function<void(const PackingReached&)>& progress) {
  const Packing& start = packing.packing;
  PackingSpecification asked = specification;
  asked.dimension = start.dimension;
  double mass = 0.0;
  double volume = 0.0;
  for (const Grain& grain : start.grains) {
    mass += grain.mass;
    const double area = std::numbers::pi * grain.radius * grain.radius;
    volume += area * (start.dimension == 3 ? 4.0 / 3.0 * grain.radius : start.thickness);
  }
  asked.density = mass / volume;
  PreparedPacking settled = Compression(asked, start, std::nullopt).compress(progress);
  settled.reached.friction = packing.reached.friction;
  return settled;
}

}  // namespace polargrain::dem
