// SPDX-License-Identifier: GPL-2.0-or-later
// Forces on the nodes of a boundary: each node takes the whole of it.
#include <fmt/format.h>

#include <cmath>

#include "app/remarks/kinds.hpp"

namespace polargrain::app {

void node_forces(const Scene& scene, Remarks& remarks) {
  scene.with_problem([&]<int dim>(const fem::Problem<dim>& problem) {
    const char* const unit = dim == 2 ? "kN/m" : "kN";
    for (const fem::NodeLoad& load : problem.node_loads) {
      const double value = load.value.largest_magnitude();
      if (fem::is_rotation(load.dof) || value == 0.0 || !problem.mesh.boundaries.contains(load.on)) continue;
      const auto nodes = static_cast<double>(problem.mesh.nodes_on(load.on).size());
      if (nodes < 2.0) continue;
      const coupler::Entry* const entry = scene.boundary_value(load.on, "node_force");
      remarks.push_back(
          {Rank::doubtful, nodes,
           (entry != nullptr ? *entry : scene.place({"boundary"}))
               .fault(fmt::format(
                   "boundary: each of the {:.0f} nodes of '{}' takes a force of {:.4g} {}: {:.4g} {} in all",
                   nodes, load.on, 1e-3 * value, unit, 1e-3 * nodes * value, unit)),
           "give a pressure or a traction, whose sum does not depend on the mesh; or name a set of single nodes"});
    }
  });
}

}  // namespace polargrain::app
