// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/solver/why_singular.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace polargrain::fem {

std::string why_singular(std::span<const Response> responses) {
  constexpr double kNothing = 1e-9;  // of the largest stiffness there is
  double largest = 0.0;
  for (const Response& response : responses)
    largest = std::max(largest, response.tangent.cwiseAbs().maxCoeff());
  std::size_t apart = 0;
  double stress = 0.0;
  for (const Response& response : responses) {
    if (response.tangent.topLeftCorner<2, 2>().cwiseAbs().maxCoeff() > kNothing * largest) continue;
    ++apart;
    stress = std::max(stress, response.stress.head<2>().cwiseAbs().maxCoeff());
  }
  const std::string text = "the tangent is singular";
  if (apart == 0) return text;
  return text +
         fmt::format(
             ": {} of {} points have come apart: they have no stiffness against strain and carry at most "
             "{:.2g} Pa",
             apart, responses.size(), stress);
}

}  // namespace polargrain::fem
