// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/cells/cell_limits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "common/error.hpp"

namespace polargrain::coupler {
namespace {

/// To a shear of 4 %, which passes the peak of dense packings; grains turned by 0.04 and bent by 0.06 rad a diameter,
/// where contacts are at their limits (dem_limits_test).
constexpr int kIncrements = 20;
constexpr double kCompression = 1e-3;
constexpr double kRotation = 2e-3;
constexpr double kBending = 3e-3;

enum Way : std::size_t { kSheared, kTurned, kBent };
constexpr std::array<const char*, 3> kWays{"sheared", "turned", "bent"};

/// What a stress is of each limit.
double share(std::size_t way, const Vector7& stress) {
  const double pressure = -0.5 * (stress[k11] + stress[k22]);
  if (!(pressure > 0.0)) return 0.0;
  if (way == kTurned) return std::abs(stress[k21] - stress[k12]) / pressure;
  if (way == kBent) return stress.tail<2>().norm() / pressure;
  const double sine =
      std::hypot(0.5 * (stress[k11] - stress[k22]), 0.5 * (stress[k12] + stress[k21])) / pressure;
  return std::numbers::sqrt3 * sine;  // B.3 at constant volume
}

}  // namespace

fem::InvariantWeights CellLimits::weights(double internal_length) const {
  const double of_skew = 4.0 / 3.0 * std::pow(friction / skew, 2);
  return {0.25 + 0.25 * of_skew, 0.25 - 0.25 * of_skew,
          0.5 * couple_weight(friction, internal_length, couple)};
}

double couple_weight(double friction, double internal_length, double limit) {
  return 2.0 / 3.0 * std::pow(friction * internal_length / limit, 2);
}

double CellLimits::plastic_length() const {
  return std::sqrt(1.5) * couple / friction;
}

std::string CellLimits::text() const {
  return fmt::format(
      "M {:.4g}, skew stress {:.4g} of the pressure, couple stress {:.4g} mm times the pressure (plastic "
      "length {:.3g} mm)",
      friction, skew, 1e3 * couple, 1e3 * plastic_length());
}

CellLimits limits_of(const CellCalls& calls, const PlaneReply& packing, double mean_diameter) {
  std::array<Increment, 3> increments;
  increments[kSheared].displacement_gradient << kCompression, 0.0, 0.0, -kCompression;
  increments[kTurned].micro_rotation = kRotation;
  increments[kBent].curvature << kBending / mean_diameter, 0.0;
  std::array<double, 3> largest{};
  std::vector<PlaneReply> at(3, packing);
  const std::vector<std::size_t> points(3, 0);  // each stands for all
  for (int k = 0; k < kIncrements; ++k) {
    std::vector<PlaneRequest> requests;
    for (std::size_t way = 0; way < 3; ++way) requests.push_back({at[way].state, increments[way]});
    at = calls.evaluate(requests, points);
    for (std::size_t way = 0; way < 3; ++way) {
      if (at[way].response.quality == Quality::failed)
        throw RunError(fmt::format("the limits of a packing cannot be found: {} it fails: {}", kWays[way],
                                   at[way].response.message));
      if (at[way].response.quality == Quality::good)  // what is not at rest may be beyond a limit
        largest[way] = std::max(largest[way], share(way, at[way].response.stress));
    }
  }
  for (std::size_t way = 0; way < 3; ++way) {
    if (!(largest[way] > 0.0))
      throw RunError(
          fmt::format("the limits of a packing cannot be found: {} it resists nothing; 'model: informed' "
                      "with 'rotations: "
                      "controlled' needs sliding friction, and rolling resistance or grains of unequal radii",
                      kWays[way]));
  }
  return {largest[kSheared], largest[kTurned], largest[kBent]};
}

}  // namespace polargrain::coupler
