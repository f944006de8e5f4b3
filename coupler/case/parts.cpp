// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/case/parts.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace polargrain::coupler {

const std::vector<std::string>& dof_names() {
  static const std::vector<std::string> names{"u1", "u2", "w"};
  return names;
}

fem::Dof dof_of(const std::string& name) {
  const auto place = std::find(dof_names().begin(), dof_names().end(), name);
  return static_cast<fem::Dof>(place - dof_names().begin());
}

Dimension dimension_of(fem::Dof dof) {
  return dof == fem::Dof::w ? Dimension::angle : Dimension::length;
}

namespace {

/// The advice on a mesh of Gmsh's without names.
std::string no_groups(const std::string& kind, const std::string& name) {
  return fmt::format(
      "no {0} of it has a name: in the script for Gmsh write Physical {0}(\"{1}\") = {{1}}; with the number of the {0} in "
      "place of the 1 (Tools, Options, Geometry shows them), and make the mesh again",
      kind, name);
}

}  // namespace

void CaseParts::check_places(Section& section, const std::string& key, const std::vector<std::string>& places,
                             const std::string& edge_load) {
  if (!has_mesh) return;
  const fem::Mesh& mesh = result.problem.mesh;
  for (const std::string& place : places) {
    if (!mesh.has_nodes_on(place)) {
      const std::vector<std::string> known = mesh.boundary_and_node_set_names();
      const std::string guess = nearest(place, known);
      section.fault(key, fmt::format("{}: the mesh has no boundary or node set '{}'; {}", key, place,
                                     !guess.empty()            ? "did you mean '" + guess + "'?"
                                     : mesh.boundaries.empty() ? no_groups("Curve", place)
                                                               : "it has " + listed(known)));
    } else if (!edge_load.empty() && !mesh.boundaries.contains(place)) {
      section.fault(key, fmt::format("{}: {} needs a boundary, '{}' is a set of nodes; boundaries are {}",
                                     key, edge_load, place, names_of(mesh.boundaries)));
    }
  }
}

std::string CaseParts::region(Section& section, const std::string& key) {
  if (section.find(key) == nullptr) return {};
  std::string name = section.text(key, "the name of a region");
  if (has_mesh && !name.empty() && !result.problem.mesh.regions.contains(name)) {
    section.fault(key, fmt::format("{}: the mesh has no region '{}'; it has {}", key, name,
                                   names_of(result.problem.mesh.regions)));
  }
  return name;
}

}  // namespace polargrain::coupler
