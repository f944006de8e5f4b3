// SPDX-License-Identifier: GPL-2.0-or-later
// model: cell - the stress of a box of grains, run by a worker (docs/theory.md, C.6)
#include "coupler/case/material_model.hpp"
#include "coupler/case/models/cell_definition.hpp"
#include "coupler/cell_material.hpp"

namespace polargrain::coupler {
namespace {

class CellRecipe : public MaterialRecipe {
 public:
  CellRecipe(CellDefinition definition, const CosseratParameters& cosserat)
      : definition_(std::move(definition)), cosserat_(cosserat) {}
  [[nodiscard]] std::shared_ptr<fem::Material> make(Pool* pool) const override {
    return std::make_shared<CellMaterial>(*pool, pool->define(definition_), cosserat_);
  }
  [[nodiscard]] bool needs_workers() const override { return true; }
  [[nodiscard]] const CellDefinition* cell() const override { return &definition_; }

 private:
  CellDefinition definition_;
  CosseratParameters cosserat_;
};

std::unique_ptr<MaterialRecipe> read(const std::string& material, Section& section, Faults& faults,
                                     const std::filesystem::path& directory) {
  const std::size_t faults_before = faults.size();
  CellDefinition definition = read_cell_definition(material, section, faults, directory);
  const CosseratParameters cosserat = read_cosserat_parameters(section);
  if (faults.size() != faults_before) return nullptr;
  return std::make_unique<CellRecipe>(std::move(definition), cosserat);
}

}  // namespace

MaterialModel cell_model() {
  return {"cell", "the stress of a box of grains (script, packing) with a Cosserat part (G, Gc, lc)", read};
}

}  // namespace polargrain::coupler
