// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string>
#include <vector>

#include "app/element/element_table.hpp"

namespace polargrain::app {

/// The four curves that an engineer looks at, as one HTML page without any other file: stress ratio and volume strain
/// against axial strain (shear stress and volume strain against shear strain where a test shears more than it
/// compresses), the path of q over p, and void ratio over p. With several specimens their mean and its interval too.
/// @param before further charts, HTML, above these
std::string element_page(const std::string& title, const std::vector<std::string>& columns,
                         const std::vector<ElementCurve>& curves, const ElementMean& mean,
                         const std::string& before = {});

}  // namespace polargrain::app
