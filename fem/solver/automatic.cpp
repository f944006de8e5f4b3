// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/solver/automatic.hpp"

#include <algorithm>
#include <cmath>

namespace polargrain::fem {
namespace {

constexpr int kLongestWait = 16;  // steps between two tries

bool was_explicit(const StepReport& step) {
  return step.explicit_steps > 0 || step.given_up > 0;
}

}  // namespace

bool iterations_are_due(std::span<const StepReport> steps) {
  if (steps.empty() || !was_explicit(steps.back())) return true;
  if (steps.back().explicit_steps == 0) return false;  // the start, which is not in balance
  int tries = 0;
  int since = 0;  // explicit steps since the last try, its own included
  for (auto step = steps.rbegin(); step != steps.rend() && was_explicit(*step); ++step) {
    if (tries == 0) ++since;
    if (step->given_up > 0) ++tries;
  }
  return tries == 0 || since >= std::min(kLongestWait, 1 << std::min(tries - 1, 10));
}

template <int dim>
StepReport advance_automatic(Solver<dim>& solver, double time, std::span<const StepReport> before,
                             const AutomaticOptions& options) {
  const double start = solver.state().time;
  const auto is_at_rest = [&](const StepReport& step) {
    return step.explicit_steps == 0 || step.quasi_static.nodes_unbalanced <= options.rest;
  };
  StepReport iterated;
  if (iterations_are_due(before) && (before.empty() || is_at_rest(before.back()))) {
    iterated = solver.advance(time, 1.0, options.effort);
    if (iterated.converged) return iterated;
  }
  StepReport report;
  report.explicit_steps = 1;
  report.given_up = iterated.iterations;
  std::vector<StepReport> with_this(before.begin(), before.end());
  with_this.push_back(report);
  ExplicitOptions explicit_options = options.options;
  if (iterations_are_due(with_this)) explicit_options.rest = options.rest;
  const double left = (time - solver.state().time) / (time - start);
  const int steps = std::max(1, static_cast<int>(std::ceil(options.explicit_steps * left)));
  report = solver.advance_explicit(time, steps, explicit_options);
  report += iterated;
  report.given_up = iterated.iterations;
  return report;
}

template StepReport advance_automatic<2>(Solver<2>&, double, std::span<const StepReport>,
                                         const AutomaticOptions&);
template StepReport advance_automatic<3>(Solver<3>&, double, std::span<const StepReport>,
                                         const AutomaticOptions&);

}  // namespace polargrain::fem
