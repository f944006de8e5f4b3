// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Parameters of the contact laws of Li and Chu, as the engine's `property/global peratomtypepair`. Each is
// checked against its range; the engine's message names it.
#include <global_properties.h>

namespace polargrain::dem {

inline constexpr double kLargest = 1e300;

#define POLARGRAIN_PAIR_PROPERTY(function, name, lowest, highest)                                  \
  inline MatrixProperty* function(PropertyRegistry& registry, const char* caller, bool) {          \
    return MODEL_PARAMS::createPerTypePairProperty(registry, name, caller, true, lowest, highest); \
  }
POLARGRAIN_PAIR_PROPERTY(sliding_friction, "coefficientFriction", 0.0, kLargest)
POLARGRAIN_PAIR_PROPERTY(rolling_force_friction, "coefficientRollingFrictionForce", 0.0, kLargest)
POLARGRAIN_PAIR_PROPERTY(rolling_force_stiffness, "rollingFrictionForceStiffnessRatio", 0.0, kLargest)
POLARGRAIN_PAIR_PROPERTY(rolling_force_damping, "rollingFrictionForceDampingRatio", 0.0, kLargest)
POLARGRAIN_PAIR_PROPERTY(rolling_friction, "coefficientRollingFriction", 0.0, kLargest)
POLARGRAIN_PAIR_PROPERTY(rolling_stiffness, "rollingStiffnessRatio", 0.0, kLargest)
POLARGRAIN_PAIR_PROPERTY(rolling_damping, "rollingDampingRatio", 0.0, kLargest)
#undef POLARGRAIN_PAIR_PROPERTY

/// Registers a parameter under its own name and fetches its table by type pair.
inline void connect(PropertyRegistry& registry, const char* name,
                    MatrixProperty* (*create)(PropertyRegistry&, const char*, bool), double**& target,
                    const char* model) {
  registry.registerProperty(name, create);
  registry.connect(name, target, model);
}

}  // namespace polargrain::dem
