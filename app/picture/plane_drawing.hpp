// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string>
#include <vector>

#include "app/picture/conditions.hpp"
#include "app/remarks/scene.hpp"

namespace polargrain::app {

/// A plane mesh with all its conditions, as a figure of a page.
std::string plane_drawing(const Scene& scene, const std::vector<PlaceConditions<2>>& places);

}  // namespace polargrain::app
