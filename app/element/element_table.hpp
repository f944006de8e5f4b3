// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "element/driver.hpp"

namespace polargrain::app {

/// The curve of one specimen: the columns of the CSV file (docs/element_tests.md), a row of numbers for each recorded row.
struct ElementCurve {
  std::string name;
  std::vector<std::vector<double>> rows;
  std::string failure;  ///< empty: the test came to its end
};

/// The names of the columns, with units where they have one (s11_Pa). @param fields of the material
std::vector<std::string> element_columns(element::Room room, const std::vector<std::string>& fields,
                                         bool has_void_ratio);

/// The values of these columns. @param void_ratio at the start of the test, for materials that do not report one
std::vector<double> element_values(const element::Row& row, element::Room room,
                                   const std::optional<double>& void_ratio);

/// Mean over the specimens, row by row, as far as at least two of them came.
struct ElementMean {
  std::vector<int> count;                       ///< of specimens, a row each
  std::vector<std::vector<double>> mean;        ///< rows of the columns
  std::vector<std::vector<double>> half_width;  ///< of the interval that holds the mean with 95 % (Student)
};

ElementMean mean_of(const std::vector<ElementCurve>& curves);

}  // namespace polargrain::app
