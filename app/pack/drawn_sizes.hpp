// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string>

#include "common/packing.hpp"
#include "common/packing_specification.hpp"

namespace polargrain::app {

/// Few grains follow a grading curve badly where a few large ones hold much of the mass. @returns a remark with its remedy where
/// the mass that passes one of the sieves is off by more than 5 % of all; empty otherwise, and of other laws
std::string remark_on_drawn_sizes(const PackingSpecification& asked, const Packing& packing);

}  // namespace polargrain::app
