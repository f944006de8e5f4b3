// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "coupler/case/parts.hpp"

namespace polargrain::coupler {
namespace {

/// Most steps of a case. A row of each stays in memory, for checkpoints, and is written once more with each of them.
constexpr int kMostSteps = 1000000;

/// The memory of a step, measured: its place in the plan, its rows, its values for the summary.
constexpr double kBytesOfStep = 1000.0;

/// The flow of water needs the duration of each step.
void check_steps_with_water(Section& steps, const std::vector<StepTarget>& plan) {
  const bool by_time = std::ranges::all_of(
      plan, [](const StepTarget& target) { return target.control == StepTarget::Control::time; });
  if (!by_time)
    steps.fault("stages",
                "stages: water flows in a known time; with 'water' a stage ends at a time ('until'), not at "
                "a measure or an arc length");
  if (const Entry* const method = steps.find("method"); method != nullptr && method->text == "automatic")
    steps.fault("method", "method: 'automatic' takes no water yet; write newton or explicit");
}

/// The keys of Newton's method.
void read_iterations(Section& steps, CaseParts& parts) {
  fem::SolverOptions& solver = parts.result.solver;
  solver.most_cuts = steps.whole_or("cut", 0, solver.most_cuts);
  solver.most_iterations = steps.whole_or("iterations", 1, solver.most_iterations);
  // Grains answer with noise. Laws do not, and a loose balance of theirs hides a collapse.
  solver.force_tolerance = steps.quantity_or("tolerance", Dimension::number, Limit::positive,
                                             parts.result.needs_workers() ? 1e-3 : 1e-5);
  solver.moment_tolerance =
      steps.quantity_or("moment_tolerance", Dimension::number, Limit::positive, solver.force_tolerance);
  for (const char* const key : {"tolerance", "moment_tolerance", "jump_residual"})
    steps.require_below(key, 1.0, "the unbalanced forces may not be as large as the loads");
  for (const char* const key : {"tolerance", "moment_tolerance"})
    steps.require_at_least(key, 1e-13, "a smaller one cannot be reached, as numbers carry 16 digits");
  solver.noise_factor = steps.quantity_or("noise", Dimension::number, Limit::not_negative, 0.0);
  // Grains rearrange: without passing their jumps no band is followed far.
  solver.most_jumps = steps.whole_or("jumps", 0, parts.result.needs_workers() ? 50 : 0);
  solver.jump_residual =
      steps.quantity_or("jump_residual", Dimension::number, Limit::positive, solver.jump_residual);
  solver.acceleration_depth = steps.whole_or("acceleration", 0, 0);
  // The cost of a box of grains to follow a strain grows with the strain.
  solver.largest_strain = steps.quantity_or("largest_strain", Dimension::number, Limit::positive,
                                            parts.result.needs_workers() ? 0.05 : solver.largest_strain);
  // A residual that grows within the noise of the grains is no reason to ask all of them again.
  solver.most_line_search_halvings =
      steps.whole_or("line_search", 0, parts.result.needs_workers() ? 0 : solver.most_line_search_halvings);
}

}  // namespace

int step_count(Section& section, std::size_t before) {
  const int count = section.whole("count", 1);
  const double all = static_cast<double>(before) + count;
  if (all <= kMostSteps) return count;
  section.fault("count",
                fmt::format("count: {:.0f} steps would take {:.0f} GB of memory; at most {} are taken", all,
                            1e-9 * kBytesOfStep * all, kMostSteps));
  return 1;
}

std::vector<double> times_of_steps(Section& section, double start, double end, int count,
                                   const CaseParts& parts) {
  std::vector<double> times;
  const double whole = end - start;
  const double first = section.quantity_if("first", Dimension::duration, Limit::positive).value_or(0.0);
  double growth = 1.0;
  if (first > 0.0) {
    const auto reached = [&](double ratio) {  // by so many steps, each `ratio` times the one before
      return ratio == 1.0 ? first * count : first * (std::pow(ratio, count) - 1.0) / (ratio - 1.0);
    };
    if (!parts.water)
      section.fault("first", "first: steps grow where water flows; without 'water' they are equal");
    if (count < 2 || reached(1.0) > whole) {
      section.fault(
          "first",
          fmt::format("first: {} steps of this length go beyond the end; give a shorter one", count));
    } else {
      double high = 2.0;
      while (reached(high) < whole) high *= 2.0;
      double low = 1.0;
      for (int k = 0; k < 200; ++k) (reached(0.5 * (low + high)) < whole ? low : high) = 0.5 * (low + high);
      growth = high;
    }
  }
  double step = first;
  double time = start;
  for (int i = 1; i <= count; ++i) {
    time = growth > 1.0 ? time + step : start + whole * i / count;
    step *= growth;
    times.push_back(i == count ? end : time);
  }
  return times;
}

void read_steps(const Entry& entry, CaseParts& parts) {
  Section steps(entry, "steps", parts.faults);
  std::vector<StepTarget>& plan = parts.result.plan;
  const Entry* stages = steps.find("stages");
  if (stages == nullptr) {
    const int count = step_count(steps, 0);
    const double end = steps.quantity_if("duration", Dimension::duration, Limit::positive).value_or(1.0);
    const bool has_duration = steps.find("duration") != nullptr;
    if (has_duration && !parts.water && steps.find("time") == nullptr)
      steps.fault("duration", "duration: the loading time ends at 1; real time needs 'time: real'");
    if (!has_duration && parts.water)
      steps.fault("duration",
                  "steps: with water the time is physical; give the time that the steps take, such as "
                  "'duration: 10 d'");
    for (const double time : times_of_steps(steps, 0.0, end, count, parts))
      plan.push_back({StepTarget::Control::time, time, {}});
  } else {
    if (steps.find("count") != nullptr) {
      steps.fault("count", "count: each stage has its own; remove it or the stages");
    }
    read_stages(*stages, parts);
  }
  if (parts.water) check_steps_with_water(steps, plan);
  const std::string method = steps.choice_or("method", {"newton", "explicit", "automatic"}, "newton");
  if (method != "newton") {
    if (parts.builds)
      steps.fault("method",
                  "method: stages in which parts come or go are computed by newton alone; remove the method");
    read_explicit(steps, method == "automatic", parts);
  } else if (!parts.water && steps.choice_or("time", {"loading", "real"}, "loading") == "real") {
    steps.fault("time", "time: real time has explicit steps alone; write 'method: explicit'");
  }
  if (method == "explicit" && !parts.result.real_time) {
    for_its_faults(parts.faults, [&] { read_iterations(steps, parts); });
    if (steps.find("largest_strain") == nullptr)
      steps.leave("largest_strain", value_text(parts.result.solver.largest_strain, Dimension::number));
  } else {
    read_iterations(steps, parts);
  }
  steps.finish();
}

}  // namespace polargrain::coupler
