// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <utility>
#include <vector>

namespace polargrain {

/// Half the width of the interval of the mean of normally distributed values with 95 %, in standard deviations of it.
/// @param count of values, at least 2
double student_95(int count);

/// Mean and half the 95 % interval (Student) of values; the interval is not-a-number for one value.
std::pair<double, double> mean_and_interval(const std::vector<double>& values);

}  // namespace polargrain
