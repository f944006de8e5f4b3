// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "app/remarks/scene.hpp"

namespace polargrain::app {

/// The largest stress that loads, weight and the stress of laws at time zero bring, Pa; 0 without them.
double stress_scale(const Scene& scene);

}  // namespace polargrain::app
