// SPDX-License-Identifier: GPL-2.0-or-later
#include "grains_io/neighbour_distance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

namespace polargrain {

std::string neighbour_distance(const Packing& packing) {
  constexpr double kShare = 0.2;  // of the mean radius
  const double wanted = kShare * packing.mean_radius();
  std::string nearest = "1e-3";
  double least = 1e300;
  for (int exponent = -12; exponent <= 3; ++exponent) {
    for (const int digit : {1, 2, 5}) {
      std::string text = fmt::format("{}e{}", digit, exponent);
      const double value = std::strtod(text.c_str(), nullptr);
      const double ratio = std::max(value / wanted, wanted / value);
      if (ratio >= least) continue;
      least = ratio;
      nearest = std::move(text);
    }
  }
  return nearest;
}

}  // namespace polargrain
