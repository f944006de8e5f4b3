// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "coupler/adaptivity/adaptive_material.hpp"
#include "coupler/case/section.hpp"

namespace polargrain::coupler {

/// Reads tolerance, reference_pressure, audit and seed of `adaptive`; all have defaults. `cell` and `informed` read
/// them too and make no use of them, so that a case changes from one to the other by one word.
AdaptivityOptions read_adaptivity_options(Section& section);

}  // namespace polargrain::coupler
