// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <vector>

#include "fem/solver/time_table.hpp"

namespace polargrain::app {

/// The shortest way of values there and back: twice the time that they are beyond half of it, as long as a triangle lasts, and a
/// period of a sine. Swings of less than 45 % of the range of all values are ripples.
/// @param values straight between times that do not fall @returns 0: they do not go there and back
double shortest_pulse(const std::vector<fem::TimeTable::Point>& values);

/// Values of a load up to the end of a run.
std::vector<fem::TimeTable::Point> values_until(const fem::TimeTable& load, double end);

/// Speeds of a given displacement up to the end of a run; stress waves are as long as these pulses.
std::vector<fem::TimeTable::Point> speeds_until(const fem::TimeTable& displacement, double end);

}  // namespace polargrain::app
