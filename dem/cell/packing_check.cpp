// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/cell/packing_check.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace polargrain::dem {

std::string description(const Overlaps& overlaps, double allowance) {
  return fmt::format(
      "grains overlap by {:.1f} % of their radius on average, {:.1f} % at most (allowed: {:.0f} and {:.0f} "
      "%)",
      100.0 * overlaps.mean, 100.0 * overlaps.largest, 100.0 * allowance * kMostMeanOverlap,
      100.0 * allowance * kMostOverlap);
}

bool too_large(const Overlaps& overlaps, double allowance) {
  return !(overlaps.mean <= allowance * kMostMeanOverlap && overlaps.largest <= allowance * kMostOverlap);
}

Overlaps overlaps_of(std::span<const Contact> contacts, std::span<const double> radii) {
  Overlaps found;
  for (const Contact& contact : contacts) {
    const double first = radii[static_cast<std::size_t>(contact.first)];
    const double second = radii[static_cast<std::size_t>(contact.second)];
    const double overlap =
        (first + second - std::hypot(contact.branch.x(), contact.branch.y(), contact.branch.z())) /
        std::min(first, second);
    found.mean += overlap / static_cast<double>(contacts.size());
    found.largest = std::max(found.largest, overlap);
  }
  return found;
}

namespace {

double largest_radius(const Packing& packing) {
  double largest = 0.0;
  for (const Grain& grain : packing.grains) largest = std::max(largest, grain.radius);
  return largest;
}

/// Grains by the bins they lie in; bins divide the box evenly and are wider than any two grains that touch. A plane
/// packing has one layer of them.
class BinsOfPacking {
 public:
  explicit BinsOfPacking(const Packing& packing) : base_(packing.base_vectors()), axes_(packing.dimension) {
    const double largest = largest_radius(packing);
    const Eigen::Matrix3d inverse = base_.inverse();
    for (int axis = 0; axis < axes_; ++axis) {
      const double width = 1.0 / inverse.row(axis).norm();  // between two faces
      counts_[static_cast<std::size_t>(axis)] =
          static_cast<int>(std::clamp(width / (2.0 * largest), 1.0, 1e4));
    }
    for (std::size_t k = 0; k < packing.grains.size(); ++k) {
      const Grain& grain = packing.grains[k];
      Eigen::Vector3d part =
          inverse * Eigen::Vector3d(grain.position.x(), grain.position.y(), axes_ == 3 ? grain.height : 0.0);
      for (int axis = 0; axis < 3; ++axis) part(axis) -= std::floor(part(axis));
      places_.push_back(part);
      bins_[bin_of(k, {0, 0, 0})].push_back(k);
    }
  }

  /// Calls `visit(i, j, distance)` for each two grains in bins next to each other, until it returns false.
  template <class Visit>
  void for_near_pairs(Visit visit) const {
    for (std::size_t i = 0; i < places_.size(); ++i) {
      std::set<Steps> near;  // in a small box one bin lies on several sides
      for_steps([&](const Steps& steps) { near.insert(bin_of(i, steps)); });
      for (const Steps& bin : near) {
        const auto found = bins_.find(bin);
        if (found == bins_.end()) continue;
        for (const std::size_t j : found->second)
          if (j > i && !visit(i, j, distance(i, j))) return;
      }
    }
  }

  /// How many images of one grain touch another.
  [[nodiscard]] int contacts_of(std::size_t i, std::size_t j, double reach) const {
    int count = 0;
    for_images(i, j, [&](double distance) { count += distance < reach ? 1 : 0; });
    return count;
  }

  /// The shortest way from a grain to its own image, m.
  [[nodiscard]] double period() const {
    double least = base_.norm();
    for_steps([&](const Steps& steps) {
      if (steps != Steps{}) least = std::min(least, (base_ * vector(steps)).norm());
    });
    return least;
  }

 private:
  using Steps = std::array<int, 3>;

  static Eigen::Vector3d vector(const Steps& steps) {
    return Eigen::Vector3i(steps[0], steps[1], steps[2]).cast<double>();
  }
  /// All ways by at most one box, or one bin, along each axis.
  template <class Visit>
  void for_steps(Visit visit) const {
    const int up = axes_ == 3 ? 1 : 0;
    for (int layer = -up; layer <= up; ++layer)
      for (int row = -1; row <= 1; ++row)
        for (int column = -1; column <= 1; ++column) visit(Steps{column, row, layer});
  }
  [[nodiscard]] Steps bin_of(std::size_t k, const Steps& away) const {
    Steps bin{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const int count = counts_[axis];
      const double part = places_[k](static_cast<Eigen::Index>(axis));
      bin[axis] = (std::min(count - 1, static_cast<int>(part * count)) + away[axis] + count) % count;
    }
    return bin;
  }
  /// Calls `visit(distance)` for the images of two grains, the nearest among them.
  template <class Visit>
  void for_images(std::size_t i, std::size_t j, Visit visit) const {
    Eigen::Vector3d part = places_[i] - places_[j];
    for (int axis = 0; axis < axes_; ++axis) part(axis) -= std::round(part(axis));
    for_steps([&](const Steps& steps) { visit((base_ * (part + vector(steps))).norm()); });
  }
  /// Of the nearest images.
  [[nodiscard]] double distance(std::size_t i, std::size_t j) const {
    double least = base_.norm();
    for_images(i, j, [&](double distance) { least = std::min(least, distance); });
    return least;
  }

