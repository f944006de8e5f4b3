// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <functional>

#include "common/packing_specification.hpp"

namespace polargrain::dem {

/// Makes a packing: places the grains loosely (place_grains) and compresses their box with the engine until
/// all axes carry the pressure asked for and the grains are at rest. The box follows the error of the stress
/// of each axis, no faster than the inertial number allows, and is sheared until it carries no shear stress.
/// The same specification gives the same bits.
///
/// A void ratio is looked for by bisection on the friction; when no friction hits it, because
/// packings of few grains jump from one void ratio to the next, the grains are placed anew.
///
/// Without friction no tangential forces remain and the packing is grains and box; with friction it keeps the
/// engine's state too. To be called in a process started with start_engine_process(); engine errors end it.
///
/// @param progress called now and then; may be empty
/// @throws RunError when the packing does not come to rest within the steps allowed, or when the void ratio
/// asked for is out of reach or was not hit; the message gives the value reached.
PreparedPacking prepare_packing(const PackingSpecification& specification,
                                const std::function<void(const PackingReached&)>& progress);

/// Brings a packing as it is, grains and box, to rest under the script and the pressure of the specification,
/// with the script's own friction. Tangential springs go on where the script's contact models keep as many
/// values a contact as those of the packing's state; else they start anew. @throws RunError as
/// prepare_packing
PreparedPacking settle_packing(const PackingSpecification& specification, const PreparedPacking& packing,
                               const std::function<void(const PackingReached&)>& progress);

}  // namespace polargrain::dem
