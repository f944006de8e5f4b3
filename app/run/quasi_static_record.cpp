// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/run/quasi_static_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <utility>

namespace polargrain::app {
namespace {

using fem::QuasiStatic;

/// Of the internal work: beyond it the mesh swings rather than deforms. 5 to 10 % are customary in explicit codes.
constexpr double kMostKinetic = 0.05;

/// Share of the forces that is out of balance at the nodes, inertia of the chosen masses included.
constexpr double kMostUnbalanced = 0.1;

struct KindOfError {
  const char* name;
  const char* meaning;
  double tolerance;
  std::function<double(const QuasiStatic&)> value;
};

std::vector<KindOfError> kinds(double error) {
  const QuasiStatic of_difference{.reaction_difference = 1.0};
  const QuasiStatic of_grains{.grains_unbalanced = 1.0};
  return {{"error_estimate", "estimated error of the reactions", error, &QuasiStatic::error},
          {"reaction_difference", "reactions of moved and held boundaries differ by",
           error / of_difference.error(), [](const QuasiStatic& row) { return row.reaction_difference; }},
          {"grains_unbalanced", "unbalanced ratio of the grains", error / of_grains.error(),
           [](const QuasiStatic& row) { return row.grains_unbalanced; }},
          {"nodes_unbalanced", "unbalanced ratio of the nodes", kMostUnbalanced,
           [](const QuasiStatic& row) { return row.nodes_unbalanced; }},
          {"kinetic_share", "kinetic energy of the chosen masses over internal work", kMostKinetic,
           [](const QuasiStatic& row) { return row.kinetic_share; }},
          {"hot_points", "share of the boxes that do not come to rest", 0.0,
           [](const QuasiStatic& row) { return row.hot_points; }}};
}

/// @param slower the change below `steps` that loads more slowly
std::string remedy_of(const std::string& name, const std::string& slower) {
  if (name == "hot_points")
    return fmt::format(
        "the grains there press by their agitation; {} below `steps`, and where that does not help raise the "
        "`damping` of the material",
        slower);
  return fmt::format("{} below `steps`, or allow more by `error`", slower);
}

/// Whether a boundary is moved: it then says where the body is.
bool moves_a_boundary(const coupler::Case& the_case) {
  return the_case.with_problem([](const auto& problem) {
    return std::ranges::any_of(problem.prescribed,
                               [](const auto& item) { return item.value.largest_magnitude() > 0.0; });
  });
}

/// Rows that were to end at rest and did not.
std::optional<std::string> remark_on_rest(const coupler::Case& the_case, const RunRecord& record) {
  const int most = the_case.explicit_options.most_rest_steps;
  const auto is_restless = [most](const CommittedStep& step) { return step.report.rest_steps >= most; };
  const auto count = std::ranges::count_if(record.steps, is_restless);
  if (count == 0) return {};
  const auto first = std::ranges::find_if(record.steps, is_restless);
  return fmt::format(
      "explicit steps: {} row{} did not come to rest in {} steps, the first in step {}: their values are of a body that "
      "still moves; where loads have grown, it bears no more: move a boundary in the place of a load",
      count, count == 1 ? "" : "s", most, first->step);
}

/// Under loads alone nodes are behind the place of their balance, and forces say little of how far.
std::optional<std::string> remark_on_loads_alone(const coupler::Case& the_case, const RunRecord& record) {
  const bool is_given_by_forces =
      the_case.is_explicit() && !the_case.real_time && !moves_a_boundary(the_case);
  const bool has_rows = std::ranges::any_of(
      record.steps, [](const CommittedStep& step) { return step.report.explicit_steps > 0; });
  if (!has_rows || !is_given_by_forces || the_case.explicit_options.rest > 0.0) return {};
  return "explicit steps: no boundary is moved, and the error is of forces: displacements are behind those of balance, "
         "without bound where the body bears no more; write `rest_at_output: yes`, or move a boundary";
}

}  // namespace

std::vector<QuasiStaticMeasure> quasi_static_measures(const coupler::Case& the_case,
                                                      const RunRecord& record) {
  std::vector<QuasiStaticMeasure> measures;
  if (!the_case.is_explicit() || the_case.real_time) return measures;
  for (const KindOfError& kind : kinds(the_case.explicit_error)) {
    QuasiStaticMeasure measure{kind.name, kind.meaning, kind.tolerance};
    std::vector<double> values;
    for (const CommittedStep& step : record.steps) {
      if (step.report.explicit_steps == 0) continue;
      const double value = kind.value(step.report.quasi_static);
      values.push_back(value);
      if (value > measure.tolerance) ++measure.steps_beyond;
      if (value > measure.largest)
        std::tie(measure.largest, measure.worst_step) = std::pair(value, step.step);
    }
    if (values.empty()) return {};
    measure.steps = static_cast<int>(values.size());
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    measure.median = *middle;
    measures.push_back(std::move(measure));
  }
  return measures;
}

nlohmann::ordered_json quasi_static_figures(const coupler::Case& the_case, const RunRecord& record) {
  nlohmann::ordered_json figures;
  for (const QuasiStaticMeasure& measure : quasi_static_measures(the_case, record))
    figures[measure.name] = {{"meaning", measure.meaning},
                             {"tolerance", measure.tolerance},
                             {"median", measure.median},
                             {"largest", measure.largest},
                             {"step_of_largest", measure.worst_step},
                             {"steps_beyond", measure.steps_beyond}};
  return figures;
}

std::string quasi_static_text(const coupler::Case& the_case, const RunRecord& record) {
  const std::vector<QuasiStaticMeasure> measures = quasi_static_measures(the_case, record);
  if (measures.empty()) return {};
  std::string text =
      fmt::format("how far the explicit steps were from equilibrium (%)\n  {:<56}{:>9}{:>9}{:>9}{:>11}\n", "",
                  "median", "largest", "in step", "tolerance");
  for (const QuasiStaticMeasure& measure : measures)
    text += fmt::format("  {:<56}{:>9.3g}{:>9.3g}{:>9}{:>11.3g}{}\n", measure.meaning, 100.0 * measure.median,
                        100.0 * measure.largest, measure.worst_step, 100.0 * measure.tolerance,
                        measure.steps_beyond > 0 ? "  beyond" : "");
  return text;
}

std::vector<std::string> quasi_static_remarks(const coupler::Case& the_case, const RunRecord& record) {
  std::vector<std::string> remarks;
  for (const auto& remark : {remark_on_rest(the_case, record), remark_on_loads_alone(the_case, record)})
    if (remark) remarks.push_back(*remark);
  const char* const slower = the_case.gives_explicit_steps ? "double `explicit_steps`" : "halve `pace`";
  for (const QuasiStaticMeasure& measure : quasi_static_measures(the_case, record)) {
    if (measure.steps_beyond == 0) continue;
    remarks.push_back(
        fmt::format("explicit steps: {}: up to {:.3g} % in step {}, beyond {:.3g} % in {} of {} steps; {}",
                    measure.meaning, 100.0 * measure.largest, measure.worst_step, 100.0 * measure.tolerance,
                    measure.steps_beyond, measure.steps, remedy_of(measure.name, slower)));
  }
  return remarks;
}

}  // namespace polargrain::app
