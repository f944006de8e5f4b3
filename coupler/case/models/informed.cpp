// SPDX-License-Identifier: GPL-2.0-or-later
// model: informed - a Cosserat cone whose friction and dilatancy come from a box of grains
// (docs/theory/plasticity.md, B.9)
#include <fmt/format.h>

#include <optional>

#include "coupler/case/material_model.hpp"
#include "coupler/case/models/adaptivity_options.hpp"
#include "coupler/case/models/cell_definition.hpp"
#include "coupler/case/models/informed_parameters.hpp"
#include "coupler/case/models/scheme_section.hpp"
#include "coupler/cells/gathered_material.hpp"
#include "coupler/cells/informed_material.hpp"
#include "coupler/cells/slip_driven_cells.hpp"

namespace polargrain::coupler {
namespace {

template <int dim>
class InformedRecipe : public MaterialRecipe {
 public:
  InformedRecipe(CellDefinition definition, const InformedParameters<dim>& parameters,
                 const std::optional<CosseratChoice>& cosserat, const CaseFiles& files)
      : ask_every_(files.ask_every),
        spreads_(files.spreads_slips),
        definition_(std::move(definition)),
        tangent_(definition_.control.tangent),
        parameters_(parameters),
        cosserat_(cosserat.value_or(CosseratChoice{})) {
    // Where the case gives no plastic length the law's own weights limit the couple stress.
    if (cosserat_.plastic_length.is_open()) cosserat_.plastic_length.none = true;
    definition_.control.tangent = CellTangent::none;  // the law has one of its own
  }
  [[nodiscard]] std::shared_ptr<fem::Material<2>> make(Pool* pool) const override { return made<2>(*pool); }
  [[nodiscard]] std::shared_ptr<fem::Material<3>> make_in_space(Pool* pool) const override {
    return made<3>(*pool);
  }
  [[nodiscard]] bool knows_s33() const override { return true; }  // the law's
  [[nodiscard]] const CellDefinition* grains() const override { return &definition_; }
  [[nodiscard]] Slips slips() const override { return spreads_ ? Slips::spread : Slips::own; }

 private:
  template <int wanted>
  [[nodiscard]] std::shared_ptr<fem::Material<wanted>> made(Pool& pool) const {
    if constexpr (wanted == dim) {
      InformedParameters<dim> parameters = parameters_;
      std::string note;
      // Controlled rotations leave nothing to the case: stiffness and strength are the cell's.
      parameters.set_moduli(resolved(cosserat_, pool, definition_, note));
      CellCalls<dim> with_tangent;
      if (parameters.beyond_mismatch == BeyondMismatch::cell) {
        CellDefinition definition = definition_;
        definition.control.tangent = tangent_;
        with_tangent = calls_of<dim>(pool, pool.define(std::move(definition)));
      }
      auto material = std::make_shared<InformedMaterial<dim>>(calls_of<dim>(pool, pool.define(definition_)),
                                                              parameters, note, std::move(with_tangent));
      if (ask_every_ == 0) return with_slips<dim>(material, spreads_);
      return with_slips<dim>(std::make_shared<GatheredMaterial<dim>>(material, ask_every_), spreads_);
    } else {
      throw RunError("an informed material of another dimension was asked for");
    }
  }

  int ask_every_;  ///< explicit steps after which the cells follow; 0: Newton's method
  bool spreads_;   ///< its slips follow those of the nodes
  CellDefinition definition_;
  CellTangent tangent_;  ///< of the case: for points that go by their cells
  InformedParameters<dim> parameters_;
  CosseratChoice cosserat_;
};

/// Explicit steps are too many to bring cells to rest in each of them.
template <int dim>
void refuse_asking_each_step(Section& section, const InformedParameters<dim>& parameters,
                             const CaseFiles& files) {
  if (files.ask_every == 0) return;
  if (parameters.update == InformedUpdate::fixed_point)
    section.fault(
        "update",
        "update: in explicit steps the cells are asked every few steps, so the cone is that of the steps before; "
        "write frozen, or leave the key out");
  if (parameters.beyond_mismatch == BeyondMismatch::cell)
    section.fault(
        "beyond_mismatch",
        "beyond_mismatch: in explicit steps a law cannot go over to its cell; write tell, or use `model: cell`");
}

template <int dim>
std::unique_ptr<MaterialRecipe> read_for(const std::string& material, Section& section, Faults& faults,
                                         const CaseFiles& files) {
  const std::size_t faults_before = faults.size();
  CellDefinition definition = read_cell_definition(material, section, faults, files);
  const std::optional<CosseratChoice> cosserat = read_rotations(section, definition, files);
  SchemeSection informed(section, "informed", faults);
  InformedParameters<dim> parameters = read_informed_parameters<dim>(informed.keys());
  if (cosserat && cosserat->plastic_length.value && parameters.weights) {
    // Given, or what `lc: measured` comes with.
    informed.keys().fault(
        "invariants",
        fmt::format("invariants: their third number limits the couple stress, and so does {}; leave one of "
                    "the two out",
                    section.find("lp") != nullptr ? "lp" : "the lp that comes with 'lc: measured'"));
  }
  check_adaptivity_options(section, faults);  // of another scheme: checked, and no more
  refuse_asking_each_step(informed.keys(), parameters, files);
  informed.finish();
  if (faults.size() != faults_before) return nullptr;
  if (!cosserat) parameters.mean_diameter = 2.0 * definition.packing.mean_radius();
  return std::make_unique<InformedRecipe<dim>>(std::move(definition), parameters, cosserat, files);
}

std::unique_ptr<MaterialRecipe> read_informed_model(const std::string& material, Section& section,
                                                    Faults& faults, const CaseFiles& files) {
  return files.dimension == 3 ? read_for<3>(material, section, faults, files)
                              : read_for<2>(material, section, faults, files);
}

}  // namespace

MaterialModel informed_model() {
  return {
      "informed",
      "a Cosserat cone whose friction and dilatancy come from a box of grains (script, packing; G, Gc, lc)",
      read_informed_model};
}

}  // namespace polargrain::coupler
