// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "coupler/case/section.hpp"
#include "coupler/cells/cosserat_part.hpp"
#include "coupler/cells/informed_material.hpp"

namespace polargrain::coupler {

/// Reads the keys of the map `informed` of a material with cells: nu, update, mismatch_limit, beyond_mismatch, drift_shear, match,
/// cohesion, invariants; all have defaults. The moduli are left open.
template <int dim>
InformedParameters<dim> read_informed_parameters(Section& informed);
/// Reads the map for its faults alone.
void check_informed_parameters(Section& material, int dimension, Faults& faults);

}  // namespace polargrain::coupler
