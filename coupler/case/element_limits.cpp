// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/case/element_limits.hpp"

#include <fmt/format.h>

namespace polargrain::coupler {
namespace {

/// Most elements in the plane and in space: beyond, the numbers of the entries of the equations outgrow 32 bits; in space memory does.
constexpr double kMostElements[] = {1e6, 1e5};

/// The memory of a run for each, factors included: measured, 10,800 elements Q8R more with an elastic material, and 1,728
/// elements H20R, of which more take more each.
constexpr double kBytesOfElement[] = {65e3, 1.5e6};

}  // namespace

std::string too_many_elements(int dimension, double count) {
  const double most = kMostElements[dimension - 2];
  if (count <= most) return "";
  return fmt::format("{:.0f} of them would take {:.0f} GB of memory; at most {:.0f} are taken", count,
                     1e-9 * kBytesOfElement[dimension - 2] * count, most);
}

}  // namespace polargrain::coupler
