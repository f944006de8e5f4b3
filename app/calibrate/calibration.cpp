// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/calibrate/calibration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <span>
#include <tuple>

#include "app/calibrate/script_parameters.hpp"
#include "app/element/element_table.hpp"
#include "common/csv_table.hpp"
#include "common/elementary_functions.hpp"
#include "common/record_table.hpp"
#include "common/state.hpp"
#include "coupler/case/data_files.hpp"
#include "coupler/case/document_kind.hpp"
#include "coupler/case/section.hpp"
#include "element/stage.hpp"

namespace polargrain::app {
namespace {

using coupler::Dimension;
using coupler::Entry;
using coupler::Faults;
using coupler::Limit;
using coupler::Section;

/// The keys that a specification gives once for all tests.
constexpr const char* kShared[] = {"packing",
                                   "script",
                                   "contact_library",
                                   "inertial_number",
                                   "unbalanced_force_ratio",
                                   "unbalanced_moment_ratio",
                                   "damping",
                                   "least_steps",
                                   "most_relaxation_steps",
                                   "tangent",
                                   "loop",
                                   "tolerance",
                                   "largest_increment",
                                   "iterations",
                                   "cuts",
                                   "jumps"};

constexpr double kNoise = 1e-3;  // of the range of a column: less is no way back

Parameter read_parameter(const Entry::Member& member, Faults& faults) {
  Section section(member.value, fmt::format("parameter '{}'", member.key), faults);
  Parameter parameter;
  parameter.name = member.key;
  parameter.linear = section.choice_or("scale", {"logarithmic", "linear"}, "logarithmic") == "linear";
  const Limit limit = parameter.linear ? Limit::any : Limit::positive;
  const std::size_t before = faults.size();
  const std::vector<double> bounds = section.quantities("bounds", 2, Dimension::number, limit);
  const bool has_bounds = section.find("bounds") != nullptr && faults.size() == before;
  parameter.low = bounds[0];
  parameter.high = bounds[1];
  parameter.start = section.quantity("start", Dimension::number, limit);
  if (has_bounds && !(parameter.low < parameter.high))
    section.fault("bounds", "bounds: the first must be the smaller one");
  else if (has_bounds && !(parameter.start >= parameter.low && parameter.start <= parameter.high))
    section.fault("start", fmt::format("start: {:.6g} is outside of the bounds {:.6g} to {:.6g}",
                                       parameter.start, parameter.low, parameter.high));
  section.finish();
  return parameter;
}

/// A test with what the specification says for all.
ElementSpecification read_test(const Entry& document, const Entry::Member& member,
                               const std::filesystem::path& directory, const ScriptRules& scripts,
                               const PackingsOf& packings_of, Faults& faults) {
  Entry whole = member.value;
  if (whole.kind == Entry::Kind::map)
    for (const char* const key : kShared)
      if (const Entry* const shared = document.find(key); shared != nullptr && whole.find(key) == nullptr)
        whole.members.push_back({key, shared->line, *shared});
  try {
    ElementSpecification test = read_element_specification(
        with_made_packings(std::move(whole), directory, scripts, packings_of), directory, scripts);
    // Contacts of another stiffness carry another pressure in the same place; the test itself brings it to its own.
    for (CellDefinition& cell : test.cells) cell.packing.pressure = 0.0;
    if (test.cells.empty())
      faults.push_back(member.value.fault(fmt::format(
          "test '{}': the parameters are variables of a script of cells; give 'packing' and 'script'",
          member.key)));
    return test;
  } catch (const InputError& error) {
    for (const Fault& fault : error.faults())
      if (std::ranges::none_of(faults, [&](const Fault& f) { return f.text() == fault.text(); }))
        faults.push_back(fault);
  }
  return {};
}

std::vector<std::string> columns_of_test(const ElementSpecification& test) {
  return element_columns(form_of(test), names_of_columns<CellDiagnostics>());
}

/// Where a curve comes to a value of x, each time that it has been away from it in between.
/// @param x of its rows @returns places: the row before, or the row itself
std::vector<std::size_t> passages(const std::vector<double>& x, double at) {
  if (x.empty()) return {};
  const auto [least, most] = std::ranges::minmax(x);
  const double noise = kNoise * (most - least);
  std::vector<std::size_t> found;
  bool is_away = true;
  for (std::size_t k = 0; k < x.size(); ++k) {
    const bool is_between = k > 0 && x[k - 1] != at && (x[k - 1] < at) == (at < x[k]);
    if (is_away && (x[k] == at || is_between)) {
      found.push_back(x[k] == at ? k : k - 1);
      is_away = false;
    }
    if (std::abs(x[k] - at) > noise) is_away = true;
  }
  return found;
}

/// The course of a strain over the stages that count, as far as they prescribe it; empty where it is not known before the test.
std::vector<double> prescribed_course(const ElementSpecification& test, const TargetPoint& point) {
  int place = -1;
  for (int k = 0; k < 6; ++k)
    if (point.along == std::string("e") + element::kPlaceNames[static_cast<std::size_t>(k)]) place = k;
  const double sign = point.along == "axial_strain" ? -1.0 : 1.0;
  if (sign < 0.0) place = element::k22;
  if (place < 0) return {};
  std::vector<double> course;
  std::optional<double> at = 0.0;  // strains count from the end of the consolidation
  for (std::size_t k = 1; k < test.stages.size(); ++k) {
    const element::Stage& stage = test.stages[k];
    const bool counts = point.stage == 0 || point.stage == static_cast<int>(k);
    if (stage.zero) at = 0.0;
    const auto given = std::ranges::find_if(stage.constraints, [place](const element::Constraint& c) {
      return c.place == place && c.kind == element::Constraint::Kind::strain;
    });
    if (given == stage.constraints.end()) at.reset();
    if (!at && counts) return {};
    if (!at) continue;
    const double start = *at;
    for (int row = 0; row <= stage.rows; ++row) {
      at = element::target(*given, stage.cycles, start, static_cast<double>(row) / stage.rows);
      if (counts) course.push_back(sign * *at);
    }
  }
  return course;
}

/// The target that took a row of the laboratory's table: its number, test and stage.
struct Taker {
  std::size_t target;
  std::size_t test;
  int stage;
};
/// By the two columns and the row.
using Takers = std::map<std::tuple<std::string, std::string, std::size_t>, Taker>;

/// Reads one target: points of the laboratory's table, or one number.
void read_target(const Entry& entry, std::size_t number, const CsvTable& table, Calibration& calibration,
                 Takers& takers, Faults& faults) {
  Section section(entry, fmt::format("target {}", number), faults);
  TargetPoint point;
  const std::string test =
      calibration.test_names.size() == 1
          ? section.choice_or("test", calibration.test_names, calibration.test_names.front())
          : section.choice("test", calibration.test_names);
  const auto found = std::ranges::find(calibration.test_names, test);
  if (found == calibration.test_names.end()) return;
  point.test = static_cast<std::size_t>(found - calibration.test_names.begin());
  const std::vector<std::string> columns = columns_of_test(calibration.tests[point.test]);
  point.column = section.choice("column", columns);
  point.error = section.quantity("error", Dimension::number, Limit::positive);
  const std::vector<element::Stage>& stages = calibration.tests[point.test].stages;
  const int last_stage = static_cast<int>(stages.size()) - 1;
  point.stage = section.whole_or("stage", 1, 0);
  if (point.stage > last_stage) {
    section.fault("stage", fmt::format("stage: test '{}' has stages 1 to {}", test, last_stage));
    return;
  }
  point.end_stage = point.stage > 0 ? point.stage : last_stage;
  point.end_row = stages[static_cast<std::size_t>(point.end_stage)].rows;
  for (const auto& [key, where] :
       {std::pair{"largest", TargetPoint::Where::largest}, {"last", TargetPoint::Where::last}}) {
    if (section.find(key) == nullptr) continue;
    point.where = where;
    point.value = section.quantity(key, Dimension::number, Limit::any);
    calibration.points.push_back(point);
    section.finish();
    return;
  }
  point.along = section.choice_or("along", columns, "axial_strain");
  const std::string lab = section.text_or("lab", point.column);
  const std::string lab_along = section.text_or("lab_along", point.along);
  const double factor = section.quantity_or("factor", Dimension::number, Limit::any, 1.0);
  const double factor_along = section.quantity_or("factor_along", Dimension::number, Limit::any, 1.0);
  constexpr double kFar = std::numeric_limits<double>::max();
  const double from = section.quantity_or("from", Dimension::number, Limit::any, -kFar);
  const double to = section.quantity_or("to", Dimension::number, Limit::any, kFar);
  const std::string lab_test = section.text_or("lab_test", test);
  const std::string test_column = section.text_or("test_column", "test");
  section.finish();
  if (point.column.empty() || point.along.empty()) return;
  for (const std::string& name : {lab, lab_along})
    if (std::ranges::find(table.names(), name) == table.names().end()) {
      section.fault(name == lab ? "lab" : "lab_along",
                    fmt::format("the laboratory's table has no column '{}'; it has {}", name,
                                coupler::listed(table.names())));
      return;
    }
  const bool names_tests = std::ranges::find(table.names(), test_column) != table.names().end();
  // Rows of all tests would be taken for those of one.
  if (!names_tests && (section.find("test_column") != nullptr || section.find("lab_test") != nullptr)) {
    section.fault(
        "test_column",
        fmt::format(
            "the laboratory's table has no column '{}' that says which test a row belongs to; it has {}",
            test_column, coupler::listed(table.names())));
    return;
  }
  const std::vector<double> course = prescribed_course(calibration.tests[point.test], point);
  std::size_t count = 0;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (names_tests && table.cell(row, test_column) != lab_test) continue;
    if (table.cell(row, lab).empty() || table.cell(row, lab_along).empty()) continue;
    point.at = factor_along * table.number(row, table.column(lab_along));
    if (point.at < from || point.at > to) continue;
    point.value = factor * table.number(row, table.column(lab));
    if (passages(course, point.at).size() > 1) {
      section.fault("along", told_as_passed_again(calibration, point));
      return;
    }
    const Taker& taker =
        takers.try_emplace({lab, lab_along, row}, Taker{number, point.test, point.stage}).first->second;
    if (taker.test == point.test ? taker.stage != point.stage : !names_tests) {
      section.fault(
          "lab",
          fmt::format(
              "target {} has taken line {} of the laboratory's table for {} already: {}", taker.target,
              table.line_of(row),
              taker.test == point.test ? fmt::format("another stage of test '{}'", test)
                                       : fmt::format("test '{}'", calibration.test_names[taker.test]),
              names_tests
                  ? fmt::format("name the rows of each stage in the column '{}', and that name as "
                                "'lab_test' of each target",
                                test_column)
                  : "rename the column that names the samples (or parts of a test) to 'test', add one, or name "
                    "it with 'test_column'; 'lab_test' of a target names its rows"));
      return;
    }
    calibration.points.push_back(point);
    ++count;
  }
  if (count == 0)
    section.fault("lab",
                  fmt::format("the laboratory's table has no row of the test '{}' with both {} and {}, "
                              "between 'from' and 'to' where these are given",
                              lab_test, lab_along, lab));
}

using Rows = std::vector<std::vector<double>>;

std::size_t place_in(const std::vector<std::string>& columns, const std::string& name) {
  return static_cast<std::size_t>(std::ranges::find(columns, name) - columns.begin());
}

/// The consolidation is no part of the test; its rows are those of stage 0. A stage begins where the one before ended.
Rows rows_that_count(const TargetPoint& point, const std::vector<std::string>& columns,
                     const Rows& all_rows) {
  const std::size_t stage = place_in(columns, "stage");
  const std::size_t number = place_in(columns, "row");
  Rows rows;
  for (std::size_t k = 0; k < all_rows.size(); ++k) {
    const auto& row = all_rows[k];
    if (point.stage > 0 ? row[stage] != point.stage : row[stage] == 0.0) continue;
    if (rows.empty() && point.stage > 0 && row[number] > 0.0 && k > 0) rows.push_back(all_rows[k - 1]);
    rows.push_back(row);
  }
  return rows;
}

/// The values of a curve wherever it comes to a value of x.
std::vector<double> values_along(const Rows& rows, std::size_t x, std::size_t y, double at) {
  std::vector<double> of_x;
  for (const auto& row : rows) of_x.push_back(row[x]);
  std::vector<double> values;
  for (const std::size_t k : passages(of_x, at))
    values.push_back(of_x[k] == at ? rows[k][y]
                                   : rows[k][y] + (rows[k + 1][y] - rows[k][y]) * (at - of_x[k]) /
                                                      (of_x[k + 1] - of_x[k]));
  return values;
}

/// Each script has each parameter: a test without one would stay as it is through the whole search.
void check_scripts(const Entry& parameters, const std::vector<ElementSpecification>& tests, Faults& faults) {
  std::set<std::string> seen;
  for (const ElementSpecification& test : tests) {
    if (test.cells.empty() || !seen.insert(test.cells.front().script).second) continue;
    for (const Entry::Member& member : parameters.members)
      if (const std::string fault = parameter_fault(test.cells.front().script, member.key); !fault.empty())
        faults.push_back(
            {member.value.file, member.line,
             fmt::format("parameter '{}': {}: {}", member.key, test.cells.front().script_file, fault)});
  }
}

}  // namespace

