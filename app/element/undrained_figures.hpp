// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string>

#include "app/element/run_element.hpp"

namespace polargrain::app {

/// The figures of the undrained stages of a curve, pressures in Pa: extremes over all of them.
struct UndrainedFigures {
  bool is_undrained = false;
  double largest_pore_pressure = 0.0;  ///< the start of a stage counts too
  double least_mean_stress = 0.0;      ///< effective; the start of a stage counts too
  double strain_at_least = 0.0;        ///< axial (or shear) strain there
  /// Phase transformation: the mean stress falls, then rises again by more than a hundredth of its start. Mobilised angle there
  /// in the first stage that turns, degrees; NaN without one.
  double transformation_angle = 0.0;
  /// Extremes that the first row of a stage has. They lie somewhere before its second row, and more rows would show another value.
  bool largest_in_first_row = false;
  bool least_in_first_row = false;
  bool flows = false;  ///< less than a hundredth of the mean stress at the start of a stage is left
};

UndrainedFigures undrained_figures(const ElementResult& result, const ElementCurve& curve);

/// For the terminal, the specimens, their mean and its 95 % interval; empty: no test is undrained.
std::string undrained_summary(const ElementResult& result);

}  // namespace polargrain::app
