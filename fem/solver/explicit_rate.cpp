// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/solver/explicit_rate.hpp"

#include <algorithm>
#include <cmath>

namespace polargrain::fem {

double ExplicitRate::next_speed(const StepReport& row, int wave) const {
  if (row.explicit_steps == 0) return row.speed;
  // Errors grow with the rate, the kinetic energy with its square.
  const double excess =
      std::max(row.quasi_static.error() / error, std::sqrt(row.quasi_static.kinetic_share / kinetic_share));
  const double waves = wave > 0 ? std::min(1.0, static_cast<double>(row.explicit_steps) / wave) : 1.0;
  const double factor =
      std::clamp(excess > 0.0 ? aim / excess : most_faster, most_slower, std::pow(most_faster, waves));
  // Within a tenth of the aim the rate stays: each change makes waves.
  constexpr double kNear = 0.1;
  const bool is_near = std::abs(factor - 1.0) < kNear && excess <= 1.0;
  return std::clamp(is_near ? row.speed : factor * row.speed, slowest, fastest);
}

}  // namespace polargrain::fem
