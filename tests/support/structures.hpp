// SPDX-License-Identifier: GPL-2.0-or-later
// Bodies with interfaces and beams for tests.
#pragma once
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "fem/beam/anchor.hpp"
#include "fem/beam/beam.hpp"
#include "fem/interface/interface.hpp"
#include "fem/material/elastic.hpp"
#include "fem/material/local_material.hpp"
#include "fem/mesh/box.hpp"
#include "fem/mesh/rectangle.hpp"
#include "fem/mesh/split.hpp"
#include "fem/solver/solver.hpp"

namespace polargrain::fem {

inline const TimeTable kZero = TimeTable::constant(0.0);

/// An interface that neither slips nor opens.
inline InterfaceParameters glue(double normal_stiffness, double shear_stiffness) {
  return {.normal_stiffness = normal_stiffness,
          .shear_stiffness = shear_stiffness,
          .cohesion = 1e15,
          .tension = 1e15};
}

template <int dim, class Holds>
void name_nodes(Mesh<dim>& mesh, const std::string& name, Holds holds) {
  for (int node = 0; node < static_cast<int>(mesh.nodes.size()); ++node)
    if (holds(mesh.nodes[static_cast<std::size_t>(node)])) mesh.node_sets[name].push_back(node);
}

/// Moves the corners for which `moves` says so, and puts middle nodes between theirs.
template <int dim>
void distort(
    Mesh<dim>& mesh,
    const std::function<typename Cosserat<dim>::Place(const typename Cosserat<dim>::Place&)>& shift) {
  const auto original = mesh.nodes;
  for (const Element<dim>& element : mesh.elements)
    for (int a = 0; a < element.type->corners; ++a) {
      const auto node = static_cast<std::size_t>(element.nodes[static_cast<std::size_t>(a)]);
      mesh.nodes[node] = original[node] + shift(original[node]);
    }
  for (const Element<dim>& element : mesh.elements)
    for (const ElementSide<dim>& side : element.type->sides) {
      const auto corners = static_cast<std::size_t>(side.type->corners);
      for (std::size_t k = corners; k < side.nodes.size(); ++k) {
        const auto at = [&](int local) -> auto& {
          return mesh.nodes[static_cast<std::size_t>(element.nodes[static_cast<std::size_t>(local)])];
        };
        at(side.nodes[k]) = 0.5 * (at(side.nodes[k - corners]) + at(side.nodes[(k - corners + 1) % corners]));
      }
    }
}

template <int dim>
std::shared_ptr<Material<dim>> elastic_ground(double young, double poisson = 0.25) {
  ElasticParameters<dim> parameters;
  parameters.young_modulus = young;
  parameters.poisson_ratio = poisson;
  parameters.cosserat_shear_modulus = 0.2 * young;
  parameters.internal_length = 0.1;
  return std::make_shared<LocalMaterial<ElasticLaw<dim>>>(ElasticLaw<dim>(parameters));
}

/// Parts the mesh along a curve and joins both sides by an interface.
template <int dim>
std::shared_ptr<Interface<dim>> add_interface(Problem<dim>& problem, const std::string& on,
                                              const InterfaceParameters& parameters) {
  std::vector<std::vector<TwoSidedFace<dim>>> curves{faces_along(problem.mesh, on)};
  split_along(problem.mesh, curves);
  std::vector<InterfaceFace<dim>> faces;
  for (const TwoSidedFace<dim>& face : curves[0])
    faces.push_back(
        {face.type, face.first_nodes, face.second_nodes, {face.first.element, face.second->element}, {}});
  const auto interface =
      std::make_shared<Interface<dim>>(problem.mesh, InterfaceSettings{on, parameters, {}}, std::move(faces));
  problem.contributions.push_back(interface);
  return interface;
}

/// Nodes of their own along an outer boundary, named `body`, with an interface between.
template <int dim>
struct OwnBody {
  OwnNodes<dim> own;
  std::vector<TwoSidedFace<dim>> faces;
  std::shared_ptr<Interface<dim>> interface;
};
template <int dim>
OwnBody<dim> add_body(Problem<dim>& problem, const std::string& on, const InterfaceParameters& parameters) {
  OwnBody<dim> body;
  body.faces = faces_along(problem.mesh, on);
  body.own = add_own_nodes(problem.mesh, body.faces);
  problem.mesh.node_sets["body"] = body.own.nodes;
  std::vector<InterfaceFace<dim>> faces;
  for (std::size_t f = 0; f < body.faces.size(); ++f)
    faces.push_back({body.faces[f].type,
                     body.faces[f].first_nodes,
                     body.own.face_nodes[f],
                     {body.faces[f].first.element},
                     {}});
  body.interface =
      std::make_shared<Interface<dim>>(problem.mesh, InterfaceSettings{on, parameters, {}}, std::move(faces));
  problem.contributions.push_back(body.interface);
  for (const Dof dof : node_dofs<dim>())
    if (is_rotation(dof)) problem.prescribed.push_back({"body", dof, kZero, {}});
  return body;
}

/// A beam on the nodes of faces.
inline std::shared_ptr<Beam> add_beam(Problem<2>& problem, const BeamSection& section,
                                      const std::vector<TwoSidedFace<2>>& faces,
                                      const std::vector<std::vector<int>>& face_nodes) {
  NodalField rotation{.name = kBeamRotation, .unit = "rad", .nodes = {}, .is_motion = true};
  for (const auto& nodes : face_nodes)
    for (const int node : nodes)
      if (std::ranges::find(rotation.nodes, node) == rotation.nodes.end()) rotation.nodes.push_back(node);
  problem.fields.push_back(rotation);
  const auto places = problem.places();
  std::vector<BeamElement> elements;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    BeamElement& element = elements.emplace_back(BeamElement{faces[f].type, face_nodes[f], {}});
    for (const int node : face_nodes[f])
      element.rotations.push_back(places.entry(problem.fields.size() - 1, node));
  }
  const auto beam = std::make_shared<Beam>(problem.mesh, "beam", section, std::move(elements));
  problem.contributions.push_back(beam);
  return beam;
}

/// Holds all nodes that the mesh has now.
template <int dim>
void hold_all(Problem<dim>& problem) {
  std::vector<int>& held = problem.mesh.node_sets["held"];
  for (int node = 0; node < static_cast<int>(problem.mesh.nodes.size()); ++node) held.push_back(node);
  for (const Dof dof : node_dofs<dim>()) problem.prescribed.push_back({"held", dof, kZero, {}});
}

/// A set of the nodes at one place; of those of `among` when that names a set.
template <int dim>
void name_node(Mesh<dim>& mesh, const std::string& name, const typename Cosserat<dim>::Place& place,
               const std::string& among) {
  for (const int node : mesh.nodes_on(among))
    if ((mesh.nodes[static_cast<std::size_t>(node)] - place).norm() < 1e-9)
      mesh.node_sets[name].push_back(node);
}

}  // namespace polargrain::fem
