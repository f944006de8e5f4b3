// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <algorithm>
#include <cstdint>
#include <string>

#include "dem/contact/compiled_combination.hpp"

namespace polargrain::dem {

/// The engine packs the numbers of the five models of a combination into one, of six bits each.
inline constexpr int kModelNumbers = 1 << 6;

/// Any combination of the models in the lists of this program or library, put together at run time through
/// virtual calls.
using AnyCombination = LIGGGHTS::ContactModels::ContactModel<LIGGGHTS::ContactModels::GranStyle<>>;

/// The numbers of all models that this program or library can combine: those in the lists.
struct ModelNumbers {
// clang-format off
#define NORMAL_MODEL(identifier, name, number) number,
#define TANGENTIAL_MODEL(identifier, name, number) number,
#define COHESION_MODEL(identifier, name, number) number,
#define ROLLING_MODEL(identifier, name, number) number,
#define SURFACE_MODEL(identifier, name, number) number,
  static constexpr int normal[] = {LIGGGHTS::ContactModels::NORMAL_OFF,
#include "style_normal_model.h"
  };
  static constexpr int tangential[] = {LIGGGHTS::ContactModels::TANGENTIAL_OFF,
#include "style_tangential_model.h"
  };
  static constexpr int cohesion[] = {LIGGGHTS::ContactModels::COHESION_OFF,
#include "style_cohesion_model.h"
  };
  static constexpr int rolling[] = {LIGGGHTS::ContactModels::ROLLING_OFF,
#include "style_rolling_model.h"
  };
  static constexpr int surface[] = {
#include "style_surface_model.h"
  };
#undef NORMAL_MODEL
#undef TANGENTIAL_MODEL
#undef COHESION_MODEL
#undef ROLLING_MODEL
#undef SURFACE_MODEL
  // clang-format on
};

/// The name of a model as scripts write it: the spaces that formatting puts around a slash in the lists go.
inline std::string model_name(std::string listed) {
  std::erase(listed, ' ');
  return listed;
}

/// Makes the combinations of `normal`, `tangential`, `cohesion`, `rolling`, `surface` for which `wanted` says so usable
/// in `pair_style gran`, and in walls where `walls` is set.
template <typename Wanted>
void add_combinations(const Wanted& wanted, bool walls) {
  using namespace LIGGGHTS;  // NOLINT: the engine's macros name its parts unqualified
  for (const int normal : ModelNumbers::normal)
    for (const int tangential : ModelNumbers::tangential)
      for (const int cohesion : ModelNumbers::cohesion)
        for (const int rolling : ModelNumbers::rolling)
          for (const int surface : ModelNumbers::surface) {
            if (!wanted(normal, tangential, cohesion, rolling)) continue;
            const std::int64_t number =
                normal | (tangential << 6) | (cohesion << 12) | (rolling << 18) | (surface << 24);
            PairStyles::Factory::instance().addStyle("gran", static_cast<int>(number),
                                                     &create_pair<AnyCombination>);
            if (walls)
              Walls::Factory::instance().addStyle("gran", static_cast<int>(number),
                                                  &create_wall<AnyCombination>);
          }
}

}  // namespace polargrain::dem
