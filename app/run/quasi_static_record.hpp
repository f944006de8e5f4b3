// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/run/summary.hpp"

namespace polargrain::app {

/// A measure of how far explicit steps were from equilibrium (fem::QuasiStatic), over the steps of a run.
struct QuasiStaticMeasure {
  std::string name;        ///< its column in history.csv
  std::string meaning;     ///< in words
  double tolerance = 0.0;  ///< beyond it a remark is made
  double median = 0.0;     ///< over the steps
  double largest = 0.0;    ///< of all steps
  int worst_step = 0;      ///< that has the largest
  int steps_beyond = 0;    ///< beyond the tolerance
  int steps = 0;           ///< explicit ones of the history
};

/// The estimated error of the reactions first, then all that it comes from and what else is watched. Empty for a run
/// without explicit steps.
std::vector<QuasiStaticMeasure> quasi_static_measures(const coupler::Case& the_case, const RunRecord& record);

/// The same for summary.json; null for a run without explicit steps.
nlohmann::ordered_json quasi_static_figures(const coupler::Case& the_case, const RunRecord& record);

/// The same as lines under the table of a run; empty for a run without explicit steps.
std::string quasi_static_text(const coupler::Case& the_case, const RunRecord& record);

/// Measures beyond their tolerance, a sentence each with its remedy. For the log and the user.
std::vector<std::string> quasi_static_remarks(const coupler::Case& the_case, const RunRecord& record);

}  // namespace polargrain::app