  Eigen::Matrix3d base_;
  int axes_;
  Steps counts_{1, 1, 1};
  std::vector<Eigen::Vector3d> places_;  ///< as parts of the base vectors, in [0, 1)
  std::map<Steps, std::vector<std::size_t>> bins_;
};

}  // namespace

std::string geometry_fault(const Packing& packing) {
  std::string fault;
  const BinsOfPacking bins(packing);
  const double period = bins.period();
  const double largest = largest_radius(packing);
  if (2.0 * largest - period > kMostOverlapToStart * largest)
    return fmt::format("a grain of radius {:.3g} m has no room in a box of period {:.3g} m", largest, period);
  bool some_touch = 2.0 * largest > period;  // its own image
  bins.for_near_pairs([&](std::size_t i, std::size_t j, double distance) {
    const Grain& first = packing.grains[i];
    const Grain& second = packing.grains[j];
    const double overlap = (first.radius + second.radius - distance) / std::min(first.radius, second.radius);
    some_touch = some_touch || overlap > 0.0;
    if (overlap <= kMostOverlapToStart) return true;
    fault = fmt::format(
        "the grains {} and {} overlap by {:.0f} % of the smaller radius, as if they were in one place: the "
        "packing is damaged, or its lengths are not in m",
        first.id, second.id, 100.0 * overlap);
    return false;
  });
  if (fault.empty() && !some_touch)
    fault = "the packing carries no pressure at rest: its grains do not touch";
  return fault;
}

std::string twofold_contact(const Packing& packing) {
  const BinsOfPacking bins(packing);
  const double largest = largest_radius(packing);
  if (bins.period() >= 4.0 * largest) return {};  // two images of a grain are too far apart
  std::string fault;
  bins.for_near_pairs([&](std::size_t i, std::size_t j, double) {
    const Grain& first = packing.grains[i];
    const Grain& second = packing.grains[j];
    if (bins.contacts_of(i, j, first.radius + second.radius) < 2) return true;
    fault = fmt::format(
        "the grains {} and {} touch on two sides of a box with a period of {:.3g} m: tangential springs are kept by "
        "the names of two grains and would be mixed up; take more grains, the period must be 4 radii of the largest "
        "({:.3g} m)",
        first.id, second.id, bins.period(), 4.0 * largest);
    return false;
  });
  return fault;
}

std::string packing_fault(const PackingAtRest& packing, double unrest, const std::string& script) {
  const double allowed = std::max(kMostUnrest, 10.0 * unrest);
  const Equilibrium& rest = packing.equilibrium;
  const char* const level = packing.space ? "k_n / (p d)" : "k_n / (p t)";
  std::string fault;
  if (!(packing.pressure > 0.0))
    fault = "the packing carries no pressure at rest: its grains do not touch";
  else if (!(packing.stiffness_level <= kMostStiffnessLevel))
    fault = "the packing carries no pressure to speak of: its grains touch without overlap";
  else if (!packing.turns)
    fault = "the rotations are to be controlled, but no grain has two contacts";
  else if (packing.recorded > 0.0 &&
           !(std::abs(packing.pressure / packing.recorded - 1.0) <= kPressureTolerance))
    fault = fmt::format("the packing was recorded under {:.5g} kPa and carries {:.5g} kPa",
                        1e-3 * packing.recorded, 1e-3 * packing.pressure);
  else if (!(rest.unbalanced_force_ratio <= allowed && rest.unbalanced_moment_ratio <= allowed))
    fault = fmt::format(
        "the packing is not at rest: unbalanced force ratio {:.2g}, moment ratio {:.2g}, at most {:.2g}",
        rest.unbalanced_force_ratio, rest.unbalanced_moment_ratio, allowed);
  else if (too_large(packing.overlaps))
    return fmt::format(
        "Under {}: {}: the contacts are too soft for the pressure ({} is {:.3g}); take a stiffer "
        "script or a lower pressure, and bring the packing to rest with it: 'polargrain pack --settle "
        "PACKING SCRIPT -o NEW.h5'",
        script, description(packing.overlaps), level, packing.stiffness_level);
  if (fault.empty()) return {};
  return fmt::format(
      "Under {}: {} (coordination number {:.2f}, {} {:.3g}, mean overlap {:.2g} of the radius). The "
      "packing was made with another script, or its grains were moved; bring it to rest with "
      "'polargrain pack --settle PACKING SCRIPT -o NEW.h5'",
      script, fault, rest.coordination_number, level, packing.stiffness_level, packing.overlaps.mean);
}

std::string answer_fault(const Overlaps& overlaps, double void_ratio, double most_void_ratio) {
  if (too_large(overlaps, kAllowanceOfAnswers))
    return fmt::format("{}: the contacts are too soft for this stress",
                       description(overlaps, kAllowanceOfAnswers));
  if (!(void_ratio <= most_void_ratio))
    return fmt::format("the void ratio is {:.3g}: beyond {:.1f} the grains are no packing any more",
                       void_ratio, most_void_ratio);
  return {};
}

}  // namespace polargrain::dem
