// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <span>

#include "fem/solver/solver.hpp"

namespace polargrain::fem {

/// Steps of both methods (docs/theory/explicit.md): Newton's while it balances within a stated effort, explicit steps
/// through what it cannot balance, Newton's again from rest.
struct AutomaticOptions {
  int effort = 0;          ///< iterations that a step may take, lost ones too
  int explicit_steps = 0;  ///< of a whole step, where it is taken so
  ExplicitOptions options;
  double rest = 1e-3;  ///< ExplicitOptions::rest before iterations are tried again
};

/// Whether a step behind these is to be tried by Newton's method. It is, behind a step that it has balanced. Where it was
/// given up, it is tried again after 1, 2, 4, 8 and 16 steps, and every 16th behind that: a hindrance may last.
/// @param steps all reports so far, the report of the start first; of each, given_up and explicit_steps count
[[nodiscard]] bool iterations_are_due(std::span<const StepReport> steps);

/// Goes on to `time` by the method that is due; a step that is given up by the other one, from where it stands. Explicit steps
/// come to rest before iterations are due again; where they do not, explicit steps go on.
/// @param before as in iterations_are_due
/// @returns its given_up and explicit_steps tell what was done
template <int dim>
StepReport advance_automatic(Solver<dim>& solver, double time, std::span<const StepReport> before,
                             const AutomaticOptions& options);

}  // namespace polargrain::fem
