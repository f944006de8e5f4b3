// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/run/automatic_record.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <utility>
#include <vector>

namespace polargrain::app {
namespace {

/// Steps that follow each other by one method, from the first on.
struct Stretch {
  bool is_explicit;
  int first;
  int last;
};

std::vector<Stretch> stretches(const RunRecord& record) {
  std::vector<Stretch> all;
  for (const CommittedStep& step : record.steps) {
    if (step.step == 0) continue;
    const bool is_explicit = step.report.explicit_steps > 0;
    if (all.empty() || all.back().is_explicit != is_explicit)
      all.push_back({is_explicit, step.step, step.step});
    all.back().last = step.step;
  }
  return all;
}

int iterations_given_up(const RunRecord& record) {
  int sum = 0;
  for (const CommittedStep& step : record.steps) sum += step.report.given_up;
  return sum;
}

int steps_of(const RunRecord& record, bool is_explicit) {
  int sum = 0;
  for (const Stretch& stretch : stretches(record))
    if (stretch.is_explicit == is_explicit) sum += stretch.last - stretch.first + 1;
  return sum;
}

}  // namespace

nlohmann::ordered_json automatic_figures(const RunRecord& record) {
  nlohmann::ordered_json figures{{"steps_by_iterations", steps_of(record, false)},
                                 {"steps_explicit", steps_of(record, true)},
                                 {"iterations_given_up", iterations_given_up(record)}};
  figures["explicit"] = nlohmann::ordered_json::array();
  for (const Stretch& stretch : stretches(record))
    if (stretch.is_explicit) figures["explicit"].push_back({stretch.first, stretch.last});
  return figures;
}

std::string automatic_text(const coupler::Case& the_case, const RunRecord& record) {
  if (!the_case.is_automatic()) return {};
  constexpr std::size_t kMostShown = 10;
  std::vector<std::string> shown;
  std::size_t count = 0;
  for (const Stretch& stretch : stretches(record)) {
    if (!stretch.is_explicit || ++count > kMostShown) continue;
    shown.push_back(stretch.first == stretch.last ? fmt::format("{}", stretch.first)
                                                  : fmt::format("{} to {}", stretch.first, stretch.last));
  }
  if (count == 0) return "Newton's method balanced all steps\n";
  if (count > kMostShown) shown.emplace_back("others");
  return fmt::format(
      "Newton's method balanced {} steps; {} went on in explicit steps ({}), where {} iterations were given up\n",
      steps_of(record, false), steps_of(record, true), fmt::join(shown, ", "), iterations_given_up(record));
}

}  // namespace polargrain::app
