// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace polargrain::coupler {

/// The quantity that a number in a case measures, and so which units may follow it.
enum class Dimension {
  number,
  length,
  pressure,
  angle,
  force,  ///< also a moment per thickness
  moment,
  force_per_length,  ///< per thickness
  unit_weight,
  density,
  bedding,  ///< stress over a displacement, of an interface
  duration,
  flow,  ///< volume of water per area and time: a permeability, a flux
  rate   ///< a share per time
};

/// "a pressure in Pa, or with one of the units Pa, kPa, MPa, GPa": for messages.
std::string expectation(Dimension dimension);

/// Reads "100 kPa", "1mm", "5e-4": a decimal number and, optionally, a unit of the dimension.
/// @returns the value in SI units (angles in rad); nothing when the text is anything else or not finite.
std::optional<double> parse_quantity(std::string_view text, Dimension dimension);

/// Whether the text ends without a unit. @param text one that parse_quantity takes
bool is_plain_number(std::string_view text);
/// Of less without a unit kilopascals are meant most likely, Pa.
inline constexpr double kLeastPlainPressure = 1e3;

/// The largest magnitude that a quantity of the dimension may have, in SI units: far beyond soil, rock and diamond, so that
/// nothing larger can be meant.
double largest_of(Dimension dimension);

/// "Pa": the unit of a number written without one; empty for Dimension::number.
std::string_view si_unit(Dimension dimension);

/// The unit of any dimension but `flow` and `rate` that `text` begins with and that no letter or digit follows: the longest, so that "kN/m3" is
/// not taken for kN.
struct UnitAhead {
  std::size_t length;  ///< characters
  double factor;       ///< to SI units
  Dimension dimension;
};
std::optional<UnitAhead> unit_ahead(std::string_view text);

/// "m, mm, ...": all units that unit_ahead knows, for messages.
std::string all_units();

}  // namespace polargrain::coupler
