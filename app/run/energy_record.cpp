// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/run/energy_record.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace polargrain::app {
namespace {

double largest_error(const RunRecord& record) {
  double largest = 0.0;
  for (const CommittedStep& step : record.steps) largest = std::max(largest, step.report.energies.error());
  return largest;
}

fem::Energies last(const RunRecord& record) {
  return record.steps.empty() ? fem::Energies{} : record.steps.back().report.energies;
}

}  // namespace

nlohmann::ordered_json energy_figures(const RunRecord& record) {
  const fem::Energies now = last(record);
  return {{"external", now.external}, {"internal", now.internal}, {"kinetic", now.kinetic},
          {"damped", now.damped},     {"absorbed", now.absorbed}, {"largest_error", largest_error(record)}};
}

std::string energy_text(const RunRecord& record) {
  const fem::Energies now = last(record);
  return fmt::format(
      "energy (J, in the plane per m): {:.4g} by loads and supports, of it {:.4g} in the stresses, {:.4g} kinetic, {:.4g} "
      "damped, {:.4g} out through quiet boundaries; largest error {:.2g} %\n",
      now.external, now.internal, now.kinetic, now.damped, now.absorbed, 100.0 * largest_error(record));
}

}  // namespace polargrain::app