std::optional<double> value_of(const TargetPoint& point, const std::vector<std::string>& columns,
                               const std::vector<std::vector<double>>& all_rows) {
  const Rows rows = rows_that_count(point, columns, all_rows);
  if (rows.empty()) return {};
  const std::size_t y = place_in(columns, point.column);
  if (point.where == TargetPoint::Where::along) {
    const std::vector<double> values = values_along(rows, place_in(columns, point.along), y, point.at);
    return values.empty() ? std::nullopt : std::optional(values.front());
  }
  const bool came_to_end = rows.back()[place_in(columns, "stage")] == point.end_stage &&
                           rows.back()[place_in(columns, "row")] == point.end_row;
  const auto row =
      point.where == TargetPoint::Where::last
          ? rows.end() - 1
          : std::ranges::max_element(
                rows, {}, [y, sign = point.sign_of_largest()](const auto& one) { return sign * one[y]; });
  if (!came_to_end && row == rows.end() - 1) return {};
  return (*row)[y];
}

std::optional<std::size_t> point_passed_again(const std::vector<TargetPoint>& points,
                                              const std::vector<std::vector<std::string>>& columns,
                                              const std::vector<std::vector<Rows>>& curves) {
  for (std::size_t k = 0; k < points.size(); ++k) {
    const TargetPoint& point = points[k];
    if (point.where != TargetPoint::Where::along) continue;
    const std::vector<std::string>& names = columns[point.test];
    for (const Rows& rows : curves[point.test])
      for (const std::vector<double> values =
               values_along(rows_that_count(point, names, rows), place_in(names, point.along),
                            place_in(names, point.column), point.at);
           const double value : values)
        if (std::abs(value - values.front()) > point.error) return k;
  }
  return {};
}

