// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "coupler/case/section.hpp"
#include "coupler/cells/cosserat_part.hpp"
#include "coupler/cells/informed_material.hpp"

namespace polargrain::coupler {

/// Reads the options of `informed` beside its cells and G, Gc, lc: nu, update, mismatch_limit,
/// beyond_mismatch, drift_shear, match, cohesion, invariants; all have defaults. `cell` and `adaptive` read them too and make no use of
/// them, so that a case changes from one to the other by one word. The moduli are left open.
template <int dim>
InformedParameters<dim> read_informed_parameters(Section& section);
/// Reads them for their faults alone.
void check_informed_parameters(Section& section, int dimension);

}  // namespace polargrain::coupler
