// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/pack/prepare.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/error.hpp"
#include "dem/cell/packing_check.hpp"
#include "dem/pack/deposit.hpp"
#include "dem/pack/placement.hpp"
#include "dem/pack/pressed_box.hpp"
#include "grains_io/packing_data.hpp"

namespace polargrain::dem {

namespace {

/// DEM steps between two looks at the stress; the box makes one smooth move in between.
constexpr int kPrepareChunk = 20;
constexpr int kPrepareChunksOfProgress = 100;
/// Grains fall along -x2.
constexpr int kFallAxis = 1;

using Progress = std::function<void(const PackingReached&)>;

/// The aim of a box: the stress of those axes that are strained, in its frame, compression positive, Pa.
struct Aim {
  Eigen::Matrix3d stress = Eigen::Matrix3d::Zero();
  double pressure = 0.0;  // that tolerance and rate refer to, Pa
  std::array<bool, 3> strained{true, true, true};
};

Aim aim_at(const PackingSpecification& specification, double pressure) {
  Aim aim;
  aim.pressure = pressure;
  for (int axis = 0; axis < 3; ++axis)
    aim.stress(axis, axis) = pressure * specification.share_of_axis[static_cast<std::size_t>(axis)];
  return aim;
}

/// Along one axis only, the last one unless grains fall.
Aim one_dimensional(Aim aim, int axis) {
  aim.strained = {};
  aim.strained[static_cast<std::size_t>(axis)] = true;
  aim.pressure = aim.stress(axis, axis);
  return aim;
}

/// One after the other.
std::vector<Aim> aims_of(const PackingSpecification& specification) {
  const Aim end = aim_at(specification, specification.pressure);
  if (specification.deposition) {
    const Aim closing = one_dimensional(end, kFallAxis);
    if (specification.deposition->keeps_width) return {closing};
    return {closing, end};
  }
  if (!specification.one_dimensional_from) return {end};
  return {aim_at(specification, *specification.one_dimensional_from),
          one_dimensional(end, specification.dimension - 1)};
}

/// One packing brought to rest under its pressure with one friction, or with the script's own.
class Compression {
 public:
  Compression(const PackingSpecification& specification, const Packing& start,
              const std::optional<MakingFriction>& friction)
      : specification_(specification),
        axes_(specification.dimension),
        planes_(axes_ == 3 ? 3 : 1),
        keep_contacts_(!friction || friction->sliding > 0.0),
        frame_(frame_of_packing_data(start)),
        box_(make_pressed_box(specification, start, friction)) {
    reached_.friction = friction ? friction->sliding : 0.0;
    box_->renew_time_step(0.0);
  }

  /// @param aims in the laboratory @throws RunError after too many steps
  PreparedPacking compress(const std::vector<Aim>& aims, const Progress& progress) {
    for (const Aim& aim : aims) {
      aim_ = aim;
      aim_.stress = frame_.transpose() * aim.stress * frame_;
      come_to_rest(progress);
    }
    const PressedBox::Shape shape = box_->shape();
    reached_.fabric = components(frame_ * shape.fabric * frame_.transpose());
    if (too_large(shape.overlaps))
      throw RunError(
          fmt::format("at rest under {:.5g} kPa {}: the contacts are too soft for the pressure; take a "
                      "stiffer script, or a lower pressure, and look at the units of the sizes",
                      1e-3 * reached_.pressure, description(shape.overlaps)));
    PreparedPacking prepared{box_->packing(keep_contacts_), reached_, specification_.text, box_->stepping()};
    prepared.packing.pressure = reached_.pressure;
    if (keep_contacts_)
      if (const std::string fault = twofold_contact(prepared.packing); !fault.empty()) throw RunError(fault);
    return prepared;
  }

 private:
  void come_to_rest(const Progress& progress) {
    Eigen::Vector3d strain = Eigen::Vector3d::Zero();
    Eigen::Vector3d shear = Eigen::Vector3d::Zero();
    do {
      if (reached_.dem_steps > static_cast<double>(specification_.most_steps)) give_up();
      box_->move(strain, shear, kPrepareChunk, damping_rate_);
      reached_.dem_steps += kPrepareChunk;
      measure();
      strain.setZero();
      for (int axis = 0; axis < axes_; ++axis)
        if (strained(axis))
          strain(axis) =
              step_towards(-aim_.stress(axis, axis) - now_.stress(axis), now_.stiffness(axis), -1.0);
      // A right box would keep whatever shear stress its grains jam with.
      for (int plane = 0; plane < planes_; ++plane)
        shear(plane) =
            step_towards(-aim_of_shear(plane) - now_.shear(plane), now_.shear_stiffness(plane), 0.0);
      if (progress && ++chunk_ % kPrepareChunksOfProgress == 0) progress(reached_);
    } while (!done());
  }

  [[nodiscard]] bool strained(int axis) const { return aim_.strained[static_cast<std::size_t>(axis)]; }
  [[nodiscard]] double aim_of_shear(int plane) const {
    const auto [i, j] = kPlanes[static_cast<std::size_t>(plane)];
    return aim_.stress(i, j);
  }

