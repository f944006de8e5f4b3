// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string>

#include "common/packing.hpp"

namespace polargrain::app {

/// The grains of a packing as a figure of a page, in their box with their periodic images, seen along e_3.
/// @param name of the drawing within the page, unlike others @param title text, not HTML
std::string packing_figure(const Packing& packing, const std::string& name, const std::string& title);

}  // namespace polargrain::app
