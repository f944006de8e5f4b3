// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/solver/why_singular.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace polargrain::fem {

template <int dim>
std::string why_singular(std::span<const Response<dim>> responses) {
  constexpr double kNothing = 1e-9;  // of the largest stiffness there is
  double largest = 0.0;
  for (const Response<dim>& response : responses)
    largest = std::max(largest, response.tangent.cwiseAbs().maxCoeff());
  std::size_t apart = 0;
  double stress = 0.0;
  for (const Response<dim>& response : responses) {
    if (response.tangent.template topLeftCorner<2, 2>().cwiseAbs().maxCoeff() > kNothing * largest) continue;
    ++apart;
    stress = std::max(stress, response.stress.template head<2>().cwiseAbs().maxCoeff());
  }
  const std::string text = "the tangent is singular";
  if (apart == 0) return text;
  return text +
         fmt::format(
             ": {} of {} points have come apart: they have no stiffness against strain and carry at most "
             "{:.2g} Pa",
             apart, responses.size(), stress);
}

template std::string why_singular<2>(std::span<const Response<2>> responses);
template std::string why_singular<3>(std::span<const Response<3>> responses);

}  // namespace polargrain::fem
