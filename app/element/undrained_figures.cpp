// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/element/undrained_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "common/mean_and_interval.hpp"

namespace polargrain::app {
namespace {

/// Of the mean stress at the start of the stage.
constexpr double kShare = 0.01;

/// Lines on extremes that the rows are too few to see; empty without one.
std::string lines_on_rows(const std::string& name, const UndrainedFigures& figures) {
  std::string text;
  for (const auto& [falls, what] : {std::pair{figures.largest_in_first_row, "largest u"},
                                    std::pair{figures.least_in_first_row, "least p'"}})
    if (falls)
      text += fmt::format(
          "{}: the {} falls into the first row; the rows are too few to see it: raise 'rows'\n", name, what);
  return text;
}

}  // namespace

UndrainedFigures undrained_figures(const ElementResult& result, const ElementCurve& curve) {
  const auto value = [&](const std::vector<double>& row, const char* name) {
    return row[static_cast<std::size_t>(std::ranges::find(result.columns, name) - result.columns.begin())];
  };
  UndrainedFigures figures;
  figures.transformation_angle = std::numeric_limits<double>::quiet_NaN();
  const auto has_pore_pressure = [&](const std::vector<double>& row) {
    return value(row, "pore_pressure_Pa") != 0.0;
  };
  const auto last = std::ranges::find_if(curve.rows.rbegin(), curve.rows.rend(), has_pore_pressure);
  if (last == curve.rows.rend()) return figures;
  figures.is_undrained = true;
  const double stage = value(*last, "stage");
  double start = 0.0;  // mean stress before the stage
  double least = HUGE_VAL;
  double risen = 0.0;  // above the least, behind it
  for (const std::vector<double>& row : curve.rows) {
    if (value(row, "stage") > stage) break;
    const double p = value(row, "p_Pa");
    const double pore_pressure = value(row, "pore_pressure_Pa");
    // All that comes before the stage ends in its start.
    const bool is_before = value(row, "stage") < stage || value(row, "row") == 0.0;
    const bool is_first = value(row, "row") == 1.0;
    if (is_before) start = p;
    if (is_before || pore_pressure > figures.largest_pore_pressure) {
      figures.largest_pore_pressure = pore_pressure;
      figures.largest_in_first_row = !is_before && is_first;
    }
    if (is_before || p < least) {
      least = p;
      risen = 0.0;
      const double shear = value(row, "e12");
      const double axial = value(row, "axial_strain");
      figures.strain_at_least = std::abs(shear) > std::abs(axial) ? shear : axial;
      figures.transformation_angle = value(row, "friction_angle_deg");
      figures.least_in_first_row = !is_before && is_first;
    }
    risen = std::max(risen, p - least);
  }
  figures.least_mean_stress = least;
  figures.flows = least < kShare * start;
  if (risen <= kShare * start || least >= start)
    figures.transformation_angle = std::numeric_limits<double>::quiet_NaN();
  return figures;
}

std::string undrained_summary(const ElementResult& result) {
  std::string text;
  std::array<std::vector<double>, 4> values;
  std::string on_rows;
  int flows = 0;
  int turns = 0;
  for (const ElementCurve& curve : result.curves) {
    const UndrainedFigures f = undrained_figures(result, curve);
    if (!f.is_undrained) continue;
    const bool turned = !std::isnan(f.transformation_angle);
    text +=
        fmt::format("{:<24} {:>16.3f} {:>16.3f} {:>16.3f} {:>16} {:>6}\n", curve.name,
                    1e-3 * f.largest_pore_pressure, 1e-3 * f.least_mean_stress, 100.0 * f.strain_at_least,
                    turned ? fmt::format("{:.2f}", f.transformation_angle) : "none", f.flows ? "yes" : "no");
    on_rows += lines_on_rows(curve.name, f);
    flows += f.flows ? 1 : 0;
    turns += turned ? 1 : 0;
    values[0].push_back(1e-3 * f.largest_pore_pressure);
    values[1].push_back(1e-3 * f.least_mean_stress);
    values[2].push_back(100.0 * f.strain_at_least);
    if (turned) values[3].push_back(f.transformation_angle);
  }
  if (text.empty()) return text;
  text = fmt::format("{:<24} {:>16} {:>16} {:>16} {:>16} {:>6}\n", "undrained", "largest u, kPa",
                     "least p', kPa", "at strain, %", "PT angle, deg", "flows") +
         text;
  if (values[0].size() < 2) return text + on_rows;
  text += fmt::format("{:<24}", fmt::format("mean of {}, 95 %", values[0].size()));
  for (const std::vector<double>& of : values) {
    if (of.size() < 2) {
      text += fmt::format(" {:>16}", "");
      continue;
    }
    const auto [mean, half] = mean_and_interval(of);
    text += fmt::format(" {:>16}", fmt::format("{:.2f} +- {:.2f}", mean, half));
  }
  return text +
         fmt::format("\n{} of {} turn from contraction to dilation (PT: phase transformation), {} flow\n",
                     turns, values[0].size(), flows) +
         on_rows;
}

}  // namespace polargrain::app
