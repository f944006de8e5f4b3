// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace LAMMPS_NS {
class LAMMPS;
}

namespace polargrain::dem {

/// Lets the scripts of an engine ask for the kernels of this loop: under `suffix fast` they compute the contact forces of
/// `pair_style gran`, whatever else the scene does. Called before the script is read. Cells choose their loop otherwise.
void offer_fast_pass(LAMMPS_NS::LAMMPS& lammps);

}  // namespace polargrain::dem
