// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string>

#include "app/remarks/remark.hpp"
#include "coupler/case/case.hpp"
#include "fem/solver/solver.hpp"

namespace polargrain::app {

/// Advice for a user whose step fails: where it is out of balance (nodes, boundaries, elements), which points have no
/// good answer and why, what the cells there say, and which keys of the case are worth trying, with the reason of each.
/// Lines, each begun with two blanks; empty when nothing is known.
template <int dim>
std::string advice(const fem::Trouble& trouble, const fem::Solver<dim>& solver,
                   const coupler::Case& the_case);

/// The same of step 0, which brings the stress at time zero into balance with the loads: no key of the steps helps there.
/// @param remarks on the case, of which those about time zero are repeated
template <int dim>
std::string advice_at_start(const fem::Trouble& trouble, const fem::Solver<dim>& solver,
                            const Remarks& remarks);

}  // namespace polargrain::app
