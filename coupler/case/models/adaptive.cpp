// SPDX-License-Identifier: GPL-2.0-or-later
// model: adaptive - boxes of grains, no more of them than a tolerance asks for (docs/adaptivity.md)
#include <optional>

#include "coupler/adaptivity/adaptive_material.hpp"
#include "coupler/case/material_model.hpp"
#include "coupler/case/models/adaptivity_options.hpp"
#include "coupler/case/models/cell_definition.hpp"
#include "coupler/case/models/informed_parameters.hpp"
#include "coupler/cells/gathered_material.hpp"
#include "coupler/cells/secant_tangent.hpp"

namespace polargrain::coupler {
namespace {

class AdaptiveRecipe : public MaterialRecipe {
 public:
  AdaptiveRecipe(CellDefinition definition, const std::optional<CosseratChoice>& cosserat,
                 const AdaptivityOptions& options, int ask_every)
      : definition_(std::move(definition)), cosserat_(cosserat), options_(options), ask_every_(ask_every) {}
  [[nodiscard]] std::shared_ptr<fem::Material<2>> make(Pool* pool) const override { return made<2>(*pool); }
  [[nodiscard]] std::shared_ptr<fem::Material<3>> make_in_space(Pool* pool) const override {
    return made<3>(*pool);
  }
  [[nodiscard]] const CellDefinition* grains() const override { return &definition_; }

 private:
  template <int dim>
  [[nodiscard]] std::shared_ptr<fem::Material<dim>> made(Pool& pool) const {
    std::string note;
    std::optional<CosseratParameters> cosserat;
    if (cosserat_) cosserat = resolved(*cosserat_, pool, definition_, note);
    auto material = std::make_shared<AdaptiveMaterial<dim>>(
        secant_calls_of<dim>(pool, pool.define(definition_)), cosserat, options_, note);
    if (ask_every_ == 0) return material;
    return std::make_shared<GatheredMaterial<dim>>(std::move(material), ask_every_);
  }

  CellDefinition definition_;
  std::optional<CosseratChoice> cosserat_;
  AdaptivityOptions options_;
  int ask_every_;  ///< explicit steps that are taken together; 0: Newton's method
};

std::unique_ptr<MaterialRecipe> read_adaptive_model(const std::string& material, Section& section,
                                                    Faults& faults, const CaseFiles& files) {
  const std::size_t faults_before = faults.size();
  CellDefinition definition = read_cell_definition(material, section, faults, files);
  const std::optional<CosseratChoice> cosserat = read_rotations(section, definition, files);
  AdaptivityOptions options = read_adaptivity_options(section, faults);
  check_informed_parameters(section, files.dimension, faults);  // of another scheme: checked, and no more
  if (definition.control.tangent == CellTangent::voigt) {
    section.fault(
        "tangent",
        "tangent: an adaptive material carries stresses along the tangent, and the affine one is no "
        "derivative of the stress once contacts slide; leave the key out");
  }
  if (faults.size() != faults_before) return nullptr;
  if (!cosserat) options.mean_diameter = 2.0 * definition.packing.mean_radius();
  return std::make_unique<AdaptiveRecipe>(std::move(definition), cosserat, options, files.ask_every);
}

}  // namespace

MaterialModel adaptive_model() {
  return {"adaptive", "boxes of grains as `cell` has them, no more than a tolerance asks for",
          read_adaptive_model};
}

}  // namespace polargrain::coupler
