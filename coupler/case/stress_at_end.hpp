// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "coupler/case/case.hpp"
#include "coupler/checkpoint/checkpoint.hpp"
#include "fem/solver/end_of_run.hpp"

namespace polargrain::coupler {

/// Adds the pressure of the run before, and the stress that it has left behind the sides which this case loads. Nothing where the
/// checkpoint holds no stresses, or no load acts at time zero. @param body at the end of that run
template <int dim>
void add_stress_at_end(Checkpoint& end, const fem::EndOfRun<dim>& body, const fem::Problem<dim>& problem,
                       RunBefore& before);

}  // namespace polargrain::coupler