std::string told_as_passed_again(const Calibration& calibration, const TargetPoint& point) {
  const auto stages = calibration.tests[point.test].stages.size() - 1;
  return fmt::format(
      "along: {} of test '{}' comes to {:.4g} more than once: {}", point.along,
      calibration.test_names[point.test], point.at,
      point.stage == 0 && stages > 1
          ? fmt::format(
                "give a target for each stage, with 'stage' (1 to {}) and 'lab_test', the name of its rows of "
                "the laboratory's table",
                stages)
          : "write each way there and back as a stage of its own and give 'stage' of the target, or take another "
            "'along'");
}

double Parameter::place_of(double value) const {
  return linear ? (value - low) / (high - low) : logarithm(value / low) / logarithm(high / low);
}

double Parameter::value_at(double place) const {
  if (place <= 0.0) return low;
  if (place >= 1.0) return high;
  return linear ? low + place * (high - low) : low * exponential(place * logarithm(high / low));
}

Calibration read_calibration(const std::filesystem::path& laboratory, const std::filesystem::path& file,
                             const std::vector<std::string>& settings, const ScriptRules& scripts,
                             const PackingsOf& packings_of) {
  const Entry document = coupler::load_document_of(coupler::DocumentKind::calibration, file, settings);
  const CsvTable table(laboratory);
  Faults faults;
  Calibration calibration;
  Section top(document, "calibration", faults);
  calibration.title = top.text_or("title", "Calibration");
  for (const char* const key : kShared) top.find(key);
  calibration.evaluations = top.whole_or("evaluations", 1, calibration.evaluations);
  const auto share = [&top](const char* key, double otherwise) {
    const double value = top.quantity_or(key, Dimension::number, Limit::positive, otherwise);
    if (value > 0.5)
      top.fault(key, fmt::format("{}: is a share of the way between the bounds, at most 0.5", key));
    return value;
  };
  calibration.tolerance = share("search_tolerance", calibration.tolerance);
  calibration.difference = share("difference", calibration.difference);
  calibration.profile = top.whole_or("profile", 0, calibration.profile);
  calibration.profile_evaluations = top.whole_or("profile_evaluations", 1, calibration.profile_evaluations);
  if (const Entry* const parameters =
          top.require("parameters", "a map of names, each with 'bounds' and 'start'"))
    for (const Entry::Member& member : parameters->members)
      calibration.parameters.push_back(read_parameter(member, faults));
  if (calibration.parameters.empty()) top.fault("parameters", "parameters: at least one is sought");
  if (const Entry* const tests = top.require("tests", "a map of names, each with a test and its pressure")) {
    for (const Entry::Member& member : tests->members) {
      calibration.test_names.push_back(member.key);
      calibration.tests.push_back(
          read_test(document, member, file.parent_path(), scripts, packings_of, faults));
    }
    if (calibration.tests.empty()) top.fault("tests", "tests: at least one is needed");
  }
  if (const Entry* const parameters = top.find("parameters"))
    check_scripts(*parameters, calibration.tests, faults);
  const Entry* const targets = top.require("targets", "a list of target values of the tests");
  Takers takers;
  if (targets != nullptr && faults.empty())
    for (std::size_t k = 0; k < targets->items.size(); ++k)
      read_target(targets->items[k], k + 1, table, calibration, takers, faults);
  top.finish();
  if (faults.empty() && calibration.points.size() < calibration.parameters.size())
    top.fault("targets", fmt::format("targets: {} points cannot tell {} parameters",
                                     calibration.points.size(), calibration.parameters.size()));
  std::ranges::stable_sort(faults, {}, [](const Fault& fault) { return std::pair(fault.file, fault.line); });
  if (!faults.empty()) throw InputError(faults);
  // The packings to be made follow from these texts, and from their specification below.
  std::string all = coupler::content_of(file) + coupler::content_of(laboratory);
  for (const std::string& setting : settings) all += setting + '\n';
  for (const ElementSpecification& test : calibration.tests)
    for (const CellDefinition& cell : test.cells) {
      all += cell.script;
      for (const Grain& grain : cell.packing.grains)
        all += fmt::format("{} {} {}\n", grain.position.x(), grain.position.y(), grain.radius);
    }
  calibration.identity = polargrain::name_of(std::as_bytes(std::span(all))).text();
  return calibration;
}