  /// The strain that adds the missing stress if the grains moved affinely, no faster than allowed.
  /// @param otherwise the direction to go in while nothing resists
  [[nodiscard]] double step_towards(double missing, double stiffness, double otherwise) const {
    const double time_of_grain =
        2.0 * box_->mean_radius() * std::sqrt(specification_.density / aim_.pressure);
    const double most = specification_.inertial_number / time_of_grain * kPrepareChunk * box_->time_step();
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
    Eigen::Matrix3d whole = Eigen::Matrix3d::Zero();
    whole.diagonal().head(axes_) = stress;
    for (int of = 0; of < planes_; ++of) {
      const auto [i, j] = kPlanes[static_cast<std::size_t>(of)];
      whole(i, j) = whole(j, i) = now_.shear(of);
    }
    reached_.stress = components(frame_ * whole * frame_.transpose());
  }

  [[nodiscard]] bool done() const {
    const double allowed = specification_.pressure_tolerance * aim_.pressure;
    bool fits = true;
    for (int plane = 0; plane < planes_; ++plane)
      fits = fits && std::abs(now_.shear(plane) + aim_of_shear(plane)) <= allowed;
    for (int axis = 0; axis < axes_; ++axis)
      fits = fits && (!strained(axis) || std::abs(now_.stress(axis) + aim_.stress(axis, axis)) <= allowed);
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
        "(at most {:.1e}), coordination number {:.2f}; {}",
        specification_.most_steps, 1e-3 * reached_.pressure, 1e-3 * aim_.pressure, reached_.anisotropy,
        reached_.shear, specification_.pressure_tolerance, reached_.unbalanced_force_ratio,
        reached_.unbalanced_moment_ratio, specification_.unbalanced_force_ratio, reached_.coordination_number,
        remedy()));
  }

  /// Below this the grains are hard for their stress as sand is under the weight of a millimetre of it: a contact opens
  /// and closes over less than rounding leaves of its overlap.
  static constexpr double kLowPressure = 1e3;  // Pa

  [[nodiscard]] std::string remedy() const {
    const std::string keys = "raise pressure_tolerance, damping or most_steps";
    if (aim_.pressure >= kLowPressure) return keys;
    return fmt::format(
        "{:.3g} Pa is very little for contacts of this stiffness: ask for 1 kPa or more, lower the stiffness of the contacts in "
        "the script with the pressure, or {}",
        aim_.pressure, keys);
  }

  const PackingSpecification& specification_;
  int axes_;
  int planes_;             // that can be sheared
  bool keep_contacts_;     // with friction the tangential springs belong to the packing
  Eigen::Matrix3d frame_;  // of the box, to the laboratory
  Aim aim_;                // in the frame of the box
  std::int64_t chunk_ = 0;
  std::unique_ptr<PressedBox> box_;
  double damping_rate_ = 0.0;
  PressedBox::Look now_;
  PackingReached reached_;
};

/// The friction while a packing is made: rolling friction in proportion to the sliding one, and zero without it.
MakingFriction friction_of(const PackingSpecification& specification, double sliding) {
  MakingFriction friction{sliding, specification.rolling_friction};
  if (friction.rolling) *friction.rolling *= sliding > 0.0 ? sliding / specification.friction : 0.0;
  return friction;
}

/// The loose start of a packing, and what is made of it.
Packing loose_start(const PackingSpecification& specification) {
  return specification.deposition ? place_rain(specification) : place_grains(specification);
}

PreparedPacking made_of(const PackingSpecification& specification, const Packing& loose, double sliding,
                        const Progress& progress) {
  const MakingFriction friction = friction_of(specification, sliding);
  const std::optional<Deposition>& deposition = specification.deposition;
  const Packing start = deposition ? deposit(specification, loose, friction, progress) : loose;
  PreparedPacking made =
      Compression(specification, start, friction).compress(aims_of(specification), progress);
  return deposition ? turned(std::move(made), deposition->bedding_angle) : made;
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
          "ask for a ratio in between, or raise friction (while the packing is made) for "
          "looser packings",
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
    PreparedPacking packing = made_of(specification_, start, friction, progress_);
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
      PreparedPacking packing = made(loose_start(other), friction);
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
  const Packing loose = loose_start(specification);
  if (specification.void_ratio) return Search(specification, loose, progress).find();
  return made_of(specification, loose, specification.friction, progress);
}

PreparedPacking settle_packing(const PackingSpecification& specification, const PreparedPacking& packing,
                               const std::function<void(const PackingReached&)>& progress) {
  const Packing& start = packing.packing;
  PackingSpecification asked = specification;
  asked.dimension = start.dimension;
  asked.density = start.grain_mass() / start.grain_volume();
  asked.deposition = {};
  std::vector<Aim> aims = aims_of(asked);
  const Eigen::Matrix3d recorded = tensor(packing.reached.stress);
  if (asked.keeps_stresses && recorded.trace() < 0.0) {
    aims.back().stress = -recorded;
    aims.back().pressure = -recorded.trace() / start.dimension;
  }
  PreparedPacking settled = Compression(asked, start, std::nullopt).compress(aims, progress);
  settled.reached.friction = packing.reached.friction;
  return settled;
}

}  // namespace polargrain::dem
