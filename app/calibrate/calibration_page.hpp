// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string>
#include <vector>

#include "app/calibrate/calibrate.hpp"
#include "app/element/run_element.hpp"

namespace polargrain::app {

/// The parameters with their intervals, correlations and the directions that the data tell least of, as text.
std::string calibration_summary(const Calibration& calibration, const CalibrationResult& result);

/// The same as a page without any other file, with the curves of the best parameters over the laboratory's, and the misfit
/// over the evaluations. @param best results of the tests with the best parameters
std::string calibration_page(const Calibration& calibration, const CalibrationResult& result,
                             const std::vector<ElementResult>& best);

}  // namespace polargrain::app
