// SPDX-License-Identifier: GPL-2.0-or-later
// Forces on the nodes of a boundary: each node takes the whole of it.
#include <fmt/format.h>

#include <cmath>

#include "app/remarks/kinds.hpp"

namespace polargrain::app {

void node_forces(const Scene& scene, Remarks& remarks) {
  for (const fem::NodeLoad& load : scene.problem().node_loads) {
    const double value = load.value.largest_magnitude();
    if (load.dof == fem::Dof::w || value == 0.0 || !scene.mesh().boundaries.contains(load.on)) continue;
    const auto nodes = static_cast<double>(scene.mesh().nodes_on(load.on).size());
    if (nodes < 2.0) continue;
    const coupler::Entry* const entry = scene.boundary_value(load.on, "node_force");
    remarks.push_back(
        {Rank::doubtful, nodes,
         (entry != nullptr ? *entry : scene.place({"boundary"}))
             .fault(fmt::format(
                 "boundary: each of the {:.0f} nodes of '{}' takes a force of {:.4g} kN/m: {:.4g} kN/m in all",
                 nodes, load.on, 1e-3 * value, 1e-3 * nodes * value)),
         "give a pressure or a traction, whose sum does not depend on the mesh; or name a set of single nodes"});
  }
}

}  // namespace polargrain::app
