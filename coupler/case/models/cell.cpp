// SPDX-License-Identifier: GPL-2.0-or-later
// model: cell - the stress of a box of grains, run by a worker (docs/theory.md, C.6)
#include <fmt/format.h>

#include <fstream>
#include <sstream>

#include "coupler/case/data_files.hpp"
#include "coupler/case/material_model.hpp"
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

 private:
  CellDefinition definition_;
  CosseratParameters cosserat_;
};

/// The path of a file that the key names; empty, with a fault, when there is none.
std::filesystem::path file_of(Section& section, const std::string& key, const std::string& what,
                              const std::filesystem::path& directory) {
  const std::string name = section.text(key, what);
  if (name.empty()) return {};
  if (const auto file = find_data_file(name, directory)) return *file;
  section.fault(key,
                fmt::format("{}: there is no file '{}', neither beside the case nor below liggghts_inputs/; "
                            "correct the path or put the file there",
                            key, name));
  return {};
}

std::string content_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

CellControl read_control(Section& section) {
  CellControl control;
  const auto positive = [&](const char* key, double otherwise) {
    return section.quantity_or(key, Dimension::number, Limit::positive, otherwise);
  };
  control.inertial_number = positive("inertial_number", control.inertial_number);
  control.unbalanced_force_ratio = positive("unbalanced_force_ratio", control.unbalanced_force_ratio);
  control.unbalanced_moment_ratio = positive("unbalanced_moment_ratio", control.unbalanced_moment_ratio);
  control.damping = section.quantity_or("damping", Dimension::number, Limit::not_negative, control.damping);
  if (control.damping >= 1.0) section.fault("damping", "damping: must be less than 1");
  control.least_steps = section.whole_or("least_steps", 1, control.least_steps);
  control.most_relaxation_steps = section.whole_or("most_relaxation_steps", 1, control.most_relaxation_steps);
  const std::string tangent = section.choice_or("tangent", {"condensed", "voigt"}, "condensed");
  control.tangent = tangent == "voigt" ? CellTangent::voigt : CellTangent::condensed;
  return control;
}

std::unique_ptr<MaterialRecipe> read(const std::string& material, Section& section, Faults& faults,
                                     const std::filesystem::path& directory) {
  const std::size_t faults_before = faults.size();
  CellDefinition definition;
  definition.name = material;
  const auto script = file_of(section, "script", "the path of a LIGGGHTS input script for cells", directory);
  const auto packing = file_of(section, "packing", "the path of a packing (CSV or HDF5)", directory);
  CosseratParameters cosserat;
  cosserat.shear_modulus = section.quantity("G", Dimension::pressure, Limit::positive);
  cosserat.cosserat_shear_modulus = section.quantity("Gc", Dimension::pressure, Limit::positive);
  cosserat.internal_length = section.quantity("lc", Dimension::length, Limit::positive);
  definition.control = read_control(section);
  if (!script.empty()) {
    definition.script_file = script.lexically_normal().string();
    definition.script = content_of(script);
    if (definition.script.empty()) section.fault("script", "script: the file is empty or cannot be read");
  }
  if (!packing.empty()) try {
      definition.packing = read_packing(packing);
    } catch (const InputError& error) {
      faults.insert(faults.end(), error.faults().begin(), error.faults().end());
    }
  if (faults.size() != faults_before) return nullptr;
  return std::make_unique<CellRecipe>(std::move(definition), cosserat);
}

}  // namespace

MaterialModel cell_model() {
  return {"cell", "the stress of a box of grains (script, packing) with a Cosserat part (G, Gc, lc)", read};
}

}  // namespace polargrain::coupler
