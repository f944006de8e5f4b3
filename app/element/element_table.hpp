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

/// The choices that decide which columns a table has. Titles and values are both made from it.
struct TableForm {
  element::Room room = element::Room::discs;
  std::optional<double> void_ratio;  ///< at the start of the test, for materials that do not report one
  /// Some stage drives a shear. Axis and layers then share the principal stresses, and which of the two normal stresses is larger is
  /// an accident of the packing: q gets no sign.
  bool drives_shear = false;
};

/// The names of the columns, with units where they have one (s11_Pa). @param fields of the material
std::vector<std::string> element_columns(const TableForm& form, const std::vector<std::string>& fields);

/// The values of these columns.
std::vector<double> element_values(const TableForm& form, const element::Row& row);

/// Mean over the specimens, row by row, as far as at least two of them came.
struct ElementMean {
  std::vector<int> count;                       ///< of specimens, a row each
  std::vector<std::vector<double>> mean;        ///< rows of the columns
  std::vector<std::vector<double>> half_width;  ///< of the interval that holds the mean with 95 % (Student)
};

ElementMean mean_of(const std::vector<ElementCurve>& curves);

}  // namespace polargrain::app
