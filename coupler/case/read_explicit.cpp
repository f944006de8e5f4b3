// SPDX-License-Identifier: GPL-2.0-or-later
// steps: method: explicit, and automatic (docs/theory/explicit.md)
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/elementary_functions.hpp"
#include "coupler/case/parts.hpp"
#include "fem/element/kinematics.hpp"
#include "fem/solver/base_motion.hpp"
#include "fem/solver/explicit_rate.hpp"

namespace polargrain::coupler {
namespace {

/// Movement of the fastest boundary in a step over the smallest element: at half of it curves before the peak change by some
/// 0.5 % (docs/theory/explicit.md).
constexpr double kPace = 1.5e-4;

/// A step has at least so many DEM steps: one is unstable.
constexpr int kLeastDemSteps = 2;

/// Explicit steps after which cells that inform a law follow it: some 1e-3 of strain at the default pace and four rows of
/// elements, as in a step of Newton's method.
constexpr int kAskEvery = 20;

/// Unbalanced forces of the nodes over the loads, at rest.
constexpr double kRest = 1e-3;

/// Iterations that a step may take before explicit steps go on: some four times as many as a step of cells usually takes.
constexpr int kEffort = 40;

/// Explicit steps of a case: more would not end.
constexpr double kMostExplicitSteps = 1e8;

/// Length of the side of a square or a cube as large as the smallest element, m.
template <int dim>
double smallest_element(const fem::Mesh<dim>& mesh) {
  double least = HUGE_VAL;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    double volume = 0.0;
    for (const fem::PointGeometry<dim>& point :
         fem::point_geometries<dim>(*mesh.elements[e].type, mesh.element_positions(static_cast<int>(e))))
      volume += point.volume;
    least = std::min(least, volume);
  }
  return dim == 2 ? std::sqrt(least) : power(least, 1.0 / 3.0);
}

/// The longest way of a boundary between two times, m.
template <int dim>
double longest_way(const fem::Problem<dim>& problem, double start, double end) {
  double longest = 0.0;
  for (const fem::PrescribedDof<dim>& item : problem.prescribed) {
    if (fem::is_rotation(item.dof) || !problem.mesh.has_nodes_on(item.on)) continue;
    double factor = item.profile ? 0.0 : 1.0;
    if (item.profile)
      for (const int node : problem.mesh.nodes_on(item.on))
        factor = std::max(factor, std::abs(item.profile(problem.mesh.nodes[static_cast<std::size_t>(node)])));
    longest = std::max(longest, factor * std::abs(item.value.at(end) - item.value.at(start)));
  }
  return longest;
}

/// A whole number of explicit steps, before the steps are read; 0 where the case asks for another method.
int early(const Entry& document, const std::string& key, int least, int otherwise) {
  const Entry* const steps = document.find("steps");
  const Entry* const method = steps == nullptr ? nullptr : steps->find("method");
  if (method == nullptr || (method->text != "explicit" && method->text != "automatic")) return 0;
  Faults faults;  // read once more, with its faults, by read_explicit
  Section section(*steps, "steps", faults);
  return section.whole_or(key, least, otherwise);
}

}  // namespace

bool is_real_time(const Entry& document) {
  const Entry* const steps = document.find("steps");
  const Entry* const time = steps == nullptr ? nullptr : steps->find("time");
  return time != nullptr && time->text == "real";
}

int dem_steps_of(const Entry& document) {
  return early(document, "dem_steps", kLeastDemSteps, kDemSteps);
}

int ask_every_of(const Entry& document) {
  return early(document, "ask_every", 1, kAskEvery);
}

bool iterates(const Entry& document) {
  const Entry* const steps = document.find("steps");
  const Entry* const method = steps == nullptr ? nullptr : steps->find("method");
  return method == nullptr || method->text != "explicit" || is_real_time(document);
}

