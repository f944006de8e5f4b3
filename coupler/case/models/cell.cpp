// SPDX-License-Identifier: GPL-2.0-or-later
// model: cell - the stress of a box of grains, run by a worker (docs/theory.md, C.6)
#include <optional>

#include "coupler/case/material_model.hpp"
#include "coupler/case/models/adaptivity_options.hpp"
#include "coupler/case/models/cell_definition.hpp"
#include "coupler/case/models/informed_parameters.hpp"
#include "coupler/cells/automatic_cells.hpp"
#include "coupler/cells/cell_material.hpp"
#include "coupler/cells/resident_material.hpp"
#include "coupler/cells/slip_driven_cells.hpp"

namespace polargrain::coupler {
namespace {

/// Of the critical damping: 0.03, 0.12, 0.24 and 0.5 put stresses 0.2, 0.5, 1 and 2 % off (docs/theory/explicit.md).
constexpr double kDampingOfResidents = 0.03;

/// Boxes of explicit steps.
struct Residents {
  int dem_steps;  ///< of a step
  double damping;
};

class CellRecipe : public MaterialRecipe {
 public:
  /// @param residents nothing: no steps are explicit
  CellRecipe(CellDefinition definition, const std::optional<CosseratChoice>& cosserat,
             const std::optional<Residents>& residents, const CaseFiles& files)
      : definition_(std::move(definition)),
        cosserat_(cosserat),
        residents_(residents),
        iterates_(files.iterates),
        spreads_(files.spreads_slips) {}
  [[nodiscard]] std::shared_ptr<fem::Material<2>> make(Pool* pool) const override { return made<2>(*pool); }
  [[nodiscard]] std::shared_ptr<fem::Material<3>> make_in_space(Pool* pool) const override {
    return made<3>(*pool);
  }
  [[nodiscard]] const CellDefinition* grains() const override { return &definition_; }
  [[nodiscard]] const CellDefinition* cell() const override { return &definition_; }
  [[nodiscard]] Slips slips() const override { return spreads_ ? Slips::spread : Slips::own; }

 private:
  [[nodiscard]] std::optional<CosseratParameters> cosserat(Pool& pool, std::string& note) const {
    if (!cosserat_) return {};
    return resolved(*cosserat_, pool, definition_, note);
  }
  template <int dim>
  [[nodiscard]] std::shared_ptr<fem::Material<dim>> made(Pool& pool) const {
    std::string note;
    const std::optional<CosseratParameters> cosserat = this->cosserat(pool, note);
    const auto cells = [&] {
      return std::make_unique<CellMaterial<dim>>(pool, pool.define(definition_), cosserat, note);
    };
    if (!residents_) return with_slips<dim>(std::shared_ptr(cells()), spreads_);
    CellDefinition moving = definition_;
    moving.control.damping = residents_->damping;
    auto boxes = std::make_unique<ResidentMaterial<dim>>(pool, pool.define(std::move(moving)), cosserat,
                                                         residents_->dem_steps, iterates_ ? "" : note);
    if (!iterates_) return with_slips<dim>(std::shared_ptr(std::move(boxes)), spreads_);
    return with_slips<dim>(std::make_shared<AutomaticCells<dim>>(cells(), std::move(boxes)), spreads_);
  }

  CellDefinition definition_;
  std::optional<CosseratChoice> cosserat_;
  std::optional<Residents> residents_;
  bool iterates_;
  bool spreads_;  ///< its slips follow those of the nodes
};

std::unique_ptr<MaterialRecipe> read_cell_model(const std::string& material, Section& section, Faults& faults,
                                                const CaseFiles& files) {
  const std::size_t faults_before = faults.size();
  // Boxes that never rest are dragged along by their damping, and nothing else brings them to rest.
  const bool moves = files.dem_steps > 0;
  CellControl defaults;
  if (moves && !files.iterates) defaults.damping = kDampingOfResidents;
  CellDefinition definition = read_cell_definition(material, section, faults, files, defaults);
  const std::optional<CosseratChoice> cosserat = read_rotations(section, definition, files);
  // Of the other schemes: checked, and no more.
  check_informed_parameters(section, files.dimension, faults);
  check_adaptivity_options(section, faults);
  std::optional<Residents> residents;
  if (moves) {
    const bool is_given = section.find("damping") != nullptr;
    residents = {files.dem_steps, is_given ? definition.control.damping : kDampingOfResidents};
    if (!is_given && files.iterates)
      section.leave("damping in explicit steps", value_text(kDampingOfResidents, Dimension::number));
  }
  if (faults.size() != faults_before) return nullptr;
  return std::make_unique<CellRecipe>(std::move(definition), cosserat, residents, files);
}

}  // namespace

MaterialModel cell_model() {
  return {
      "cell",
      "the stress of a box of grains (script, packing) and, with free rotations, a Cosserat part (G, Gc, lc)",
      read_cell_model};
}

}  // namespace polargrain::coupler
