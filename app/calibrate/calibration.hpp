// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/element/read_specification.hpp"
#include "app/pack/made_packings.hpp"

namespace polargrain::app {

/// An unknown: a variable of the script. The search works on its logarithm, unless it is linear.
struct Parameter {
  std::string name;
  double low = 0.0;
  double high = 1.0;
  double start = 0.5;
  bool linear = false;

  /// Where between its bounds a value lies, 0 to 1, and back.
  [[nodiscard]] double place_of(double value) const;
  [[nodiscard]] double value_at(double place) const;
};

/// One number of the laboratory that the tests are to give.
struct TargetPoint {
  std::size_t test = 0;  ///< which of the tests
  std::string column;    ///< of its curve
  enum class Where { along, largest, last } where = Where::along;
  int stage = 0;      ///< the only one that counts; 0: all after the consolidation
  int end_stage = 1;  ///< the last that counts, and its last row: a test that broke off does not come there
  int end_row = 0;
  std::string along;  ///< column that says where
  double at = 0.0;    ///< value of that column
  double value = 0.0;
  double error = 1.0;  ///< standard deviation of its reading
  /// Of `largest`: a negative value (a stress: tension is positive) means the most negative row, the mirror of the others.
  [[nodiscard]] double sign_of_largest() const { return value < 0.0 ? -1.0 : 1.0; }
};

/// A calibration as a specification asks for it, checked (docs/element_tests.md).
struct Calibration {
  std::string title;
  std::vector<Parameter> parameters;
  std::vector<std::string> test_names;
  std::vector<ElementSpecification> tests;
  std::vector<TargetPoint> points;
  int evaluations = 100;         ///< most of a search
  double tolerance = 0.005;      ///< of a search: change of the places of the parameters
  double difference = 0.05;      ///< of these places, for the derivatives at the end
  int profile = 0;               ///< places of each parameter at which the others are sought anew
  int profile_evaluations = 15;  ///< most of each of these searches
  std::string identity;          ///< of everything that decides results
};

/// @param laboratory CSV file with the curves @param packings_of of tests whose packings are to be made @throws InputError with all faults
Calibration read_calibration(const std::filesystem::path& laboratory, const std::filesystem::path& file,
                             const std::vector<std::string>& settings, const ScriptRules& scripts,
                             const PackingsOf& packings_of);

/// The value that a test has at a point; nothing where it does not come there, nor at the end (or for a largest value that
/// is the last) of a test that broke off. @param columns of the test
/// @param rows of one packing
std::optional<double> value_of(const TargetPoint& point, const std::vector<std::string>& columns,
                               const std::vector<std::vector<double>>& rows);

/// The differences of the curves from the points, over their errors: of the mean over the packings. A packing that did
/// not come as far as a point counts as `kMissed` errors there.
inline constexpr double kMissed = 10.0;
std::vector<double> differences(const std::vector<TargetPoint>& points,
                                const std::vector<std::vector<std::string>>& columns,
                                const std::vector<std::vector<std::vector<std::vector<double>>>>& curves);

/// The first point that a packing comes to more than once, with values further apart than its error. Nothing: all say which
/// value is meant.
std::optional<std::size_t> point_passed_again(
    const std::vector<TargetPoint>& points, const std::vector<std::vector<std::string>>& columns,
    const std::vector<std::vector<std::vector<std::vector<double>>>>& curves);
/// The remedy in words.
std::string told_as_passed_again(const Calibration& calibration, const TargetPoint& point);

/// The points that one of the packings or more did not come as far as: their numbers in `points`.
std::vector<std::size_t> missed_points(
    const std::vector<TargetPoint>& points, const std::vector<std::vector<std::string>>& columns,
    const std::vector<std::vector<std::vector<std::vector<double>>>>& curves);

}  // namespace polargrain::app
