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

/// @returns the count that a key gives; 1, with a fault, where it and those before are too many
int step_count(Section& section, std::size_t before) {
  const int count = section.whole("count", 1);
  const double all = static_cast<double>(before) + count;
  if (all <= kMostSteps) return count;
  section.fault("count",
                fmt::format("count: {:.0f} steps would take {:.0f} GB of memory; at most {} are taken", all,
                            1e-9 * kBytesOfStep * all, kMostSteps));
  return 1;
}

/// Mean of a dof over the nodes of a place, less its mean over another.
fem::DisplacementMeasure read_measure(const Entry& entry, const std::string& name, CaseParts& parts) {
  Section section(entry, name + ": measure", parts.faults);
  fem::DisplacementMeasure measure;
  const std::string on = section.text("on", "the name of a boundary or node set");
  const std::string from = section.text_or("from", "");
  const std::string dof = section.choice("displacement", dof_names(parts.result.dimension()));
  section.finish();
  const auto add_mean = [&](const std::string& key, const std::string& place, double sign) {
    if (place.empty()) return;
    parts.check_places(section, key, {place});
    const bool known =
        parts.result.with_problem([&](const auto& problem) { return problem.mesh.has_nodes_on(place); });
    if (!parts.has_mesh || !known || dof.empty()) return;
    const std::vector<int> nodes =
        parts.result.with_problem([&](const auto& problem) { return problem.mesh.nodes_on(place); });
    for (const int node : nodes) {
      measure.terms.push_back({node, dof_of(dof), sign / static_cast<double>(nodes.size())});
    }
  };
  add_mean("on", on, 1.0);
  add_mean("from", from, -1.0);
  return measure;
}

/// Adds the steps of one stage to the plan. @param time when the stage begins, moved on to its end
void read_stage(const Entry& entry, const std::string& name, double& time, CaseParts& parts) {
  Section stage(entry, name, parts.faults);
  std::vector<StepTarget>& plan = parts.result.plan;
  const int count = step_count(stage, plan.size());
  const bool until = stage.find("until") != nullptr;
  const Entry* measure = stage.find("measure");
  const bool arc = stage.find("arc_length") != nullptr;
  if (until + (measure != nullptr) + arc != 1 && entry.kind == Entry::Kind::map) {
    parts.faults.push_back(entry.fault(name + ": expected one of until, measure (with grow) and arc_length"));
  } else if (until) {
    const double end = stage.quantity("until", Dimension::number, Limit::positive);
    if (!plan.empty() && plan.back().control != StepTarget::Control::time) {
      stage.fault("until",
                  "until: the time is not known after a stage that follows a measure or the arc length; "
                  "put stages under time before them");
    } else if (end <= time) {
      stage.fault("until", fmt::format("until: must be later than the end of the stage before, {}", time));
    }
    for (int i = 1; i <= count; ++i) {
      plan.push_back({StepTarget::Control::time, i == count ? end : time + (end - time) * i / count, {}});
    }
    time = end;
  } else if (measure != nullptr) {
    const fem::DisplacementMeasure of = read_measure(*measure, name, parts);
    const double grow = stage.quantity("grow", Dimension::length, Limit::any);
    if (grow == 0.0) stage.fault("grow", "grow: must not be zero");
    for (int i = 0; i < count; ++i) plan.push_back({StepTarget::Control::measure, grow / count, of});
  } else if (arc) {
    const double length = stage.quantity("arc_length", Dimension::length, Limit::positive);
    if (plan.empty()) {
      stage.fault("arc_length",
                  "arc_length: it goes on in the direction of the step before; begin with a stage 'until'");
    }
    for (int i = 0; i < count; ++i) plan.push_back({StepTarget::Control::arc_length, length / count, {}});
  }
  stage.finish();
}

void read_stages(const Entry& entry, CaseParts& parts) {
  if (entry.kind != Entry::Kind::sequence || entry.items.empty()) {
    parts.faults.push_back(
        entry.fault("steps: stages: expected a list, each item a map such as {until: 1, count: 10}"));
    return;
  }
  double time = 0.0;
  for (std::size_t i = 0; i < entry.items.size(); ++i) {
    read_stage(entry.items[i], fmt::format("stage {}", i + 1), time, parts);
  }
}

}  // namespace

void read_steps(const Entry& entry, CaseParts& parts) {
  Section steps(entry, "steps", parts.faults);
  std::vector<StepTarget>& plan = parts.result.plan;
  const Entry* stages = steps.find("stages");
  if (stages == nullptr) {
    const int count = step_count(steps, 0);
    for (int i = 1; i <= count; ++i) {
      plan.push_back({StepTarget::Control::time, static_cast<double>(i) / count, {}});
    }
  } else {
    if (steps.find("count") != nullptr) {
      steps.fault("count", "count: each stage has its own; remove it or the stages");
    }
    read_stages(*stages, parts);
  }
  if (steps.choice_or("method", {"newton", "explicit"}, "newton") == "explicit") read_explicit(steps, parts);
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
