// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "dem/discs/law_settings.hpp"

namespace LAMMPS_NS {
class LAMMPS;
}

namespace polargrain::dem {

/// The contacts that a script sets up, where the loops over discs and over spheres can take it.
struct DiscCombination {
  NormalLaw normal = NormalLaw::hooke_radii;
  TangentialLaw tangential = TangentialLaw::history;
  RollingLaw rolling = RollingLaw::off;
  LawSettings settings;
  int types = 1;
  std::vector<PairParameters> pairs;  ///< of types a and b: pairs[a * types + b]

  /// A number for the models and settings: springs mean something under the same one only.
  [[nodiscard]] int code() const;
  [[nodiscard]] std::string name() const;  ///< "hooke/radii, history, li_chu"
};

struct DiscSelection {
  std::optional<DiscCombination> combination;
  std::string reason;  ///< why the general loop has to run, when there is no combination
};

/// The contact models of an initialised engine, where the loop over discs knows them.
DiscSelection disc_models(LAMMPS_NS::LAMMPS& lammps);

/// The same for the passes over spheres, whatever the dimension of the scene.
DiscSelection sphere_models(LAMMPS_NS::LAMMPS& lammps);

/// Whether the scene of an initialised engine can be stepped by the loop over discs: a plane scene of one of
/// the combinations above that does nothing but integrate its grains.
DiscSelection disc_combination(LAMMPS_NS::LAMMPS& lammps);

/// The same for the loop over spheres: a scene in space.
DiscSelection sphere_combination(LAMMPS_NS::LAMMPS& lammps);

}  // namespace polargrain::dem
