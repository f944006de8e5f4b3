// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/element/envelope.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "app/commands/csv_file.hpp"
#include "app/page/page.hpp"
#include "common/elementary_functions.hpp"
#include "common/mean_and_interval.hpp"
#include "element/measures.hpp"

namespace polargrain::app {
namespace {

constexpr double kDegreeOfEnvelope = std::numbers::pi / 180.0;

/// Of a row of the table of columns.
StressCircle circle_of(const std::vector<std::string>& columns, const std::vector<double>& row) {
  element::Vector6 stress = element::Vector6::Zero();
  bool is_plane = true;
  for (int place = 0; place < 6; ++place) {
    const std::string name = std::string("s") + element::kPlaceNames[static_cast<std::size_t>(place)] + "_Pa";
    const auto found = std::ranges::find(columns, name);
    if (found == columns.end()) continue;
    stress(place) = row[static_cast<std::size_t>(found - columns.begin())];
    if (place == element::k33) is_plane = false;
  }
  const element::StressMeasures measures =
      element::measures_of(stress, is_plane ? element::Room::discs : element::Room::space);
  return {measures.largest, measures.least};
}

const std::vector<double>& row_at(const ElementResult& result, const ElementCurve& curve,
                                  FailureState state) {
  if (state == FailureState::end) return curve.rows.back();
  const auto column = static_cast<std::size_t>(std::ranges::find(result.columns, "friction_angle_deg") -
                                               result.columns.begin());
  const auto angle = [column](const std::vector<double>& row) {
    return std::isnan(row[column]) ? -HUGE_VAL : row[column];
  };
  return *std::ranges::max_element(rows_of_test(result, curve), {}, angle);
}

/// Whether the largest angle is that of the last row. A plateau is as good as a peak: the tolerance of stresses makes its angles
/// differ by less than a thousandth.
bool rises_to_end(const ElementResult& result, const ElementCurve& curve) {
  constexpr double kPlateau = 1e-3;
  if (&row_at(result, curve, FailureState::peak) != &curve.rows.back()) return false;
  const auto column = static_cast<std::size_t>(std::ranges::find(result.columns, "friction_angle_deg") -
                                               result.columns.begin());
  // The last tenth of the rows is left out: many rows rise by less than that each.
  const auto rows = rows_of_test(result, curve);
  const std::size_t left_out = std::max<std::size_t>(1, rows.size() / 10);
  double before = 0.0;
  for (std::size_t k = 0; k + left_out < rows.size(); ++k) before = std::fmax(before, rows[k][column]);
  return curve.rows.back()[column] > (1.0 + kPlateau) * before;
}

const char* state_name(FailureState state, bool has_peak) {
  if (state == FailureState::end) return "end";
  return has_peak ? "peak" : "largest";
}

bool has_peaks(const EnvelopeOfSpecimen& envelope) {
  return std::ranges::none_of(envelope.without_peak, [](bool missing) { return missing; });
}

/// Whether the centres differ: by less than a hundredth of their mean, a line along the circles would be chance.
bool are_apart(std::span<const StressCircle> circles) {
  constexpr double kApart = 0.01;
  if (circles.empty()) return false;
  const auto [least, largest] = std::ranges::minmax(circles, {}, &StressCircle::centre);
  const double mean = 0.5 * (least.centre() + largest.centre());
  return largest.centre() - least.centre() > kApart * std::abs(mean);
}

/// A line for each envelope without one, and for each test without a peak.
std::vector<std::string> lines_on_missing(const Envelopes& all) {
  std::vector<std::string> lines;
  for (const auto& [state, envelopes] : all.at_states)
    for (const EnvelopeOfSpecimen& envelope : envelopes)
      if (!envelope.line)
        lines.push_back(fmt::format(
            "{}, {}: no line: {}", envelope.name, state_name(state, has_peaks(envelope)),
            envelope.circles.size() < 2 ? "it takes two tests that came to their end"
            : are_apart(envelope.circles)
                ? "the radii grow as much as the centres, and no friction angle does that"
                : "the centres of the circles differ by less than 1 %; let the tests fail at different stresses"));
  for (const auto& [state, envelopes] : all.at_states)
    for (const EnvelopeOfSpecimen& envelope : envelopes)
      for (std::size_t k = 0; k < envelope.circles.size(); ++k)
        if (envelope.without_peak[k])
          lines.push_back(
              fmt::format("{}: at {:.4g} kPa the largest angle is the last row: no peak was reached",
                          envelope.name, 1e-3 * envelope.pressures[k]));
  return lines;
}

struct EnvelopeLines {
  std::vector<double> angles;     ///< degrees
  std::vector<double> cohesions;  ///< Pa
};

EnvelopeLines lines_of(const std::vector<EnvelopeOfSpecimen>& envelopes) {
  EnvelopeLines lines;
  for (const EnvelopeOfSpecimen& envelope : envelopes) {
    if (!envelope.line) continue;
    lines.angles.push_back(envelope.line->friction_angle / kDegreeOfEnvelope);
    lines.cohesions.push_back(envelope.line->cohesion);
  }
  return lines;
}

/// Half of the circle, in kPa.
ChartSeries half_circle(const std::string& name, const StressCircle& circle) {
  constexpr int kSides = 48;
  ChartSeries series;
  series.name = name;
  series.line = true;
  for (int k = 0; k <= kSides; ++k) {
    const auto [sine, cosine] = sine_and_cosine(std::numbers::pi * k / kSides);
    series.points.emplace_back(1e-3 * (circle.centre() + circle.radius() * cosine),
                               1e-3 * circle.radius() * sine);
  }
  return series;
}

ChartSeries line_until(const std::string& name, const FailureLine& line, double sigma) {
  ChartSeries series;
  series.name = name;
  series.line = true;
  series.dashed = true;
  series.colour = "text";
  const auto [sine, cosine] = sine_and_cosine(line.friction_angle);
  const double slope = sine / cosine;
  for (const double at : {0.0, sigma})
    series.points.emplace_back(1e-3 * at, 1e-3 * (line.cohesion + at * slope));
  return series;
}

/// Rounding puts the cohesion of dry sand on either side of zero, and "-0.000" reads as if it were less.
std::string rounded(double value, int decimals) {
  const double nought = 0.5 * power(10.0, -decimals);
  return fmt::format("{:.{}f}", std::abs(value) < nought ? 0.0 : value, decimals);
}

}  // namespace

std::optional<FailureLine> failure_line(std::span<const StressCircle> circles) {
  const auto count = static_cast<double>(circles.size());
  double centre = 0.0;
  double radius = 0.0;
  for (const StressCircle& circle : circles) {
    centre += circle.centre() / count;
    radius += circle.radius() / count;
  }
  double square = 0.0;
  double product = 0.0;
  for (const StressCircle& circle : circles) {
    square += (circle.centre() - centre) * (circle.centre() - centre);
    product += (circle.centre() - centre) * (circle.radius() - radius);
  }
  if (circles.size() < 2 || !are_apart(circles)) return {};
  const double sine = product / square;
  if (!(std::abs(sine) < 1.0)) return {};
  FailureLine line;
  line.friction_angle = arc_sine(sine);
  line.cohesion = (radius - sine * centre) / std::sqrt(1.0 - sine * sine);
  double sum = 0.0;
  for (const StressCircle& circle : circles) {
    const double off = circle.radius() - radius - sine * (circle.centre() - centre);
    sum += off * off;
  }
  line.off = std::sqrt(sum / count);
  return line;
}

namespace {

std::vector<EnvelopeOfSpecimen> envelopes_at(std::span<const ElementResult> results,
                                             std::span<const double> pressures, FailureState state) {
  std::vector<EnvelopeOfSpecimen> envelopes;
  for (std::size_t specimen = 0; specimen < results.front().curves.size(); ++specimen) {
    EnvelopeOfSpecimen& envelope = envelopes.emplace_back();
    envelope.name = results.front().curves[specimen].name;
    for (std::size_t k = 0; k < results.size(); ++k) {
      const ElementCurve& curve = results[k].curves[specimen];
      if (!curve.failure.empty() || curve.rows.empty()) continue;
      envelope.pressures.push_back(pressures[k]);
      envelope.circles.push_back(circle_of(results[k].columns, row_at(results[k], curve, state)));
      envelope.without_peak.push_back(state == FailureState::peak && rises_to_end(results[k], curve));
    }
    envelope.line = failure_line(envelope.circles);
  }
  return envelopes;
}

}  // namespace

bool can_fail(const ElementSpecification& specification) {
  static const std::set<std::string> kNoFailure{"consolidation", "isotropic", "oedometer",
                                                "radial_unloading"};
  return std::ranges::any_of(specification.stages,
                             [](const element::Stage& stage) { return !kNoFailure.contains(stage.name); });
}

std::string why_no_envelope() {
  return "no envelope: isotropic and oedometer tests and radial unloading do not bring a material to failure; a line along "
         "their circles would be no strength\n";
}

Envelopes envelopes_of(std::span<const ElementResult> results, std::span<const double> pressures) {
  Envelopes envelopes;
  envelopes.pressures = pressures.size();
  for (const FailureState state : {FailureState::peak, FailureState::end})
    envelopes.at_states.emplace_back(state, envelopes_at(results, pressures, state));
  return envelopes;
}

std::string envelope_summary(const Envelopes& all) {
  std::string text = fmt::format("envelope over {} pressures\n{:<32} {:>16} {:>18} {:>14}\n", all.pressures,
                                 "", "angle, deg", "cohesion, kPa", "off, kPa");
  for (const auto& [state, envelopes] : all.at_states) {
    for (const EnvelopeOfSpecimen& envelope : envelopes) {
      const std::string name = fmt::format("{}, {} of {}", state_name(state, has_peaks(envelope)),
                                           envelope.circles.size(), envelope.name);
      if (envelope.line)
        text +=
            fmt::format("{:<32} {:>16} {:>18} {:>14}\n", name,
                        rounded(envelope.line->friction_angle / kDegreeOfEnvelope, 2),
                        rounded(1e-3 * envelope.line->cohesion, 3), rounded(1e-3 * envelope.line->off, 3));
      else
        text += fmt::format("{:<32} {:>16}\n", name, "no line");
    }
    const auto [angles, cohesions] = lines_of(envelopes);
    if (angles.size() < 2) continue;
    const bool has_peak = std::ranges::all_of(envelopes, has_peaks);
    const auto [angle, half_angle] = mean_and_interval(angles);
    const auto [cohesion, half_cohesion] = mean_and_interval(cohesions);
    text += fmt::format("{:<32} {:>16} {:>18}\n",
                        fmt::format("{}, mean of {}, 95 %", state_name(state, has_peak), angles.size()),
                        fmt::format("{} +- {:.2f}", rounded(angle, 2), half_angle),
                        fmt::format("{} +- {:.3f}", rounded(1e-3 * cohesion, 3), 1e-3 * half_cohesion));
  }
  for (const std::string& line : lines_on_missing(all)) text += line + '\n';
  return text;
}

std::string envelope_table(const Envelopes& all) {
  std::string text = csv_row({"packing", "state", "pressure_Pa", "largest_Pa", "least_Pa",
                              "friction_angle_deg", "cohesion_Pa", "off_Pa"});
  for (const auto& [state, envelopes] : all.at_states)
    for (const EnvelopeOfSpecimen& envelope : envelopes)
      for (std::size_t k = 0; k < envelope.circles.size(); ++k) {
        const FailureLine line = envelope.line.value_or(FailureLine{NAN, NAN, NAN});
        text += csv_row({envelope.name, state_name(state, !envelope.without_peak[k]),
                         exact(envelope.pressures[k]), exact(envelope.circles[k].largest),
                         exact(envelope.circles[k].least), exact(line.friction_angle / kDegreeOfEnvelope),
                         exact(line.cohesion), exact(line.off)});
      }
  return text;
}

std::string envelope_charts(const Envelopes& all) {
  std::string html;
  for (const auto& [state, envelopes] : all.at_states) {
    std::vector<ChartSeries> series;
    for (const EnvelopeOfSpecimen& envelope : envelopes) {
      double largest = 0.0;
      for (std::size_t k = 0; k < envelope.circles.size(); ++k) {
        series.push_back(
            half_circle(fmt::format("{} at {:.4g} kPa", envelope.name, 1e-3 * envelope.pressures[k]),
                        envelope.circles[k]));
        largest = std::max(largest, envelope.circles[k].largest);
      }
      if (envelope.line)
        series.push_back(line_until(fmt::format("{}: {} deg, {} kPa", envelope.name,
                                                rounded(envelope.line->friction_angle / kDegreeOfEnvelope, 2),
                                                rounded(1e-3 * envelope.line->cohesion, 2)),
                                    *envelope.line, largest));
    }
    const bool has_peak = std::ranges::all_of(envelopes, has_peaks);
    html += fmt::format("<h2>Mohr's circles at the {}{}</h2>\n", state_name(state, has_peak),
                        state == FailureState::peak && !has_peak ? " angle" : "") +
            chart({.title = "effective normal stress, kPa"}, {.title = "shear stress, kPa"}, series, true);
  }
  for (const std::string& line : lines_on_missing(all)) html += fmt::format("<p>{}</p>\n", escaped(line));
  return html;
}

}  // namespace polargrain::app
