// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/contact/registration.hpp"

#include <cstdint>
#include <iostream>

#include "dem/contact/cell_loading.hpp"
#include "dem/contact/compiled_combination.hpp"

namespace polargrain::dem {

using namespace LIGGGHTS;                 // the engine's model constants
using namespace LIGGGHTS::ContactModels;  // NOLINT: style headers name them unqualified

ContactRecorder& contact_recorder() {
  static ContactRecorder recorder;
  return recorder;
}

CellLoading& cell_loading() {
  static CellLoading loading;
  return loading;
}

namespace {

/// Any combination, put together at run time through virtual calls.
using AnyCombination = ContactModel<GranStyle<>>;

void add_names() {
  Factory& factory = Factory::instance();
  factory.addNormalModel("hooke/radii", HOOKE_RADII);
  factory.addTangentialModel("li_chu", TANGENTIAL_LI_CHU);
  factory.addRollingModel("li_chu", ROLLING_LI_CHU);
}

/// Identifiers are small: the engine packs five of them into one number of six bits each.
constexpr int kIdentifiers = 1 << 6;

void add_any_combination(bool record_all) {
  const int64_t fall_back = GranStyle<>::HASHCODE;
  PairStyles::Factory::instance().addStyle("gran", fall_back, &create_pair<AnyCombination>);
  Walls::Factory::instance().addStyle("gran", fall_back, &create_wall<AnyCombination>);
  if (!record_all) return;
  // Stock combinations are found by their number before the fall-back is; take each number the stock may use.
  for (int normal = 0; normal < 13; ++normal)
    for (int tangential = 0; tangential < 5; ++tangential)
      for (int cohesion = 0; cohesion < 9; ++cohesion)
        for (int rolling = 0; rolling < 7; ++rolling)
          for (const int surface : {SURFACE_DEFAULT, SURFACE_MULTICONTACT}) {
            const int64_t hash =
                normal | (tangential << 6) | (cohesion << 12) | (rolling << 18) | (surface << 24);
            PairStyles::Factory::instance().addStyle("gran", static_cast<int>(hash),
                                                     &create_pair<AnyCombination>);
          }
}

/// The engine warns of every number that is registered twice, which is what replacing means.
class QuietErrors {
 public:
  QuietErrors() : buffer_(std::cerr.rdbuf(nullptr)) {}
  QuietErrors(const QuietErrors&) = delete;
  QuietErrors& operator=(const QuietErrors&) = delete;
  ~QuietErrors() {
    std::cerr.rdbuf(buffer_);
    std::cerr.clear();
  }

 private:
  std::streambuf* buffer_;
};

}  // namespace

void register_contact_models(bool record_all) {
  static_assert(HOOKE_RADII < kIdentifiers && TANGENTIAL_LI_CHU < kIdentifiers &&
                ROLLING_LI_CHU < kIdentifiers);
  const QuietErrors quiet;
  add_names();
  add_any_combination(record_all);
  if (record_all) {
    add_compiled<HOOKE, TANGENTIAL_HISTORY, COHESION_OFF, ROLLING_OFF>();
    add_compiled<HOOKE_STIFFNESS, TANGENTIAL_HISTORY, COHESION_OFF, ROLLING_OFF>();
    add_compiled<HOOKE_STIFFNESS, TANGENTIAL_HISTORY, COHESION_OFF, ROLLING_EPSD2>();
    add_compiled<HERTZ, TANGENTIAL_HISTORY, COHESION_OFF, ROLLING_OFF>();
    add_compiled<HERTZ, TANGENTIAL_HISTORY, COHESION_OFF, ROLLING_EPSD2>();
  }
  add_compiled<HOOKE_RADII, TANGENTIAL_HISTORY, COHESION_OFF, ROLLING_OFF>();
  add_compiled<HOOKE_RADII, TANGENTIAL_HISTORY, COHESION_OFF, ROLLING_EPSD2>();
  add_compiled<HOOKE_RADII, TANGENTIAL_HISTORY, COHESION_OFF, ROLLING_LI_CHU>();
  add_compiled<HOOKE_RADII, TANGENTIAL_LI_CHU, COHESION_OFF, ROLLING_OFF>();
  add_compiled<HOOKE_RADII, TANGENTIAL_LI_CHU, COHESION_OFF, ROLLING_LI_CHU>();
  add_compiled<HOOKE_STIFFNESS, TANGENTIAL_LI_CHU, COHESION_OFF, ROLLING_LI_CHU>();
  add_compiled<HERTZ, TANGENTIAL_LI_CHU, COHESION_OFF, ROLLING_LI_CHU>();
}

}  // namespace polargrain::dem
