// SPDX-License-Identifier: GPL-2.0-or-later
// polargrain-liggghts with copies of two stock models under names of their own, added from outside as a
// user's program would: compiled here, run by the loops of cells.
#include "dem/contact/compiled_combination.hpp"
#include "dem/standalone/standalone.hpp"

namespace LIGGGHTS::ContactModels {

constexpr int kNormalCopy = 40;
constexpr int kTangentialCopy = 40;

template <>
class NormalModel<kNormalCopy> : public NormalModel<HOOKE_STIFFNESS> {
  using NormalModel<HOOKE_STIFFNESS>::NormalModel;
};

template <>
class TangentialModel<kTangentialCopy> : public TangentialModel<TANGENTIAL_HISTORY> {
  using TangentialModel<TANGENTIAL_HISTORY>::TangentialModel;
};

}  // namespace LIGGGHTS::ContactModels

int main(int argc, char** argv) {
  using namespace LIGGGHTS::ContactModels;  // NOLINT
  return polargrain::dem::run_liggghts(argc, argv, [] {
    Factory::instance().addNormalModel("copy/of/hooke/stiffness", kNormalCopy);
    Factory::instance().addTangentialModel("copy/of/history", kTangentialCopy);
    polargrain::dem::add_compiled<kNormalCopy, kTangentialCopy, COHESION_OFF, ROLLING_OFF>();
  });
}
