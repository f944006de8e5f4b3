// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Every combination of contact models that the loop over spheres knows.
#include <ostream>
#include <string>
#include <vector>

#include "tests/support/contact_models.hpp"
#include "tests/support/sphere_cells.hpp"

namespace polargrain::test {

struct ModelsOfSphereLoop {
  std::string name;
  std::string style;  ///< words behind `pair_style gran model`
};

inline void PrintTo(const ModelsOfSphereLoop& models, std::ostream* stream) {
  *stream << models.style;
}

inline const ModelValues kValuesOfSpheres{
    "3000",  "2000",
    "2",     "1",
    "0.1",   "hard_particles yes\nfix youngsModulus all property/global youngsModulus peratomtype 5e9\n",
    "1.5e-6"};

/// The spheres of the demonstration with other contact models.
inline CellDefinition sphere_cell_of(const std::string& style) {
  return under_models(linear_spheres(), model_commands(style, kValuesOfSpheres));
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
    {"radii_rolling_damped",
     "hooke/radii tangential history rolling_friction li_chu torsionTorque on rollingDamping on"},
    {"radii_all_dashpots",
     "hooke/radii tangential li_chu rolling_friction li_chu torsionTorque on damping on rollingDamping on "
     "rollingFrictionForce on rollingFrictionForceDamping on"},
    {"radii_symmetric_damped",
     "hooke/radii tangential li_chu rolling_friction li_chu rollingDamping on rollingFrictionForce on symmetricCoupling on"},
    {"radii_symmetric_force_damped",
     "hooke/radii tangential li_chu rolling_friction li_chu rollingFrictionForce on rollingFrictionForceDamping on symmetricCoupling on"},
    {"hertz_dashpots",
     "hertz tangential li_chu rolling_friction li_chu rollingDamping on rollingFrictionForce on rollingFrictionForceDamping on"},
    {"hertz_symmetric",
     "hertz tangential li_chu rolling_friction li_chu rollingFrictionForce on symmetricCoupling on"},
    {"hertz_history_damped", "hertz tangential history rolling_friction li_chu rollingDamping on"},
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
    {"hertz_full", "hertz tangential li_chu rolling_friction li_chu rollingFrictionForce on limitForce on"},
    {"hertz_symmetric_damped",
     "hertz tangential li_chu rolling_friction li_chu rollingDamping on rollingFrictionForce on "
     "rollingFrictionForceDamping on symmetricCoupling on"}};

}  // namespace polargrain::test
