// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string>

#include "app/remarks/scene.hpp"

namespace polargrain::app {

/// A case before it runs, as an HTML page: its mesh with supports, movements and loads, tables of them, the grains of each
/// packing, and the remarks. Lengths of arrows mean nothing; the tables have the values.
std::string case_picture(const Scene& scene, const Remarks& remarks);

}  // namespace polargrain::app
