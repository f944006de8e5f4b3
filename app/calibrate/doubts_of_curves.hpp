// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string>
#include <vector>

#include "app/calibrate/calibration.hpp"

namespace polargrain::app {

/// Signs that the laboratory's table has other units or signs than the tests: values or places of another order, or values of
/// the opposite sign. A search would go on to its end and say nothing. @param columns of each test
/// @param curves of each test, packing, row, column, at the start of the search
/// @returns a sentence with its remedy for each
std::vector<std::string> doubts_of_curves(
    const Calibration& calibration, const std::vector<std::vector<std::string>>& columns,
    const std::vector<std::vector<std::vector<std::vector<double>>>>& curves);

}  // namespace polargrain::app