std::vector<std::size_t> missed_points(
    const std::vector<TargetPoint>& points, const std::vector<std::vector<std::string>>& columns,
    const std::vector<std::vector<std::vector<std::vector<double>>>>& curves) {
  std::vector<std::size_t> missed;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const std::size_t test = points[k].test;
    if (std::ranges::any_of(curves[test], [&](const auto& rows) {
          const std::optional<double> value = value_of(points[k], columns[test], rows);
          return !value || !std::isfinite(*value);
        }))
      missed.push_back(k);
  }
  return missed;
}

std::vector<double> differences(const std::vector<TargetPoint>& points,
                                const std::vector<std::vector<std::string>>& columns,
                                const std::vector<std::vector<std::vector<std::vector<double>>>>& curves) {
  std::vector<double> result;
  for (const TargetPoint& point : points) {
    double sum = 0.0;
    for (const auto& rows : curves[point.test]) {
      const std::optional<double> value = value_of(point, columns[point.test], rows);
      sum += value && std::isfinite(*value)
                 ? std::clamp((*value - point.value) / point.error, -100.0 * kMissed, 100.0 * kMissed)
                 : kMissed;
    }
    result.push_back(sum / static_cast<double>(curves[point.test].size()));
  }
  return result;
}

}  // namespace polargrain::app
