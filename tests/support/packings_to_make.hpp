// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <optional>

#include "common/packing_specification.hpp"
#include "tests/support/cell_fixture.hpp"
#include "tests/support/plane_cells.hpp"

namespace polargrain::dem {

/// Discs of 3 to 7 mm under 100 kPa.
inline PackingSpecification specification(int grains, double friction) {
  PackingSpecification made;
  made.script_file = "liggghts_inputs/cells/hooke_radii.in";
  made.script = test::file_text(made.script_file);
  made.grains = grains;
  made.sizes.radii = {3e-3, 7e-3};
  made.density = 2650.0;
  made.thickness = 0.1;
  made.pressure = 1e5;
  made.friction = friction;
  made.seed = 3;
  return made;
}

/// Spheres of these sizes.
inline PackingSpecification in_space(int grains, double friction) {
  PackingSpecification made = specification(grains, friction);
  made.script_file = "liggghts_inputs/cells/spheres_hooke_radii.in";
  made.script = test::file_text(made.script_file);
  made.dimension = 3;
  made.spheres = true;
  made.thickness = 0.0;
  return made;
}

/// Spheres with rolling resistance, whose script can be made with any friction up to its own.
inline PackingSpecification rolling_spheres(int grains, double friction, std::optional<double> rolling = {}) {
  PackingSpecification made = in_space(grains, friction);
  made.script_file = "liggghts_inputs/cells/spheres_li_chu.in";
  made.script = test::file_text(made.script_file);
  made.rolling_friction = rolling;
  made.damping = kDampingInSpace;
  return made;
}

/// The stress that a cell finds when it starts from a packing, Pa.
inline Eigen::Matrix3d stress_in_a_cell(const PackingSpecification& asked, const PreparedPacking& made) {
  CellDefinition definition;
  definition.name = "made";
  definition.script_file = asked.script_file;
  definition.script = asked.script;
  definition.packing = made.packing;
  definition.control.tangent = CellTangent::none;
  return make_cell_service(definition)->initial().response.stress;
}

}  // namespace polargrain::dem
