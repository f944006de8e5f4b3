// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string>

#include "coupler/case/section.hpp"
#include "element/stage.hpp"

namespace polargrain::app {

/// A pressure, whose unit must be written: "100" of a laboratory is 100 kPa, and of a case 100 Pa.
double read_pressure(coupler::Section& section, const std::string& key, coupler::Limit limit);

/// Reads one stage: a named test (`test`) with its parameters, or components (`e22: -5 %`, `s11: hold`, ...). Calls
/// nothing of the section's finish(). @param extended the axial stress is the least before it
element::Stage read_stage(coupler::Section& section, element::Room room, bool extended = false);

}  // namespace polargrain::app
