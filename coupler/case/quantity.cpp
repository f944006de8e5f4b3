// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/case/quantity.hpp"

#include <fmt/format.h>

#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <numbers>

namespace polargrain::coupler {
namespace {

constexpr double kDay = 86400.0;         // s
constexpr double kYear = 365.25 * kDay;  // s

struct Unit {
  Dimension dimension;
  std::string_view name;
  double factor;
  bool listed = true;  ///< in messages; other names of a unit are taken and not listed
};

constexpr std::array<Unit, 52> kUnits{{
    {Dimension::number, "%", 1e-2},
    {Dimension::length, "m", 1.0},
    {Dimension::length, "mm", 1e-3},
    {Dimension::length, "cm", 1e-2},
    {Dimension::length, "um", 1e-6},
    {Dimension::length, "km", 1e3},
    {Dimension::pressure, "Pa", 1.0},
    {Dimension::pressure, "kPa", 1e3},
    {Dimension::pressure, "MPa", 1e6},
    {Dimension::pressure, "GPa", 1e9},
    {Dimension::pressure, "N/m2", 1.0, false},
    {Dimension::pressure, "kN/m2", 1e3, false},
    {Dimension::pressure, "MN/m2", 1e6, false},
    {Dimension::pressure, "N/mm2", 1e6, false},
    {Dimension::angle, "rad", 1.0},
    {Dimension::angle, "deg", std::numbers::pi / 180.0},
    {Dimension::angle, "mrad", 1e-3},
    {Dimension::force, "N", 1.0},
    {Dimension::force, "kN", 1e3},
    {Dimension::moment, "Nm", 1.0},
    {Dimension::force, "MN", 1e6, false},
    {Dimension::force, "Nm/m", 1.0, false},  // of a moment per thickness
    {Dimension::force, "kNm/m", 1e3, false},
    {Dimension::force, "MNm/m", 1e6, false},
    {Dimension::moment, "kNm", 1e3},
    {Dimension::moment, "MNm", 1e6, false},
    {Dimension::moment, "kNm2/m", 1e3, false},  // of a bending stiffness per thickness
    {Dimension::moment, "MNm2/m", 1e6, false},
    {Dimension::force_per_length, "N/m", 1.0},
    {Dimension::force_per_length, "kN/m", 1e3},
    {Dimension::force_per_length, "MN/m", 1e6},
    {Dimension::unit_weight, "N/m3", 1.0},
    {Dimension::unit_weight, "kN/m3", 1e3},
    {Dimension::unit_weight, "MN/m3", 1e6},
    {Dimension::density, "kg/m3", 1.0},
    {Dimension::density, "t/m3", 1e3},
    {Dimension::bedding, "Pa/m", 1.0},
    {Dimension::bedding, "kPa/m", 1e3},
    {Dimension::bedding, "MPa/m", 1e6},
    {Dimension::bedding, "GPa/m", 1e9},
    {Dimension::bedding, "MN/m3", 1e6, false},
    {Dimension::duration, "s", 1.0},
    {Dimension::duration, "min", 60.0},
    {Dimension::duration, "h", 3600.0},
    {Dimension::duration, "d", kDay},
    {Dimension::duration, "a", kYear},
    {Dimension::flow, "m/s", 1.0},
    {Dimension::flow, "cm/s", 1e-2},
    {Dimension::flow, "mm/s", 1e-3},
    {Dimension::flow, "m/d", 1.0 / kDay},
    {Dimension::flow, "m/a", 1.0 / kYear},
    {Dimension::rate, "1/s", 1.0},
}};

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// A formula divides by a monitor named d or s.
bool is_of_formulas(const Unit& unit) {
  return unit.dimension != Dimension::flow && unit.dimension != Dimension::rate;
}

std::string units_of(Dimension dimension) {
  std::string list;
  for (const Unit& unit : kUnits) {
    if (unit.dimension != dimension || !unit.listed) continue;
    if (!list.empty()) list += ", ";
    list += unit.name;
  }
  return list;
}

}  // namespace

std::string expectation(Dimension dimension) {
  const std::string units = units_of(dimension);
  switch (dimension) {
    case Dimension::length:
      return "a length in m, or with one of the units " + units;
    case Dimension::pressure:
      return "a pressure in Pa, or with one of the units " + units;
    case Dimension::angle:
      return "an angle in rad, or with one of the units " + units;
    case Dimension::force:
      return "a force in N, or with one of the units " + units;
    case Dimension::moment:
      return "a moment in N m, or with one of the units " + units;
    case Dimension::force_per_length:
      return "a force per thickness in N/m, or with one of the units " + units;
    case Dimension::bedding:
      return "a stress per displacement in Pa/m, or with one of the units " + units;
    case Dimension::duration:
      return "a time in s, or with one of the units " + units;
    case Dimension::flow:
      return "a permeability or flux in m/s, or with one of the units " + units;
    case Dimension::unit_weight:
      return "a force per volume in N/m3, or with one of the units " + units;
    case Dimension::density:
      return "a density in kg/m3, or with one of the units " + units;
    case Dimension::rate:
      return "a rate in 1/s";
    case Dimension::number:
      break;
  }
  return "a number without a unit (% is allowed)";
}

std::optional<double> parse_quantity(std::string_view text, Dimension dimension) {
  text = trimmed(text);
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || !std::isfinite(value)) return std::nullopt;
  const std::string_view unit = trimmed(text.substr(static_cast<std::size_t>(end - text.data())));
  if (unit.empty()) return value;
  for (const Unit& known : kUnits) {
    if (known.dimension != dimension || known.name != unit) continue;
    const double in_si = value * known.factor;
    return std::isfinite(in_si) ? std::optional(in_si) : std::nullopt;
  }
  return std::nullopt;
}

bool is_plain_number(std::string_view text) {
  text = trimmed(text);
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

double largest_of(Dimension dimension) {
  switch (dimension) {
    case Dimension::length:
      return 1e7;
    case Dimension::pressure:
      return 1e14;
    case Dimension::unit_weight:
      return 1e11;
    default:
      return 1e18;
  }
}

std::string_view si_unit(Dimension dimension) {
  for (const Unit& unit : kUnits) {
    if (unit.dimension == dimension && unit.factor == 1.0) return unit.name;
  }
  return {};
}

std::string all_units() {
  std::string list;
  for (const Unit& unit : kUnits) {
    if (!unit.listed || !is_of_formulas(unit)) continue;
    if (!list.empty()) list += ", ";
    list += unit.name;
  }
  return list;
}

std::optional<UnitAhead> unit_ahead(std::string_view text) {
  std::optional<UnitAhead> longest;
  for (const Unit& unit : kUnits) {
    if (!is_of_formulas(unit)) continue;
    if (!text.starts_with(unit.name) || (longest && longest->length >= unit.name.size())) continue;
    const char next = text.size() > unit.name.size() ? text[unit.name.size()] : ' ';
    const bool goes_on = std::isalnum(static_cast<unsigned char>(next)) != 0 || next == '_';
    if (unit.name == "%" || !goes_on) longest = UnitAhead{unit.name.size(), unit.factor, unit.dimension};
  }
  return longest;
}

}  // namespace polargrain::coupler
