// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <array>
#include <string_view>

#include "dem/laws/combination.hpp"

namespace polargrain::dem {

int LawCombination::code() const {
  const int laws =
      static_cast<int>(normal) + 4 * (static_cast<int>(tangential) + 4 * static_cast<int>(rolling));
  return laws * 4 + (settings.rolling_force ? 2 : 0) + (settings.symmetric ? 1 : 0);
}

bool LawCombination::is_bare() const {
  const bool whole_spin = settings.torsion && rolling == RollingLaw::epsd2;
  return !(settings.damped || settings.limit_force || settings.rolling_force || settings.rolling_damped ||
           whole_spin);
}

std::string LawCombination::name() const {
  constexpr std::array<std::string_view, 3> kNormal{"hooke/radii", "hooke/stiffness", "hertz"};
  constexpr std::array<std::string_view, 2> kTangential{"history", "li_chu"};
  constexpr std::array<std::string_view, 3> kRolling{"off", "epsd2", "li_chu"};
  return fmt::format("{}, {}, {}", kNormal[static_cast<std::size_t>(normal)],
                     kTangential[static_cast<std::size_t>(tangential)],
                     kRolling[static_cast<std::size_t>(rolling)]);
}

}  // namespace polargrain::dem
