// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string_view>

namespace polargrain::app {

/// Style sheets and scripts of pages: built into the program by CMake from the files of this folder and from Chart.js.
std::string_view style_sheet();
std::string_view chart_library();
std::string_view chart_script();
std::string_view mesh_script();

}  // namespace polargrain::app
