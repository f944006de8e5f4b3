// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "app/element/run_element.hpp"

namespace polargrain::app {

/// Mohr's circle of a stress, Pa, compression positive.
struct StressCircle {
  double largest = 0.0;  ///< principal stress
  double least = 0.0;
  [[nodiscard]] double centre() const { return 0.5 * (largest + least); }
  [[nodiscard]] double radius() const { return 0.5 * (largest - least); }
};

/// The straight envelope tau = cohesion + sigma tan(friction_angle).
struct FailureLine {
  double friction_angle = 0.0;  ///< rad
  double cohesion = 0.0;        ///< Pa; negative where the envelope bends
  double off = 0.0;             ///< root mean square of the radii's distances from it, Pa
};

/// The line by least squares of the radii: r = cohesion cos(angle) + centre sin(angle).
/// @returns nothing where there are fewer than two circles, their centres differ by less than 1 %, or no angle fits
std::optional<FailureLine> failure_line(std::span<const StressCircle> circles);

/// The tests of one specimen under several pressures, and the line along their circles.
struct EnvelopeOfSpecimen {
  std::string name;
  std::vector<double> pressures;  ///< of the tests that came to their end, Pa
  std::vector<StressCircle> circles;
  std::vector<bool> without_peak;  ///< of each circle: whether the angle still rises at the last row
  std::optional<FailureLine> line = {};
};

enum class FailureState {
  peak,  ///< the row with the largest mobilised friction angle
  end    ///< the last row
};

/// Of each specimen, over the tests, at each state.
struct Envelopes {
  std::size_t pressures = 0;
  std::vector<std::pair<FailureState, std::vector<EnvelopeOfSpecimen>>> at_states;
};

/// Whether a test may bring its material to failure. Isotropic and oedometer tests and radial unloading do not: a line along their
/// circles is no strength.
bool can_fail(const ElementSpecification& specification);
/// The reason in words, for the terminal.
std::string why_no_envelope();

/// @param results of one specification under these pressures
Envelopes envelopes_of(std::span<const ElementResult> results, std::span<const double> pressures);

/// For the terminal: angle and cohesion of each specimen, their mean and its 95 % interval, at the peak and at the end.
std::string envelope_summary(const Envelopes& all);
/// As CSV (docs/element_tests.md).
std::string envelope_table(const Envelopes& all);
/// Circles and lines at the peak as a part of a page.
std::string envelope_charts(const Envelopes& all);

}  // namespace polargrain::app
