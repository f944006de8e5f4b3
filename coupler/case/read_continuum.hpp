// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "coupler/case/parts.hpp"

namespace polargrain::coupler {

/// Reads `continuum`: a kind, or a map of kind and spread; into the problem and Case::spread. Behind the mesh.
/// @param entry null: a Cosserat continuum without spread slips
void read_continuum(const Entry* entry, const Entry& document, CaseParts& parts);

/// Behind the materials: each must take spread slips or be without slips, and one must have them.
void check_spread_slips(const Entry& entry, CaseParts& parts);

}  // namespace polargrain::coupler
