// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/points/cell_point.hpp"

#include "common/record_table.hpp"

namespace polargrain::coupler {

CellResponse CellPoint::evaluate(const CellIncrement& increment) {
  if (increment.displacement_gradient.isZero(0.0))
    trial_ = committed_;  // nothing happens to its grains
  else
    trial_ = ask_({committed_.state, increment});
  return trial_.response;
}

std::vector<std::string> CellPoint::field_names() const {
  return names_of_columns<CellDiagnostics>();
}

std::vector<double> CellPoint::fields() const {
  return values_of(committed_.diagnostics);
}

}  // namespace polargrain::coupler
