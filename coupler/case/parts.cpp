// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/case/parts.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace polargrain::coupler {

namespace {

template <int dim>
std::vector<std::string> names_of_dofs() {
  std::vector<std::string> names;
  for (const fem::Dof dof : fem::node_dofs<dim>()) names.emplace_back(fem::name_of<dim>(dof));
  return names;
}

}  // namespace

const std::vector<std::string>& dof_names(int dimension) {
  static const std::vector<std::string> plane = names_of_dofs<2>();
  static const std::vector<std::string> space = names_of_dofs<3>();
  return dimension == 2 ? plane : space;
}

std::vector<std::string> known_dofs(const CaseParts& parts) {
  std::vector<std::string> names = dof_names(parts.result.dimension());
  if (!parts.has_mesh)
    for (const std::string& name : dof_names(3))
      if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  return names;
}

fem::Dof dof_of(const std::string& name) {
  for (const fem::Dof dof : fem::node_dofs<3>())
    if (fem::name_of<3>(dof) == name) return dof;
  return fem::Dof::w;
}

Dimension dimension_of(fem::Dof dof) {
  return fem::is_rotation(dof) ? Dimension::angle : Dimension::length;
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
  result.with_problem([&](const auto& problem) {
    const auto& mesh = problem.mesh;
    for (const std::string& place : places) {
      if (!mesh.has_nodes_on(place)) {
        const std::vector<std::string> known = mesh.boundary_and_node_set_names();
        const std::string guess = nearest(place, known);
        section.fault(key,
                      fmt::format("{}: the mesh has no boundary or node set '{}'; {}", key, place,
                                  !guess.empty() ? "did you mean '" + guess + "'?"
                                  : mesh.boundaries.empty()
                                      ? no_groups(mesh.nodes.front().size() == 3 ? "Surface" : "Curve", place)
                                      : "it has " + listed(known)));
      } else if (!edge_load.empty() && !mesh.boundaries.contains(place)) {
        section.fault(key, fmt::format("{}: {} needs a boundary, '{}' is a set of nodes; boundaries are {}",
                                       key, edge_load, place, names_of(mesh.boundaries)));
      }
    }
  });
}

CaseParts::Counts CaseParts::counts() const {
  return result.with_problem([](const auto& problem) {
    return Counts{problem.prescribed.size(), problem.boundary_loads.size(),    problem.node_loads.size(),
                  problem.body_loads.size(), problem.prescribed_fields.size(), problem.contributions.size()};
  });
}

void CaseParts::take_structure_name(Section& all, const std::string& name) {
  all.find(name);
  if (!structure_names.insert(name).second)
    all.fault(name, fmt::format("{}: another interface, beam or anchor has this name", name));
}

void CaseParts::add_structure(const std::string& name, Structure::Kind kind, const std::string& along) {
  Structure& one = structures.try_emplace(name, Structure{kind, {}, along}).first->second;
  one.contributions.push_back(counts().back());
}

std::string CaseParts::region(Section& section, const std::string& key) {
  if (section.find(key) == nullptr) return {};
  std::string name = section.text(key, "the name of a region");
  result.with_problem([&](const auto& problem) {
    if (!has_mesh || name.empty() || problem.mesh.regions.contains(name)) return;
    section.fault(key, fmt::format("{}: the mesh has no region '{}'; it has {}", key, name,
                                   names_of(problem.mesh.regions)));
  });
  return name;
}

}  // namespace polargrain::coupler