namespace {

/// Damping acts on the motion relative to the base, so there must be one base.
template <int dim>
void check_base(const fem::Problem<dim>& problem, Section& steps) {
  const int stages = std::max(1, static_cast<int>(problem.stages.size()));
  for (int stage = 0; stage < stages; ++stage)
    for (const fem::Dof dof : fem::node_dofs<dim>()) {
      if (fem::is_rotation(dof)) continue;
      const fem::BaseAlong<dim> base = fem::base_along(problem, stage, dof);
      if (base.other == nullptr) continue;
      return steps.fault(
          "mass_damping",
          fmt::format(
              "mass_damping: it damps the motion relative to the base, and along {} '{}' and '{}' move "
              "differently; accelerate both alike, or leave mass_damping out",
              fem::name_of<dim>(dof), base.item->on, base.other->on));
    }
}

/// Steps follow from masses and stiffness; nothing is to be chosen but damping.
void read_real_time(Section& steps, CaseParts& parts) {
  Case& result = parts.result;
  result.real_time = true;
  result.explicit_options.mass_damping =
      steps.quantity_or("mass_damping", Dimension::rate, Limit::not_negative, 0.0);
  if (const Entry* const damping = steps.find("mass_damping");
      damping != nullptr && damping->text.find('%') != std::string::npos)
    steps.fault("mass_damping",
                "mass_damping: not a damping ratio; the ratio D at the frequency f is 4 pi f D");
  if (result.explicit_options.mass_damping > 0.0)
    result.with_problem([&](const auto& problem) { check_base(problem, steps); });
  for (const char* const key : {"pace", "explicit_steps", "dem_steps", "error", "rest_at_output"})
    if (steps.find(key) != nullptr)
      steps.fault(key,
                  fmt::format("{}: in real time it follows from masses and stiffness; leave it out", key));
  if (steps.find("ask_every") != nullptr) static_cast<void>(steps.whole_or("ask_every", 1, kAskEvery));
  for (StepTarget& target : result.plan) {
    if (target.control != StepTarget::Control::time)
      steps.fault("time", "time: real time follows no measure; give the stages `until`, in s");
    target.explicit_steps = 1;  // at least: the run finds how many
  }
}

}  // namespace

void read_explicit(Section& steps, bool automatic, CaseParts& parts) {
  Case& result = parts.result;
  if (steps.choice_or("time", {"loading", "real"}, "loading") == "real") {
    if (automatic) steps.fault("time", "time: real time has explicit steps alone; write 'method: explicit'");
    return read_real_time(steps, parts);
  }
  if (automatic) result.effort = steps.whole_or("effort", 1, kEffort);
  static_cast<void>(steps.whole_or("dem_steps", kLeastDemSteps, kDemSteps));
  static_cast<void>(steps.whole_or("ask_every", 1, kAskEvery));
  double pace = steps.quantity_if("pace", Dimension::number, Limit::positive).value_or(kPace);
  steps.require_below("pace", 0.01, "a boundary would run into its elements like a hammer");
  const int given = steps.find("explicit_steps") == nullptr ? 0 : steps.whole("explicit_steps", 0);
  result.gives_explicit_steps = given > 0;
  if (given > 0 && steps.find("pace") != nullptr)
    steps.fault("pace", "pace: `explicit_steps` says it already; leave one of them out");
  result.explicit_error =
      steps.quantity_or("error", Dimension::number, Limit::positive, result.explicit_error);
  // Who says what error is allowed, and no rate, lets the program find it.
  result.rate_follows = steps.find("error") != nullptr && given == 0 && steps.find("pace") == nullptr;
  if (result.rate_follows) pace *= std::min(1.0, result.explicit_error / fem::ExplicitRate{}.error);
  if (given == 0 && steps.find("pace") == nullptr) steps.leave("pace", value_text(pace, Dimension::number));
  steps.require_below("error", 1.0, "it is a share of the reactions, 2 % is '2 %' or 0.02");
  if (steps.flag("rest_at_output")) result.explicit_options.rest = kRest;
  const double end = result.plan.empty() ? 0.0 : result.plan.back().amount;
  const double size =
      parts.has_mesh ? result.with_problem([](const auto& problem) { return smallest_element(problem.mesh); })
                     : 1.0;
  double time = 0.0;
  double all = 0.0;
  for (StepTarget& target : result.plan) {
    if (target.control != StepTarget::Control::time) {
      steps.fault("method", "method: explicit steps follow the time; give the stages `until`, or use newton");
      return;
    }
    const double way =
        result.with_problem([&](const auto& problem) { return longest_way(problem, time, target.amount); });
    const double wanted =
        given > 0 ? std::round(given * (target.amount - time) / end) : std::ceil(way / (pace * size));
    if (given == 0 && way == 0.0 && parts.has_mesh) {
      steps.fault(
          "method",
          fmt::format("method: no boundary moves between times {:.4g} and {:.4g}, so the number of explicit "
                      "steps cannot follow from the pace; give `explicit_steps: N`, for all of the run",
                      time, target.amount));
      return;
    }
    all += wanted;
    target.explicit_steps = static_cast<int>(std::clamp(wanted, 1.0, kMostExplicitSteps));
    time = target.amount;
  }
  if (all > kMostExplicitSteps)
    steps.fault("method", fmt::format("method: {:.2g} explicit steps would not end; at most {:.0g} are taken",
                                      all, kMostExplicitSteps));
}

}  // namespace polargrain::coupler
