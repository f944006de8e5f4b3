// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "fem/solver/tables_of.hpp"

namespace polargrain::app {

/// A warning of a load that goes there and back within the explicit steps of real time, which take its values at
/// their ends. Empty: no load does.
/// @param step s @param end of the run, s
template <int dim>
std::string missed_pulses(const fem::Problem<dim>& problem, double step, double end) {
  constexpr double kMissed = 0.35;  // a pulse of three steps has less, wherever they begin
  double missed = 0.0;
  for (const fem::TimeTable* const table : fem::tables_of(problem))
    missed = std::max(missed, table->share_missed_by_steps(step, end));
  if (!(missed > kMissed)) return "";
  return fmt::format(
      "a load comes and goes within explicit steps of {:.2g} s: its impulse is off by {:.2g} %; let it take {:.1g} s or more, "
      "at the same impulse",
      step, 100.0 * missed, 4.0 * step);
}

}  // namespace polargrain::app
