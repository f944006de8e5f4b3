// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/material/piecewise_linear.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/error.hpp"

namespace polargrain::fem {

PiecewiseLinear::PiecewiseLinear(std::vector<Knot> knots) : knots_(std::move(knots)) {
  if (knots_.empty()) {
    throw InputError(Fault{"", 0, "a table over gamma_p needs at least one row [gamma_p, value]"});
  }
  for (std::size_t i = 0; i < knots_.size(); ++i) {
    if (!std::isfinite(knots_[i].gamma_p) || !std::isfinite(knots_[i].value)) {
      throw InputError(
          Fault{"", 0, fmt::format("row {} of a table over gamma_p is not a finite number", i + 1)});
    }
    if (i > 0 && knots_[i].gamma_p <= knots_[i - 1].gamma_p) {
      throw InputError(
          Fault{"", 0,
                fmt::format("row {} of a table over gamma_p has gamma_p = {}, which must be above "
                            "{} of the row before it; sort the rows",
                            i + 1, knots_[i].gamma_p, knots_[i - 1].gamma_p)});
    }
  }
}

PiecewiseLinear PiecewiseLinear::ramp(double start, double end, double range) {
  if (!(range > 0.0) || !std::isfinite(range)) {
    throw InputError(Fault{"", 0,
                           fmt::format("the range of gamma_p over which a strength changes is {}; it must be "
                                       "positive (for a constant strength give one value)",
                                       range)});
  }
  return PiecewiseLinear({{0.0, start}, {range, end}});
}

std::vector<double> merged_knots(const std::vector<const PiecewiseLinear*>& functions) {
  std::vector<double> gammas;
  for (const PiecewiseLinear* function : functions) {
    for (const PiecewiseLinear::Knot& knot : function->knots()) {
      gammas.push_back(knot.gamma_p);
    }
  }
  std::ranges::sort(gammas);
  const auto repeated = std::ranges::unique(gammas);
  gammas.erase(repeated.begin(), repeated.end());
  return gammas;
}

}  // namespace polargrain::fem
