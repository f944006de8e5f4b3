// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "tests/support/spread_column.hpp"

/// The softening column in rows of explicit steps.
namespace polargrain::testing::spread_column {

inline constexpr int kElements = 20, kSteps = 2000;
inline constexpr double
    kFirst = 0.3e-3,
    kFaster = 1.6;  // growth of the displacement of the top in the first row, and from row to row

/// Ends that hold the slip: the waves of a driven plate would begin one there.
inline Problem<2> column_of(Law (*law)(const ElastoplasticParameters<2>&)) {
  Problem<2> problem = softening_column(kElements, kWidth, 0.5 * kHeight, law);
  for (const char* field : kSpreadFields)
    for (const char* end : {"bottom", "top"})
      problem.prescribed_fields.push_back({field, end, TimeTable::constant(0.0)});
  return problem;
}

inline double displacement_of(int rows) {
  return kFirst * (std::pow(kFaster, rows) - 1.0) / (kFaster - 1.0);
}

inline StepReport row_of(Solver<2>& solver, int row, int steps = kSteps) {
  return solver.advance_explicit(displacement_of(row + 1), steps,
                                 {.speed_before = row == 0 ? 1.0 : 1.0 / kFaster});
}

}  // namespace polargrain::testing::spread_column
