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

/// Of the mean stress at the start of a stage.
constexpr double kShare = 0.01;
/// Of the same: a value closer to the start is no extreme. A law that keeps its volume keeps p' but for rounding.
constexpr double kRounding = 1e-4;

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

using TableRow = std::vector<double>;

double value_in(const ElementResult& result, const TableRow& row, const char* name) {
  return row[static_cast<std::size_t>(std::ranges::find(result.columns, name) - result.columns.begin())];
}

/// The rows of a stage, behind its start.
struct StageRows {
  const TableRow* start = nullptr;
  std::vector<const TableRow*> rows;
};

StageRows rows_of_stage(const ElementResult& result, const ElementCurve& curve, std::size_t stage) {
  StageRows found;
  for (const TableRow& row : curve.rows) {
    const double of_row = value_in(result, row, "stage");
    if (of_row > static_cast<double>(stage)) break;
    // All that comes before the stage ends in its start.
    if (of_row < static_cast<double>(stage) || value_in(result, row, "row") == 0.0)
      found.start = &row;
    else
      found.rows.push_back(&row);
  }
  return found;
}

UndrainedFigures figures_of_stage(const ElementResult& result, const StageRows& stage) {
  const double start = value_in(result, *stage.start, "p_Pa");
  UndrainedFigures figures;
  figures.is_undrained = true;
  double risen = 0.0;  // above the least, behind it
  const auto look_at = [&](const TableRow& row, bool is_start, bool is_first) {
    const double p = value_in(result, row, "p_Pa");
    const double pore_pressure = value_in(result, row, "pore_pressure_Pa");
    if (is_start || pore_pressure > figures.largest_pore_pressure) {
      figures.largest_pore_pressure = pore_pressure;
      figures.largest_in_first_row = is_first;
    }
    if (is_start || p < figures.least_mean_stress) {
      figures.least_mean_stress = p;
      risen = 0.0;
      const double shear = value_in(result, row, "e12");
      const double axial = value_in(result, row, "axial_strain");
      figures.strain_at_least = std::abs(shear) > std::abs(axial) ? shear : axial;
      figures.transformation_angle = value_in(result, row, "friction_angle_deg");
      figures.least_in_first_row = is_first;
    }
    risen = std::max(risen, p - figures.least_mean_stress);
  };
  look_at(*stage.start, true, false);
  for (const TableRow* row : stage.rows) look_at(*row, false, row == stage.rows.front());
  figures.flows = figures.least_mean_stress < kShare * start;
  const bool falls = start - figures.least_mean_stress > kRounding * start;
  const double at_start = value_in(result, *stage.start, "pore_pressure_Pa");
  if (!falls) figures.least_in_first_row = false;
  if (figures.largest_pore_pressure - at_start <= kRounding * start) figures.largest_in_first_row = false;
  if (risen <= kShare * start || !falls)
    figures.transformation_angle = std::numeric_limits<double>::quiet_NaN();
  return figures;
}

bool holds_a_stress(const element::Stage& stage) {
  return std::ranges::any_of(stage.constraints, [](const element::Constraint& constraint) {
    return constraint.kind == element::Constraint::Kind::stress &&
           constraint.way == element::Constraint::Way::hold;
  });
}

/// A line for each drained stage that goes on from the effective stress that an undrained one left.
std::string lines_on_drainage(const ElementResult& result, const ElementCurve& curve) {
  constexpr double kChanged = 0.05;  // of the mean stress
  std::string text;
  double before = 0.0;  // p at the start of the undrained stages
  for (std::size_t k = 1; k < result.stages.size(); ++k) {
    const bool follows = result.stages[k - 1].pore >= 0;
    const StageRows stage = rows_of_stage(result, curve, k);
    if (stage.start == nullptr || stage.rows.empty()) break;
    const double p = value_in(result, *stage.start, "p_Pa");
    if (!follows) before = p;
    if (!follows || result.stages[k].pore >= 0 || !holds_a_stress(result.stages[k])) continue;
    if (std::abs(p - before) <= kChanged * before) continue;
    text += fmt::format(
        "{}: drained stage {} keeps the p' of {:.4g} kPa that the undrained one left of {:.4g} kPa. If the sample "
        "consolidates again, put {{test: isotropic, to: {:.4g} kPa}} before it\n",
        curve.name, k, 1e-3 * p, 1e-3 * before, 1e-3 * before);
  }
  return text;
}

}  // namespace

UndrainedFigures undrained_figures(const ElementResult& result, const ElementCurve& curve) {
  UndrainedFigures all;
  all.transformation_angle = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t k = 0; k < result.stages.size(); ++k) {
    if (result.stages[k].pore < 0) continue;
    const StageRows stage = rows_of_stage(result, curve, k);
    if (stage.start == nullptr || stage.rows.empty()) continue;
    const UndrainedFigures one = figures_of_stage(result, stage);
    if (!all.is_undrained || one.largest_pore_pressure > all.largest_pore_pressure) {
      all.largest_pore_pressure = one.largest_pore_pressure;
      all.largest_in_first_row = one.largest_in_first_row;
    }
    if (!all.is_undrained || one.least_mean_stress < all.least_mean_stress) {
      all.least_mean_stress = one.least_mean_stress;
      all.strain_at_least = one.strain_at_least;
      all.least_in_first_row = one.least_in_first_row;
    }
    if (std::isnan(all.transformation_angle)) all.transformation_angle = one.transformation_angle;
    all.flows = all.flows || one.flows;
    all.is_undrained = true;
  }
  return all;
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
    on_rows += lines_on_rows(curve.name, f) + lines_on_drainage(result, curve);
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
