// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Every combination of contact models that the loop over spheres knows.
#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/sphere_cells.hpp"

namespace polargrain::test {

struct ModelsOfSphereLoop {
  std::string name;
  std::string style;  ///< words behind `pair_style gran model`
};

inline void PrintTo(const ModelsOfSphereLoop& models, std::ostream* stream) {
  *stream << models.style;
}

/// Commands that set contact models up. All parameters that any of them asks for are there; the stiffnesses are near those of
/// the spheres of the demonstration.
inline std::string model_commands(const std::string& style) {
  std::string models;
  const auto pair = [&models](const std::string& property, const std::string& value) {
    models += "fix " + property + " all property/global " + property + " peratomtypepair 1 " + value + "\n";
  };
  pair("contactModulus", "6e8");
  pair("tangentialStiffnessRatio", "0.8");
  pair("contactDampingRatio", "0.05");
  pair("kn", "3e6");
  pair("kt", "2e6");
  pair("gamman", "3000");
  pair("gammat", "2000");
  pair("gamman_abs", "2");
  pair("gammat_abs", "1");
  pair("coefficientFriction", "0.4");
  pair("coefficientRollingFriction", "0.1");
  pair("rollingStiffnessRatio", "1.0");
  pair("rollingDampingRatio", "0.05");
  pair("coefficientRollingFrictionForce", "0.1");
  pair("rollingFrictionForceStiffnessRatio", "0.2");
  pair("rollingFrictionForceDampingRatio", "0.05");
  pair("coefficientRestitution", "0.8");
  models += "hard_particles yes\nfix youngsModulus all property/global youngsModulus peratomtype 5e9\n";
  models += "fix poissonsRatio all property/global poissonsRatio peratomtype 0.2\n";
  models += "pair_style gran model " + style + "\npair_coeff * *\ntimestep 1.5e-6\n";
  return models;
}

/// The spheres of the demonstration with other contact models.
inline CellDefinition sphere_cell_of(const std::string& style) {
  CellDefinition definition = linear_spheres();
  std::string& script = definition.script;
  const auto start = script.find("fix             contact_modulus");
  const auto rest = script.find("fix             integrate", start);
  if (start == std::string::npos || rest == std::string::npos)
    throw std::logic_error("the script of the spheres has changed");
  script.replace(start, rest - start, model_commands(style));
  definition.packing.pressure = 0.0;  // made under another law: the stress at rest is another too
  definition.control.tangent = CellTangent::none;
  return definition;
}

inline const std::vector<ModelsOfSphereLoop> kCombinationsOfSphereLoop{
    {"radii", "hooke/radii tangential history"},
    {"radii_damped", "hooke/radii tangential history damping on"},
    {"radii_limited", "hooke/radii tangential history damping on limitForce on"},
    {"radii_epsd2", "hooke/radii tangential history rolling_friction epsd2"},
    {"radii_epsd2_torsion",
     "hooke/radii tangential history rolling_friction epsd2 torsionTorque on damping on"},
    {"radii_rolling", "hooke/radii tangential history rolling_friction li_chu meanRadius on"},
    {"radii_li_chu", "hooke/radii tangential li_chu"},
    {"radii_li_chu_damped", "hooke/radii tangential li_chu damping on"},
    {"radii_li_chu_epsd2", "hooke/radii tangential li_chu rolling_friction epsd2"},
    {"radii_bending", "hooke/radii tangential li_chu rolling_friction li_chu"},
    {"radii_torsion", "hooke/radii tangential li_chu rolling_friction li_chu torsionTorque on"},
    {"radii_torsion_damped",
     "hooke/radii tangential li_chu rolling_friction li_chu torsionTorque on damping on"},
    {"radii_full",
     "hooke/radii tangential li_chu rolling_friction li_chu torsionTorque on rollingFrictionForce on"},
    {"radii_force_alone", "hooke/radii tangential li_chu rollingFrictionForce on"},
    {"radii_symmetric",
     "hooke/radii tangential li_chu rolling_friction li_chu rollingFrictionForce on symmetricCoupling on"},
    {"stiffness", "hooke/stiffness tangential history"},
    {"stiffness_absolute", "hooke/stiffness tangential history absolute_damping on tangential_damping off"},
    {"stiffness_epsd2", "hooke/stiffness tangential history rolling_friction epsd2 limitForce on"},
    {"stiffness_rolling", "hooke/stiffness tangential history rolling_friction li_chu torsionTorque on"},
    {"stiffness_li_chu", "hooke/stiffness tangential li_chu"},
    {"stiffness_full",
     "hooke/stiffness tangential li_chu rolling_friction li_chu rollingFrictionForce on torsionTorque on"},
    {"hertz", "hertz tangential history"},
    {"hertz_epsd2", "hertz tangential history rolling_friction epsd2 tangential_damping off"},
    {"hertz_rolling", "hertz tangential history rolling_friction li_chu"},
    {"hertz_li_chu", "hertz tangential li_chu"},
    {"hertz_torsion", "hertz tangential li_chu rolling_friction li_chu torsionTorque on"},
    {"hertz_full", "hertz tangential li_chu rolling_friction li_chu rollingFrictionForce on limitForce on"}};

}  // namespace polargrain::test
