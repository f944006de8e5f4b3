// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/cell/packing_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace polargrain::dem {

std::string description(const Overlaps& overlaps) {
  return fmt::format(
      "grains overlap by {:.1f} % of their radius on average, {:.1f} % at most (allowed: {:.0f} and {:.0f} "
      "%)",
      100.0 * overlaps.mean, 100.0 * overlaps.largest, 100.0 * kMostMeanOverlap, 100.0 * kMostOverlap);
}

bool too_large(const Overlaps& overlaps) {
  return !(overlaps.mean <= kMostMeanOverlap && overlaps.largest <= kMostOverlap);
}

Overlaps overlaps_of(std::span<const Contact> contacts, std::span<const double> radii) {
  Overlaps found;
  for (const Contact& contact : contacts) {
    const double first = radii[static_cast<std::size_t>(contact.first)];
    const double second = radii[static_cast<std::size_t>(contact.second)];
    const double overlap =
        (first + second - std::hypot(contact.branch.x(), contact.branch.y(), contact.branch_3)) /
        std::min(first, second);
    found.mean += overlap / static_cast<double>(contacts.size());
    found.largest = std::max(found.largest, overlap);
  }
  return found;
}

std::string packing_fault(const PackingAtRest& packing, double unrest, const std::string& script) {
  const double allowed = std::max(kMostUnrest, 10.0 * unrest);
  const Equilibrium& rest = packing.equilibrium;
  std::string fault;
  if (!(packing.pressure > 0.0))
    fault = "the packing carries no pressure at rest: its grains do not touch";
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
        "Under {}: {}: the contacts are too soft for the pressure (k_n / (p t) is {:.3g}); take a stiffer "
        "script or a lower pressure, and bring the packing to rest with it: 'polargrain pack --settle "
        "PACKING "
        "SCRIPT -o NEW.h5'",
        script, description(packing.overlaps), packing.stiffness_level);
  if (fault.empty()) return {};
  return fmt::format(
      "Under {}: {} (coordination number {:.2f}, k_n / (p t) {:.3g}, mean overlap {:.2g} of the radius). The "
      "script is not the one the packing was made with, or the grains were moved; bring it to rest with "
      "'polargrain pack --settle PACKING SCRIPT -o NEW.h5'",
      script, fault, rest.coordination_number, packing.stiffness_level, packing.overlaps.mean);
}

std::string answer_fault(const Overlaps& overlaps, double void_ratio) {
  if (too_large(overlaps))
    return fmt::format("{}: the contacts are too soft for this stress", description(overlaps));
  if (!(void_ratio <= kMostVoidRatio))
    return fmt::format("the void ratio is {:.3g}: beyond {:.1f} the grains are no packing any more",
                       void_ratio, kMostVoidRatio);
  return {};
}

}  // namespace polargrain::dem
