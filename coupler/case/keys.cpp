// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/case/keys.hpp"

#include <fmt/format.h>

namespace polargrain::coupler {

std::string default_text(double value, Dimension dimension) {
  if (dimension == Dimension::duration)
    return value >= 60.0 && std::fmod(value, 60.0) == 0.0 ? fmt::format("{:g} min", value / 60.0)
                                                          : fmt::format("{:g} s", value);
  const std::string unit(si_unit(dimension));
  const std::string behind = unit.empty() ? "" : " " + unit;
  constexpr double kSmall = 0.01;
  if (value == 0.0 || std::abs(value) >= kSmall) return fmt::format("{:g}{}", value, behind);
  const double exponent = std::floor(std::log10(std::abs(value)));
  return fmt::format("{:g}e{:g}{}", value / std::pow(10.0, exponent), exponent, behind);
}

std::string row_of_key(const Key& key, const std::string& otherwise) {
  return fmt::format("| `{}` | {} | {} |\n", key.name, otherwise, key.meaning);
}

}  // namespace polargrain::coupler
