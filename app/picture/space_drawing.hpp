// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string>
#include <vector>

#include "app/picture/conditions.hpp"
#include "app/remarks/outline.hpp"
#include "app/remarks/scene.hpp"

namespace polargrain::app {

/// A mesh in space with all its conditions, as two figures of a page: from the front, right and above, and from behind, left and
/// below. x3 points up.
std::string space_drawing(const fem::Mesh<3>& mesh, const std::vector<SceneRegion>& regions,
                          const std::vector<PlaceConditions<3>>& places);

}  // namespace polargrain::app
