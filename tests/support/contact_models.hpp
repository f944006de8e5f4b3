// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Cells under any combination of contact models.
#include <stdexcept>
#include <string>

#include "common/cell.hpp"

namespace polargrain::test {

/// Parameters that discs and spheres have of their own, as a script writes them.
struct ModelValues {
  std::string normal_damping, tangential_damping;                    ///< gamman, gammat
  std::string absolute_normal_damping, absolute_tangential_damping;  ///< gamman_abs, gammat_abs
  std::string rolling_friction;
  std::string young;  ///< fix property/global youngsModulus, and what it needs
  std::string time_step;
};

/// Commands that set contact models up. All parameters that any of them asks for are there; the stiffnesses are near those of
/// the packings of the demonstrations.
inline std::string model_commands(const std::string& style, const ModelValues& values) {
  std::string models;
  const auto pair = [&models](const std::string& property, const std::string& value) {
    models += "fix " + property + " all property/global " + property + " peratomtypepair 1 " + value + "\n";
  };
  pair("contactModulus", "6e8");
  pair("tangentialStiffnessRatio", "0.8");
  pair("contactDampingRatio", "0.05");
  pair("kn", "3e6");
  pair("kt", "2e6");
  pair("gamman", values.normal_damping);
  pair("gammat", values.tangential_damping);
  pair("gamman_abs", values.absolute_normal_damping);
  pair("gammat_abs", values.absolute_tangential_damping);
  pair("coefficientFriction", "0.4");
  pair("coefficientRollingFriction", values.rolling_friction);
  pair("rollingStiffnessRatio", "1.0");
  pair("rollingDampingRatio", "0.05");
  pair("coefficientRollingFrictionForce", "0.1");
  pair("rollingFrictionForceStiffnessRatio", "0.2");
  pair("rollingFrictionForceDampingRatio", "0.05");
  pair("coefficientRestitution", "0.8");
  models += values.young;
  models += "fix poissonsRatio all property/global poissonsRatio peratomtype 0.2\n";
  models += "pair_style gran model " + style + "\npair_coeff * *\ntimestep " + values.time_step + "\n";
  return models;
}

/// The cell of a demonstration under other models, without a tangent. @param commands of model_commands
inline CellDefinition under_models(CellDefinition definition, const std::string& commands) {
  std::string& script = definition.script;
  const auto start = script.find("fix             contact_modulus");
  const auto rest = script.find("fix             integrate", start);
  if (start == std::string::npos || rest == std::string::npos)
    throw std::logic_error("the script of the demonstration has changed");
  script.replace(start, rest - start, commands);
  definition.packing.pressure = 0.0;  // made under another law: the stress at rest is another too
  definition.control.tangent = CellTangent::none;
  return definition;
}

}  // namespace polargrain::test
