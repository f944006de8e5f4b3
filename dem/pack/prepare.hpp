// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <functional>

#include "common/packing_specification.hpp"

namespace polargrain::dem {

/// Makes a packing: places the grains loosely (place_grains) and compresses their box with the engine until
/// both axes carry the pressure asked for and the grains are at rest. The box follows the error of the stress
/// of each axis, no faster than the inertial number allows, and stays orthogonal. The same specification
/// gives the same bits.
///
/// Without friction no tangential forces remain and the packing is grains and box; with friction it keeps the
/// engine's state too. To be called in a process started with start_engine_process(); engine errors end it.
///
/// @param progress called now and then; may be empty
/// @throws RunError when the packing does not come to rest within the steps allowed, or when no friction
/// gives the void ratio asked for; the message says what was reached.
PreparedPacking prepare_packing(const PackingSpecification& specification,
                                const std::function<void(const PackingReached&)>& progress);

}  // namespace polargrain::dem
