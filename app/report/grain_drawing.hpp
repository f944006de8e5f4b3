// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string>

#include "common/grain_view.hpp"

namespace polargrain::app {

/// The grains of a cell as a figure of a page, seen along e_3: their images in the box, coloured by their rotation about e_3
/// (blue clockwise, red counter-clockwise), and the contacts as lines as thick as their normal force. Below stands the
/// meaning of colours and lines.
/// @param name of the drawing within the page, unlike others @param title text, not HTML
std::string grain_figure(const GrainView& view, const std::string& name, const std::string& title);

}  // namespace polargrain::app
