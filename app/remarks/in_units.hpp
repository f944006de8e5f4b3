// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string>

namespace polargrain::app {

/// A pressure as people write it: "340 Pa", "50 kPa", "2.5 MPa". @param pressure Pa
std::string pascals(double pressure);
/// A length as people write it: "8 mm", "2.5 m". @param length m
std::string metres(double length);

}  // namespace polargrain::app
