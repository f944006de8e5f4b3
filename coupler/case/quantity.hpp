// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <optional>
#include <string>
#include <string_view>

namespace polargrain::coupler {

/// What a number in a case measures, and so which units may follow it.
enum class Dimension {
  number,
  length,
  pressure,
  angle,
  force,             ///< also a moment per thickness
  force_per_length,  ///< per thickness
  unit_weight,
  duration
};

/// "a pressure in Pa, or with one of the units Pa, kPa, MPa, GPa": for messages.
std::string expectation(Dimension dimension);

/// Reads "100 kPa", "1mm", "5e-4": a decimal number and, optionally, a unit of the dimension.
/// @returns the value in SI units (angles in rad); nothing when the text is anything else or not finite.
std::optional<double> parse_quantity(std::string_view text, Dimension dimension);

/// The factor to SI units of a unit of any dimension; nothing when it is none.
std::optional<double> unit_factor(std::string_view unit);

}  // namespace polargrain::coupler
