// SPDX-License-Identifier: GPL-2.0-or-later
// model: cell - the stress of a box of grains, run by a worker (docs/theory.md, C.6)
#include <optional>

#include "coupler/case/material_model.hpp"
#include "coupler/case/models/adaptivity_options.hpp"
#include "coupler/case/models/cell_definition.hpp"
#include "coupler/case/models/informed_parameters.hpp"
#include "coupler/cells/cell_material.hpp"
#include "coupler/cells/resident_material.hpp"

namespace polargrain::coupler {
namespace {

/// Of the critical damping: 0.03, 0.12, 0.24 and 0.5 put stresses 0.2, 0.5, 1 and 2 % off (docs/theory/explicit.md).
constexpr double kDampingOfResidents = 0.03;

class CellRecipe : public MaterialRecipe {
 public:
  CellRecipe(CellDefinition definition, const std::optional<CosseratChoice>& cosserat, int dem_steps)
      : definition_(std::move(definition)), cosserat_(cosserat), dem_steps_(dem_steps) {}
  [[nodiscard]] std::shared_ptr<fem::Material<2>> make(Pool* pool) const override { return made<2>(*pool); }
  [[nodiscard]] std::shared_ptr<fem::Material<3>> make_in_space(Pool* pool) const override {
    return made<3>(*pool);
  }
  [[nodiscard]] const CellDefinition* grains() const override { return &definition_; }
  [[nodiscard]] const CellDefinition* cell() const override { return &definition_; }

 private:
  template <int dim>
  [[nodiscard]] std::shared_ptr<fem::Material<dim>> made(Pool& pool) const {
    std::optional<CosseratParameters> cosserat;
    std::string note;
    if (cosserat_) cosserat = resolved(*cosserat_, pool, definition_, note);
    if (dem_steps_ > 0)
      return std::make_shared<ResidentMaterial<dim>>(pool, pool.define(definition_), cosserat, dem_steps_,
                                                     std::move(note));
    return std::make_shared<CellMaterial<dim>>(pool, pool.define(definition_), cosserat, std::move(note));
  }

  CellDefinition definition_;
  std::optional<CosseratChoice> cosserat_;
  int dem_steps_;  // of an explicit step; 0: Newton's method
};

std::unique_ptr<MaterialRecipe> read(const std::string& material, Section& section, Faults& faults,
                                     const CaseFiles& files) {
  const std::size_t faults_before = faults.size();
  CellDefinition definition = read_cell_definition(material, section, faults, files);
  const std::optional<CosseratChoice> cosserat = read_rotations(section, definition, files);
  check_informed_parameters(section, files.dimension);  // these two checked, and no more: see there
  read_adaptivity_options(section);
  // Boxes that never rest are dragged along by their damping, and nothing else brings them to rest.
  if (files.dem_steps > 0 && section.find("damping") == nullptr)
    definition.control.damping = kDampingOfResidents;
  if (faults.size() != faults_before) return nullptr;
  return std::make_unique<CellRecipe>(std::move(definition), cosserat, files.dem_steps);
}

}  // namespace

MaterialModel cell_model() {
  return {
      "cell",
      "the stress of a box of grains (script, packing) and, with free rotations, a Cosserat part (G, Gc, lc)",
      read};
}

}  // namespace polargrain::coupler
