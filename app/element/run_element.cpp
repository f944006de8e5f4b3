// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/element/run_element.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "common/error.hpp"
#include "common/mean_and_interval.hpp"
#include "common/record_table.hpp"
#include "coupler/points/cell_point.hpp"
#include "coupler/points/law_point.hpp"
#include "coupler/pool/private_directory.hpp"
#include "element/measures.hpp"

namespace polargrain::app {
namespace {

using coupler::Pool;

/// A pool whose logs stay when it ends by an exception.
class WorkingPool {
 public:
  WorkingPool(int workers, bool trust_scripts) {
    logs_.keep();
    coupler::PoolOptions options;
    options.directory = logs_.path();
    options.workers = workers;
    options.trust_scripts = trust_scripts;
    pool_.emplace(options);
  }
  Pool& pool() { return *pool_; }
  void done() {
    pool_.reset();
    logs_.keep(false);
  }

 private:
  coupler::PrivateDirectory logs_;
  std::optional<Pool> pool_;
};

/// The advice where grains did not come from the pressure they were made under to that of the test; empty: that is not why the test
/// ended.
std::string advice_on_pressure(const element::Outcome& outcome, const ElementSpecification& specification) {
  constexpr double kFar = 2.0;
  if (outcome.failure.empty() || specification.cells.empty()) return {};
  if (outcome.rows.empty() || outcome.rows.back().stage > 0) return {};
  const double made = element::measures_of(outcome.rows.front().stress, specification.room).p;
  const double asked = specification.pressure;
  if (made < kFar * asked && asked < kFar * made) return {};
  return fmt::format(
      "; the packing was made under {:.4g} kPa: settle it under the pressure of the test, polargrain pack --settle PACKING "
      "SCRIPT -o NEW.h5 --set pressure='{:.4g} kPa'",
      1e-3 * made, 1e-3 * asked);
}

ElementCurve curve_of(const std::string& name, element::MaterialPoint& point,
                      const ElementSpecification& specification) {
  const element::Outcome outcome = follow(point, specification.stages, specification.accuracy);
  ElementCurve curve;
  curve.name = name;
  curve.failure = outcome.failure + advice_on_pressure(outcome, specification);
  const TableForm form = form_of(specification);
  for (const element::Row& row : outcome.rows) curve.rows.push_back(element_values(form, row));
  return curve;
}

/// One test on one packing.
struct CellTest {
  const ElementSpecification* specification;
  std::size_t packing;
  ElementCurve* curve;
};

void run_cells(const std::vector<CellTest>& tests, int workers, bool trust_scripts) {
  WorkingPool working(std::min<int>(workers, static_cast<int>(tests.size())), trust_scripts);
  std::vector<std::uint32_t> definitions;
  std::vector<CellReply> at_rest;
  for (const CellTest& test : tests) {
    const CellDefinition& cell = test.specification->cells[test.packing];
    try {
      definitions.push_back(working.pool().define(cell));
      at_rest.push_back(working.pool().initial(definitions.back()));
    } catch (const RunError& error) {
      throw NotAtRest(error.what());
    }
    if (at_rest.back().response.quality == Quality::failed)
      throw NotAtRest(fmt::format("the packing {} cannot be brought to rest: {}", cell.name,
                                  at_rest.back().response.message));
  }
  coupler::ask_together(working.pool(), definitions, [&](std::size_t k, const coupler::AskCell& ask) {
    const CellTest& test = tests[k];
    coupler::CellPoint point(ask, at_rest[k], test.specification->cells[test.packing].packing.dimension);
    *test.curve = curve_of(test.specification->names[test.packing], point, *test.specification);
  });
  working.done();
}

ElementResult run_material(const ElementSpecification& specification, int workers, bool trust_scripts) {
  std::optional<WorkingPool> working;
  const bool asks_cells = specification.material->needs_workers();
  if (asks_cells) working.emplace(workers, trust_scripts);
  ElementResult result;
  {
    coupler::LawPoint point(specification.material->make(asks_cells ? &working->pool() : nullptr),
                            asks_cells ? std::nullopt : std::optional(specification.pressure));
    result.columns = element_columns(form_of(specification), point.field_names());
    result.curves.push_back(curve_of(specification.names.front(), point, specification));
  }
  if (working) working->done();
  return result;
}

/// The figures of a curve.
struct CurveFigures {
  double friction_angle = 0.0;  ///< the largest, degrees
  double strain_at_peak = 0.0;  ///< the axial one (the shear strain where that is larger)
  double last_angle = 0.0;
  double last_volume_strain = 0.0;
};

std::size_t column_named(const ElementResult& result, const std::string& name) {
  return static_cast<std::size_t>(std::ranges::find(result.columns, name) - result.columns.begin());
}

CurveFigures figures_of(const ElementResult& result, const ElementCurve& curve) {
  CurveFigures figures;
  const std::size_t angle = column_named(result, "friction_angle_deg");
  const auto strain_of = [&](const std::vector<double>& row) {
    const double axial = row[column_named(result, "axial_strain")];
    const double shear = row[column_named(result, "e12")];
    return std::abs(shear) > std::abs(axial) ? shear : axial;
  };
  for (const auto& row : rows_of_test(result, curve)) {
    if (!(row[angle] > figures.friction_angle)) continue;
    figures.friction_angle = row[angle];
    figures.strain_at_peak = strain_of(row);
  }
  figures.last_angle = curve.rows.back()[angle];
  figures.last_volume_strain = curve.rows.back()[column_named(result, "volume_strain")];
  return figures;
}

/// A line where a sample that began under pressure comes to a mean stress in tension, which may be a wrong sign; else empty.
std::string line_on_tension(const ElementResult& result, const ElementCurve& curve) {
  constexpr double kPulled = 0.01;  // of the pressure at the start: closer to zero it counts as zero
  if (std::ranges::find(result.columns, "p_Pa") == result.columns.end()) return {};
  const std::size_t p = column_named(result, "p_Pa");
  const double start = curve.rows.front()[p];
  const auto row = std::ranges::find_if(
      curve.rows, [&](const auto& values) { return start > 0.0 && values[p] < -kPulled * start; });
  if (row == curve.rows.end()) return {};
  return fmt::format(
      "{}: p is {:.4g} kPa in row {:.0f} of stage {:.0f}: tension. 'axial_strain', 'axial_stress' and 'p' count compression "
      "positive, components tension: check the signs\n",
      curve.name, 1e-3 * (*row)[p], (*row)[column_named(result, "row")],
      (*row)[column_named(result, "stage")]);
}

}  // namespace

std::span<const std::vector<double>> rows_of_test(const ElementResult& result, const ElementCurve& curve) {
  const std::span all(curve.rows);
  const std::size_t stage = column_named(result, "stage");
  if (stage == result.columns.size()) return all;
  const auto first = std::ranges::find_if(all, [stage](const auto& row) { return row[stage] > 0.0; });
  return first == all.end() ? all : all.subspan(static_cast<std::size_t>(first - all.begin()));
}

std::vector<ElementResult> run_elements(std::span<const ElementSpecification> specifications, int workers,
                                        bool trust_scripts) {
  std::vector<ElementResult> results(specifications.size());
  std::vector<CellTest> of_cells;
  for (std::size_t k = 0; k < specifications.size(); ++k) {
    const ElementSpecification& specification = specifications[k];
    if (specification.material != nullptr) {
      results[k] = run_material(specification, workers, trust_scripts);
      results[k].stages = specification.stages;
      continue;
    }
    results[k].stages = specification.stages;
    results[k].columns = element_columns(form_of(specification), names_of_columns<CellDiagnostics>());
    results[k].curves.resize(specification.cells.size());
    for (std::size_t packing = 0; packing < specification.cells.size(); ++packing)
      of_cells.push_back({&specification, packing, &results[k].curves[packing]});
  }
  if (!of_cells.empty()) run_cells(of_cells, workers, trust_scripts);
  return results;
}

std::string summary_of(const ElementResult& result) {
  std::string text = fmt::format("{:<24} {:>16} {:>16} {:>16} {:>16} {:>6}\n", "", "peak angle, deg",
                                 "at strain, %", "last angle, deg", "last volume, %", "jumps");
  std::array<std::vector<double>, 4> values;
  std::string on_tension;
  for (const ElementCurve& curve : result.curves) {
    if (curve.rows.empty()) continue;
    on_tension += line_on_tension(result, curve);
    const CurveFigures f = figures_of(result, curve);
    const std::array<double, 4> numbers{f.friction_angle, 100.0 * f.strain_at_peak, f.last_angle,
                                        100.0 * f.last_volume_strain};
    text += fmt::format("{:<24} {:>16.2f} {:>16.3f} {:>16.2f} {:>16.3f} {:>6.0f}\n", curve.name, numbers[0],
                        numbers[1], numbers[2], numbers[3], curve.rows.back()[column_named(result, "jumps")]);
    for (std::size_t k = 0; k < 4 && curve.failure.empty(); ++k) values[k].push_back(numbers[k]);
  }
  const std::size_t count = values[0].size();
  if (count < 2) return text + on_tension;
  text += fmt::format("{:<24}", fmt::format("mean of {}, 95 %", count));
  for (const std::vector<double>& of : values) {
    const auto [mean, half] = mean_and_interval(of);
    text += fmt::format(" {:>16}", fmt::format("{:.2f} +- {:.2f}", mean, half));
  }
  return text + '\n' + on_tension;
}

}  // namespace polargrain::app
