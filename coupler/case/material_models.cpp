// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/case/material_model.hpp"

namespace polargrain::coupler {

// A new material model: its file in models/, and its name here and in the list below.
MaterialModel adaptive_model();
MaterialModel cell_model();
MaterialModel elastic_model();
MaterialModel elastoplastic_model();
MaterialModel informed_model();

Weakened MaterialRecipe::weakened(double) const {
  if (!needs_workers()) return {};
  return {
      nullptr,
      "the friction of grains cannot be divided by a factor; let a load grow over the time, or the weight by its "
      "'factor', until no balance is found"};
}

const std::vector<MaterialModel>& material_models() {
  static const std::vector<MaterialModel> models{elastic_model(), elastoplastic_model(), cell_model(),
                                                 informed_model(), adaptive_model()};
  return models;
}

}  // namespace polargrain::coupler
