// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <utility>

#include "coupler/case/parts.hpp"

namespace polargrain::coupler {
namespace {

/// Most steps of a case. A row of each stays in memory, for checkpoints, and is written once more with each of them.
constexpr int kMostSteps = 1000000;

/// The memory of a step, measured: its place in the plan, its rows, its values for the summary.
constexpr double kBytesOfStep = 1000.0;

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

void read_steps(const Entry& entry, CaseParts& parts) {
  Section steps(entry, "steps", parts.faults);
  std::vector<StepTarget>& plan = parts.result.plan;
  const Entry* stages = steps.find("stages");
  if (stages == nullptr) {
    const int count = step_count(steps, 0);
    const double end = steps.quantity_or("duration", Dimension::duration, Limit::positive, 1.0);
    if (steps.find("duration") != nullptr && steps.find("time") == nullptr)
      steps.fault("duration", "duration: the loading time ends at 1; real time needs 'time: real'");
    for (int i = 1; i <= count; ++i) {
      plan.push_back({StepTarget::Control::time, i == count ? end : end * i / count, {}});
    }
  } else {
    if (steps.find("count") != nullptr) {
      steps.fault("count", "count: each stage has its own; remove it or the stages");
    }
    read_stages(*stages, parts);
  }
  const std::string method = steps.choice_or("method", {"newton", "explicit", "automatic"}, "newton");
  if (method != "newton") {
    if (parts.builds)
      steps.fault("method",
                  "method: stages in which parts come or go are computed by newton alone; remove the method");
    read_explicit(steps, method == "automatic", parts);
  }
  fem::SolverOptions& solver = parts.result.solver;
  solver.most_cuts = steps.whole_or("cut", 0, solver.most_cuts);
  solver.most_iterations = steps.whole_or("iterations", 1, solver.most_iterations);
  // Grains answer with noise: a case without cells may well ask for less.
  solver.force_tolerance = steps.quantity_or("tolerance", Dimension::number, Limit::positive, 1e-3);
  solver.moment_tolerance =
      steps.quantity_or("moment_tolerance", Dimension::number, Limit::positive, solver.force_tolerance);
  for (const char* const key : {"tolerance", "moment_tolerance", "jump_residual"})
    steps.require_below(key, 1.0, "the unbalanced forces may not be as large as the loads");
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
  steps.finish();
}

}  // namespace polargrain::coupler
