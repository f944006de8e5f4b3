// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "app/calibrate/calibration.hpp"

namespace polargrain::app {

/// The curves at some values of the parameters.
struct Evaluation {
  std::vector<double> values;       ///< of the parameters
  double misfit = 0.0;              ///< mean square of the differences
  std::vector<double> differences;  ///< one a point, in errors
  std::string left_out;  ///< why the tests could not be run: all points count as missed; mostly empty
};

/// The answer of the tests for values of the parameters.
struct Answer {
  std::vector<double> differences;
  std::string left_out = {};
};

/// The least misfit with one parameter held.
struct ProfilePoint {
  std::size_t parameter = 0;   ///< that is held
  std::vector<double> values;  ///< of all parameters
  double misfit = 0.0;
};

/// The result of a calibration.
struct CalibrationResult {
  std::vector<Evaluation> record;  ///< in their order
  Evaluation best;
  std::string end;  ///< why the search ended
  bool converged = false;
  /// Places of the parameters between their bounds (Parameter::place_of), by linearising around the best ones: 95 %
  /// interval, and correlations. Infinite where the data say nothing.
  std::vector<double> half_width;
  Eigen::MatrixXd correlations;
  /// Directions in which the misfit is steep and flat, columns, and half the 95 % interval along each.
  Eigen::MatrixXd directions;
  std::vector<double> direction_half_width;
  /// For each parameter its places in rising order, the best one among them; empty: not asked for.
  std::vector<ProfilePoint> profile;
  double threshold = 0.0;  ///< misfit up to which a value of a parameter is within 95 %
};

/// Finds the parameters by BOBYQA (Powell 2009, of NLopt: no derivatives, bounds, content with some noise), then
/// linearises around them; where an evaluation for that is better than the best so far, around that one anew, twice at most.
/// The best is that of all evaluations but those of a profile. Where a profile is asked for, each parameter is then held at places around its best one, as far
/// as twice its interval, and the others are sought anew.
/// @param evaluate gives the differences of the tests for values of the parameters
/// @param known evaluations made before: taken instead of being made again
/// @param on_new called with each one that was made
CalibrationResult calibrate(const Calibration& calibration,
                            const std::function<Answer(const std::vector<double>&)>& evaluate,
                            const std::vector<Evaluation>& known,
                            const std::function<void(const Evaluation&)>& on_new);

}  // namespace polargrain::app
