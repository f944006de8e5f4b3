// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/remarks/given_stress.hpp"

#include <algorithm>
#include <cmath>

namespace polargrain::app {
namespace {

constexpr double kRatioAtRest = 0.5;  ///< of sand: 1 - sin of 30 deg

bool holds(const fem::InitialStress<2>& item, const std::string& region) {
  return item.region.empty() || item.region == region;
}

}  // namespace

std::optional<Vector7> given_stress(const Scene& scene, const std::string& region,
                                    const Eigen::Vector2d& place) {
  std::optional<Vector7> given;
  for (const fem::InitialStress<2>& item : scene.problem().initial_stresses)
    if (holds(item, region)) given = item.stress(place);
  if (given)
    for (const int across : {k11, k33})
      if (std::isnan((*given)(across))) (*given)(across) = kRatioAtRest * (*given)(k22);
  return given;
}

bool has_given_stress(const Scene& scene, const std::string& region) {
  return std::ranges::any_of(scene.problem().initial_stresses,
                             [&](const fem::InitialStress<2>& item) { return holds(item, region); });
}

}  // namespace polargrain::app
