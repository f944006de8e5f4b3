// SPDX-License-Identifier: GPL-2.0-or-later
// model: informed - a Cosserat cone whose friction and dilatancy come from a box of grains
// (docs/theory/plasticity.md, B.9)
#include "coupler/case/material_model.hpp"
#include "coupler/case/models/cell_definition.hpp"
#include "coupler/case/models/informed_parameters.hpp"
#include "coupler/cells/informed_material.hpp"

namespace polargrain::coupler {
namespace {

class InformedRecipe : public MaterialRecipe {
 public:
  InformedRecipe(CellDefinition definition, const InformedParameters& parameters,
                 const CosseratChoice& cosserat)
      : definition_(std::move(definition)), parameters_(parameters), cosserat_(cosserat) {}
  [[nodiscard]] std::shared_ptr<fem::Material> make(Pool* pool) const override {
    InformedParameters parameters = parameters_;
    std::string note;
    parameters.set_moduli(resolved(cosserat_, *pool, definition_, note));
    return std::make_shared<InformedMaterial>(calls_of(*pool, pool->define(definition_)), parameters, note);
  }
  [[nodiscard]] bool needs_workers() const override { return true; }

 private:
  CellDefinition definition_;
  InformedParameters parameters_;
  CosseratChoice cosserat_;
};

std::unique_ptr<MaterialRecipe> read(const std::string& material, Section& section, Faults& faults,
                                     const CaseFiles& files) {
  const std::size_t faults_before = faults.size();
  CellDefinition definition = read_cell_definition(material, section, faults, files);
  const CosseratChoice cosserat = read_cosserat_choice(section);
  const InformedParameters parameters = read_informed_parameters(section);
  if (faults.size() != faults_before) return nullptr;
  definition.control.tangent = CellTangent::none;  // the law has one of its own
  return std::make_unique<InformedRecipe>(std::move(definition), parameters, cosserat);
}

}  // namespace

MaterialModel informed_model() {
  return {
      "informed",
      "a Cosserat cone whose friction and dilatancy come from a box of grains (script, packing; G, Gc, lc)",
      read};
}

}  // namespace polargrain::coupler
