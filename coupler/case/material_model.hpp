// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "coupler/case/cell_script.hpp"
#include "coupler/case/section.hpp"
#include "coupler/pool/pool.hpp"
#include "fem/material/material.hpp"

namespace polargrain::coupler {

class MaterialRecipe;

/// The slips of a material where the case spreads slips.
enum class Slips {
  none,    ///< it is elastic
  spread,  ///< it follows those of the nodes
  own      ///< it has its own, which nothing spreads: not allowed there
};

/// A material with its strength divided by a factor.
struct Weakened {
  std::shared_ptr<const MaterialRecipe> recipe = nullptr;  ///< null: the material has no strength, and stays
  std::string why_not = {};                                ///< where it has one that cannot be divided
};

/// A material of a case, read and checked: makes the fem::Material when a run begins.
class MaterialRecipe {
 public:
  virtual ~MaterialRecipe() = default;
  /// @param pool never null when needs_workers(); must outlive the material
  [[nodiscard]] virtual std::shared_ptr<fem::Material<2>> make(Pool* pool) const = 0;
  /// The same for elements in space.
  [[nodiscard]] virtual std::shared_ptr<fem::Material<3>> make_in_space(Pool* pool) const = 0;
  template <int dim>
  [[nodiscard]] std::shared_ptr<fem::Material<dim>> make_for(Pool* pool) const {
    if constexpr (dim == 2) {
      return make(pool);
    } else {
      return make_in_space(pool);
    }
  }
  /// tan(friction angle) and cohesion divided by `factor`; the dilatancy is at most the friction. @param factor at least 1
  [[nodiscard]] virtual Weakened weakened(double factor) const;
  /// A sentence on the material that a user should read before a run; empty: nothing to tell.
  [[nodiscard]] virtual std::string note() const { return {}; }
  /// The cells that the material asks; null when it has no cells.
  [[nodiscard]] virtual const CellDefinition* grains() const { return nullptr; }
  [[nodiscard]] bool needs_workers() const { return grains() != nullptr; }
  /// The cell whose answer is the material's stress, when there is one that a path can be replayed in.
  [[nodiscard]] virtual const CellDefinition* cell() const { return nullptr; }
  /// Whether its stress has a part normal to the plane; the stress of discs has no such part.
  [[nodiscard]] virtual bool knows_s33() const {
    return grains() == nullptr || grains()->packing.dimension == 3;
  }
  /// Density with its pores, kg/m^3: given, or that of the packing; 0: not known. Steps in real time need it.
  [[nodiscard]] double density() const {
    if (given_density > 0.0 || grains() == nullptr) return given_density;
    return grains()->packing.grain_mass() / grains()->packing.volume();
  }
  double given_density = 0.0;
  [[nodiscard]] virtual Slips slips() const { return Slips::own; }

  /// Whether the material resists a micro-rotation relative to the continuum (Gc > 0).
  [[nodiscard]] virtual bool holds_micro_rotations() const { return true; }
};

/// A material model a case can name. To add one: a file in models/ that defines a function which returns it
/// (elastic.cpp is the shortest), and its line in material_models.cpp.
struct MaterialModel {
  std::string name;     ///< the word after `model:`
  std::string summary;  ///< one line for the help
  /// Reads the parameters from the material's section, puts faults on its list, and calls
  /// no finish() of it. @param material name in the case
  /// @returns null only when there were faults
  std::unique_ptr<MaterialRecipe> (*read)(const std::string& material, Section& section, Faults& faults,
                                          const CaseFiles& files);
};

/// All models, in the order of the help.
const std::vector<MaterialModel>& material_models();

}  // namespace polargrain::coupler
