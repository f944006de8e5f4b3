// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "coupler/adaptivity/adaptive_material.hpp"
#include "coupler/case/section.hpp"

namespace polargrain::coupler {

/// Reads the map `adaptive` of a material with cells: tolerance, reference_pressure, audit and seed, all with defaults.
AdaptivityOptions read_adaptivity_options(Section& material, Faults& faults);
/// Reads the map for its faults alone.
void check_adaptivity_options(Section& material, Faults& faults);

}  // namespace polargrain::coupler
