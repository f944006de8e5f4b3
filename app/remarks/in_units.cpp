// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/remarks/in_units.hpp"

#include <fmt/format.h>

#include <cmath>

namespace polargrain::app {

std::string pascals(double pressure) {
  if (std::abs(pressure) < 1e3 && pressure != 0.0) return fmt::format("{:.3g} Pa", pressure);
  return std::abs(pressure) < 1e6 ? fmt::format("{:.4g} kPa", 1e-3 * pressure)
                                  : fmt::format("{:.4g} MPa", 1e-6 * pressure);
}

std::string metres(double length) {
  return length < 1.0 ? fmt::format("{:.3g} mm", 1e3 * length) : fmt::format("{:.3g} m", length);
}

}  // namespace polargrain::app
