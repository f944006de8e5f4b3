// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <array>
#include <functional>
#include <string>
#include <vector>

#include "coupler/case/case.hpp"
#include "coupler/case/quantity.hpp"

namespace polargrain::app {

/// Exponents of newton, metre and second.
using Powers = std::array<int, 3>;

Powers powers_of(coupler::Dimension dimension);
/// @param monitor a reaction or a displacement
Powers powers_of(const coupler::Monitor& monitor, int dimension = 2);
/// "N/m", "Pa", "m", "1" and the like.
std::string text_of(const Powers& powers);

/// A number in a formula.
struct FormulaNumber {
  std::string text;  ///< with its unit
  double value;      ///< SI
  bool has_unit;
  bool is_one;  ///< one of its unit: 1 m, 1 kPa, which converts
  coupler::Dimension dimension;
};

/// The findings on the units of a formula.
struct FormulaUnits {
  Powers result{};
  std::vector<FormulaNumber> numbers;
  std::string clash;  ///< two summands of different dimension, in words; empty where the units agree
};

/// @param formula one that coupler::Expression takes @param powers of a name in it
FormulaUnits units_of_formula(const std::string& formula,
                              const std::function<Powers(const std::string&)>& powers);

}  // namespace polargrain::app
