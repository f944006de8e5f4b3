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
constexpr std::array<const char*, 3> kNames{"sheared", "turned", "bent"};

/// The measure of a stress for each limit, a share of its pressure.
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

namespace {

constexpr std::size_t kWays = 3;

/// The state of the packing on the way to each limit.
struct Pushed {
  std::array<double, kWays> largest{};   ///< share of the limit
  std::array<bool, kWays> is_known{};    ///< an answer on the way was at rest
  std::array<std::string, kWays> fault;  ///< why the path ended early; empty: it did not
};

/// @param going the ways to go
Pushed pushed(const CellCalls<2>& calls, const PlaneReply& packing,
              const std::array<Increment<2>, kWays>& increments, std::vector<std::size_t> going) {
  Pushed found;
  std::vector<PlaneReply> at(kWays, packing);
  for (int k = 0; k < kIncrements && !going.empty(); ++k) {
    std::vector<PlaneRequest> requests;
    for (const std::size_t way : going) requests.push_back({at[way].state, increments[way]});
    const std::vector<std::size_t> points(going.size(), 0);  // each stands for all
    std::vector<PlaneReply> replies = calls.evaluate(requests, points);
    std::vector<std::size_t> still;
    for (std::size_t r = 0; r < going.size(); ++r) {
      const std::size_t way = going[r];
      at[way] = std::move(replies[r]);
      const Response<2>& response = at[way].response;
      if (response.quality == Quality::failed) {
        found.fault[way] = response.message;
        continue;
      }
      still.push_back(way);
      if (response.quality != Quality::good) continue;  // grains that still move may be beyond a limit
      found.is_known[way] = true;
      found.largest[way] = std::max(found.largest[way], share(way, response.stress));
    }
    going = std::move(still);
  }
  return found;
}

std::array<Increment<2>, kWays> increments_to_limits(double mean_diameter) {
  std::array<Increment<2>, kWays> increments;
  increments[kSheared].displacement_gradient << kCompression, 0.0, 0.0, -kCompression;
  increments[kTurned].micro_rotation = kRotation;
  if (mean_diameter > 0.0) increments[kBent].curvature << kBending / mean_diameter, 0.0;
  return increments;
}

}  // namespace

CellLimits limits_without_bending(const CellCalls<2>& to_shear, const PlaneReply& at_rest,
                                  const CellCalls<2>& to_turn, const PlaneReply& at_rest_to_turn) {
  const std::array<Increment<2>, kWays> increments = increments_to_limits(0.0);
  const Pushed sheared = pushed(to_shear, at_rest, increments, {kSheared});
  const Pushed turned = pushed(to_turn, at_rest_to_turn, increments, {kTurned});
  const auto why_not = [](const Pushed& found, std::size_t way) -> std::string {
    if (found.is_known[way]) return {};
    return found.fault[way].empty() ? "its grains do not come to rest" : found.fault[way];
  };
  return {sheared.largest[kSheared], turned.largest[kTurned], 0.0, why_not(sheared, kSheared),
          why_not(turned, kTurned)};
}

CellLimits limits_of(const CellCalls<2>& calls, const PlaneReply& packing, double mean_diameter) {
  const Pushed found =
      pushed(calls, packing, increments_to_limits(mean_diameter), {kSheared, kTurned, kBent});
  for (std::size_t way = 0; way < kWays; ++way) {
    if (!found.fault[way].empty())
      throw RunError(fmt::format("the limits of a packing cannot be found: {} it fails: {}", kNames[way],
                                 found.fault[way]));
  }
  for (std::size_t way = 0; way < kWays; ++way) {
    if (!(found.largest[way] > 0.0))
      throw RunError(
          fmt::format("the limits of a packing cannot be found: {} it resists nothing; 'model: informed' "
                      "with 'rotations: "
                      "controlled' needs sliding friction, and rolling resistance or grains of unequal radii",
                      kNames[way]));
  }
  return {found.largest[kSheared], found.largest[kTurned], found.largest[kBent], {}, {}};
}

}  // namespace polargrain::coupler
