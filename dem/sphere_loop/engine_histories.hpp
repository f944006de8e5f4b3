// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <algorithm>
#include <array>

#include "dem/laws/combination.hpp"
#include "dem/sphere_loop/sphere_pass.hpp"

namespace polargrain::dem {

/// Which of the engine's values of a contact a spring of the loop is, in the order in which the models ask for them:
/// sliding, rolling, then a rolling displacement, then a torsion. -1: the engine has no such place.
inline std::array<int, kSphereSprings> history_places(const LawCombination& laws) {
  std::array<int, kSphereSprings> places{};
  places.fill(-1);
  int next = 0;
  const auto put = [&places, &next](int spring, int count) {
    for (int k = 0; k < count; ++k) places[spring + k] = next++;
  };
  put(kSliding, 3);
  if (laws.rolling != RollingLaw::off) put(kBending, 3);
  if (laws.settings.rolling_force && !laws.settings.symmetric) put(kRollingDisplacement, 3);
  if (laws.rolling == RollingLaw::li_chu && laws.settings.torsion) put(kTorsion, 1);
  return places;
}

/// How many values the engine keeps of a contact.
inline int history_values(const LawCombination& laws) {
  int values = 0;
  for (const int place : history_places(laws)) values = std::max(values, place + 1);
  return values;
}

}  // namespace polargrain::dem
