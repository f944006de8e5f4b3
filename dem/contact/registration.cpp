// SPDX-License-Identifier: GPL-2.0-or-later
#include <cstdint>

#include "dem/contact/combinations.hpp"
#include "dem/contact/compiled_combination.hpp"
#include "dem/engine/extension.hpp"
#include "dem/engine/quiet_errors.hpp"

namespace polargrain::dem {

using namespace LIGGGHTS;                 // the engine's model constants
using namespace LIGGGHTS::ContactModels;  // NOLINT: style headers name them unqualified

namespace {

/// Whatever the lists of models name is known by that name.
void add_names() {
  Factory& factory = Factory::instance();
#define NORMAL_MODEL(identifier, name, number) factory.addNormalModel(model_name(#name), number);
#include "style_normal_model.h"
#undef NORMAL_MODEL
#define TANGENTIAL_MODEL(identifier, name, number) factory.addTangentialModel(model_name(#name), number);
#include "style_tangential_model.h"
#undef TANGENTIAL_MODEL
#define ROLLING_MODEL(identifier, name, number) factory.addRollingModel(model_name(#name), number);
#include "style_rolling_model.h"
#undef ROLLING_MODEL
}

void add_any_combination() {
  const int64_t fall_back = GranStyle<>::HASHCODE;
  PairStyles::Factory::instance().addStyle("gran", fall_back, &create_pair<AnyCombination>);
  Walls::Factory::instance().addStyle("gran", fall_back, &create_wall<AnyCombination>);
  // Stock combinations are found by their number before the fall-back is.
  add_combinations([](int, int, int, int) { return true; }, false);
}

/// Makes this project's contact models known to the engine by name, and their combinations with the stock ones usable in
/// `pair_style gran` and in walls; the stock combinations are replaced by ones that can be recorded. The engine registers
/// its own styles anew with every instance.
void register_contact_models(LAMMPS_NS::LAMMPS&) {
  const QuietErrors quiet;
  add_names();
  add_any_combination();
  add_compiled<HOOKE, TANGENTIAL_HISTORY, COHESION_OFF, ROLLING_OFF>();
  add_compiled<HOOKE_STIFFNESS, TANGENTIAL_HISTORY, COHESION_OFF, ROLLING_OFF>();
  add_compiled<HOOKE_STIFFNESS, TANGENTIAL_HISTORY, COHESION_OFF, ROLLING_EPSD2>();
  add_compiled<HERTZ, TANGENTIAL_HISTORY, COHESION_OFF, ROLLING_OFF>();
  add_compiled<HERTZ, TANGENTIAL_HISTORY, COHESION_OFF, ROLLING_EPSD2>();
  add_compiled<HOOKE_RADII, TANGENTIAL_HISTORY, COHESION_OFF, ROLLING_OFF>();
  add_compiled<HOOKE_RADII, TANGENTIAL_HISTORY, COHESION_OFF, ROLLING_EPSD2>();
  add_compiled<HOOKE_RADII, TANGENTIAL_HISTORY, COHESION_OFF, ROLLING_LI_CHU>();
  add_compiled<HOOKE_RADII, TANGENTIAL_LI_CHU, COHESION_OFF, ROLLING_OFF>();
  add_compiled<HOOKE_RADII, TANGENTIAL_LI_CHU, COHESION_OFF, ROLLING_LI_CHU>();
  add_compiled<HOOKE_STIFFNESS, TANGENTIAL_LI_CHU, COHESION_OFF, ROLLING_LI_CHU>();
  add_compiled<HERTZ, TANGENTIAL_LI_CHU, COHESION_OFF, ROLLING_LI_CHU>();
}

const Extension kContactModels(register_contact_models);

}  // namespace

}  // namespace polargrain::dem
