// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <memory>
#include <set>
#include <string>

#include "common/cell.hpp"
#include "common/increment.hpp"
#include "common/packing_specification.hpp"

namespace polargrain::testing {

/// Stands in for the grain engine where the coupler is tested: an isotropic linear law whose answers are
/// known in closed form, around an initial stress of -100 kPa. Behaves as its script says, one command a
/// line:
///
///     young E                Young's modulus in Pa (Poisson's ratio is 0.25); 100e6 without this line
///     young_of_mass E        the same times the mass of the first grain of the packing
///     sleep_milliseconds n   takes so long for an evaluation, with signs of life
///     softening f          divides the stiffness by 1 + f |s11 - s22| / 100 kPa of the stress reached
///     tries 1                does what no engine should, and prints what it was refused (see tries.cpp)
///     state_bytes n          makes states of so many bytes instead of 48
///     fail_beyond e          answers Quality::failed with step factor 0.5 when an entry of the increment
///     exceeds e die_beyond e           then prints what LIGGGHTS prints when grains are lost, and ends the
///     process hang_beyond e          then hangs for ever refuse_beyond e        then throws
///
///     variable NAME index VALUE   puts the value in the place of ${NAME} in later lines
///
/// An unknown command ends the process as LIGGGHTS does.
std::unique_ptr<CellService> make_fake_engine(const CellDefinition& definition);

/// The commands of its scripts.
const std::set<std::string>& fake_commands();
/// Its StateCheck: the size that the script says, and finite numbers.
std::string fake_state_fault(const CellDefinition& definition, const State& state);

/// Stress after an increment from the packing, for the default modulus.
Vector7 fake_stress(const Increment<2>& increment);
Eigen::Matrix3d fake_stress(const CellIncrement& increment);

/// A packing of one grain, enough for a fake.
Packing fake_packing();

/// A packing of as many discs in rows as the specification says, each of the mass 1 + (seed - 2) / 100 +
/// 1 / grains. The script command young_of_mass turns that into a stiffness.
/// Its void ratio is 0.5 and 0.4 times the friction that it is made with.
PreparedPacking make_fake_packing(const PackingSpecification& specification);
/// The same grains; the void ratio is that of the friction in a line `variable friction index VALUE` of the script, or
/// stays without such a line.
PreparedPacking settle_fake_packing(const PackingSpecification& specification,
                                    const PreparedPacking& packing);

/// A definition with that packing.
CellDefinition fake_definition(const std::string& script);

}  // namespace polargrain::testing
