// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string>

namespace polargrain {

/// Model of this machine's processor as its system names it; "unknown" when it does not.
std::string processor_model();

}  // namespace polargrain
