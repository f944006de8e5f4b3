// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cmath>
#include <stdexcept>

#include "common/increment.hpp"
#include "common/response.hpp"

namespace polargrain::fem::test {

/// One step of plane-strain compression of a single point under constant lateral stress: finds h11 for a
/// given h22 so that s11 = lateral (Pa). `evaluate(increment)` answers from the start of the step.
/// @return the increment that meets it. @throws std::runtime_error when Newton does not converge.
template <class Evaluate>
Increment<2> biaxial_step(double vertical_strain, double lateral, const Evaluate& evaluate,
                          double first_guess = 0.0) {
  Increment<2> increment;
  increment.displacement_gradient(1, 1) = vertical_strain;
  increment.displacement_gradient(0, 0) = first_guess;
  for (int iteration = 0; iteration < 100; ++iteration) {
    const Response<2> response = evaluate(increment);
    if (response.quality != Quality::good) {
      throw std::runtime_error(response.message);
    }
    const double residual = response.stress(k11) - lateral;
    if (std::abs(residual) <= 1e-10 * std::abs(lateral)) {
      return increment;
    }
    increment.displacement_gradient(0, 0) -= residual / response.tangent(k11, k11);
  }
  throw std::runtime_error("lateral stress was not met");
}

}  // namespace polargrain::fem::test
