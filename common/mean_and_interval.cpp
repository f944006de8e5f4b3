// SPDX-License-Identifier: GPL-2.0-or-later
#include "common/mean_and_interval.hpp"

#include <array>
#include <cmath>
#include <limits>

namespace polargrain {

double student_95(int count) {
  // 97.5 % quantiles of Student's t for 1 to 30 degrees of freedom (Fisher and Yates, table III).
  constexpr std::array<double, 30> kTable{12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306,
                                          2.262,  2.228, 2.201, 2.179, 2.160, 2.145, 2.131, 2.120,
                                          2.110,  2.101, 2.093, 2.086, 2.080, 2.074, 2.069, 2.064,
                                          2.060,  2.056, 2.052, 2.048, 2.045, 2.042};
  const int freedom = count - 1;
  // Beyond the table: Cornish and Fisher's first term, right to 1e-3.
  return freedom <= 30 ? kTable[static_cast<std::size_t>(freedom - 1)] : 1.960 + 2.372 / freedom;
}

std::pair<double, double> mean_and_interval(const std::vector<double>& values) {
  const auto count = static_cast<double>(values.size());
  double mean = 0.0;
  for (const double value : values) mean += value / count;
  if (values.size() < 2) return {mean, std::numeric_limits<double>::quiet_NaN()};
  double squares = 0.0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return {mean, student_95(static_cast<int>(values.size())) * std::sqrt(squares / (count - 1.0) / count)};
}

}  // namespace polargrain
