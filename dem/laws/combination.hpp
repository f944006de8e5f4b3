// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "dem/laws/law_settings.hpp"

namespace LAMMPS_NS {
class LAMMPS;
}

namespace polargrain::dem {

/// The contacts that a script sets up, where the loops over discs and over spheres can take it.
struct LawCombination {
  NormalLaw normal = NormalLaw::hooke_radii;
  TangentialLaw tangential = TangentialLaw::history;
  RollingLaw rolling = RollingLaw::off;
  LawSettings settings;
  int types = 1;
  std::vector<PairParameters> pairs;  ///< of types a and b: pairs[a * types + b]

  /// A number for the models and settings: springs mean something under the same one only.
  [[nodiscard]] int code() const;
  /// Whether the bare kernels have the laws: no dashpots, no limit of normal forces, no rolling friction force.
  [[nodiscard]] bool is_bare() const;
  [[nodiscard]] std::string name() const;  ///< "hooke/radii, history, li_chu"
};

struct LawSelection {
  std::optional<LawCombination> combination;
  std::string reason;  ///< why the general loop has to run, when there is no combination
};

/// The contact models of an initialised engine, where the loops know them.
LawSelection known_models(LAMMPS_NS::LAMMPS& lammps);

/// Whether the scene of an initialised engine can be stepped by the loop over discs: a plane scene of one of
/// the combinations above that does nothing but integrate its grains.
LawSelection disc_combination(LAMMPS_NS::LAMMPS& lammps);

/// The same for the loop over spheres: a scene in space.
LawSelection sphere_combination(LAMMPS_NS::LAMMPS& lammps);

}  // namespace polargrain::dem
