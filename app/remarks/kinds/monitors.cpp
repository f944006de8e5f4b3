// SPDX-License-Identifier: GPL-2.0-or-later
// Monitors and measures of places where nothing can be read.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "app/remarks/kinds.hpp"
#include "app/remarks/outline.hpp"

namespace polargrain::app {
namespace {

/// Nodes at which a degree of freedom is prescribed, and those that move all the same: the value is not zero, it is prescribed in
/// some stages alone, or the boundary is quiet.
struct Given {
  std::set<int> held;
  std::set<int> moved;
};

template <int dim>
Given given(const fem::Problem<dim>& problem, fem::Dof dof) {
  Given nodes;
  for (const fem::PrescribedDof<dim>& item : problem.prescribed) {
    if (item.dof != dof) continue;
    for (const int node : problem.mesh.nodes_on(item.on)) {
      nodes.held.insert(node);
      if (item.value.largest_magnitude() > 0.0 || !item.life.is_whole()) nodes.moved.insert(node);
    }
  }
  // In real time they are let go once the start is balanced.
  for (const std::string& boundary : problem.quiet)
    for (const int node : problem.mesh.nodes_on(boundary)) {
      nodes.held.insert(node);
      nodes.moved.insert(node);
    }
  return nodes;
}

template <int dim>
void look_at_reaction(const Scene& scene, const fem::Problem<dim>& problem, const coupler::Monitor& monitor,
                      Remarks& remarks) {
  const Given nodes = given(problem, monitor.dof);
  const std::vector<int> on = problem.mesh.nodes_on(monitor.on);
  const auto held = std::ranges::count_if(on, [&](int node) { return nodes.held.contains(node); });
  // Ends of a boundary are held by its neighbours.
  if (2 * held >= static_cast<std::ptrdiff_t>(on.size()) || !problem.ties.empty()) return;
  const coupler::Entry& place = scene.place({"monitors", monitor.name});
  const auto dof = fem::name_of<dim>(monitor.dof);
  const std::string seen =
      held == 0
          ? fmt::format(
                "monitor '{}': {} is free at all of its nodes, and only supports exert a reaction: it stays zero",
                monitor.name, dof)
          : fmt::format(
                "monitor '{}': {} is prescribed at {} of its {} nodes only, ends that other boundaries hold: the reaction is theirs",
                monitor.name, dof, held, on.size());
  remarks.push_back({Rank::wrong, 10.0, place.fault(seen),
                     "read the reaction on the boundary that is held or moved along it"});
}

template <int dim>
void look_at_displacement(const Scene& scene, const fem::Problem<dim>& problem,
                          const coupler::Monitor& monitor, Remarks& remarks) {
  const Given nodes = given(problem, monitor.dof);
  const std::vector<int> on = problem.mesh.nodes_on(monitor.on);
  const bool stays = std::ranges::all_of(
      on, [&](int node) { return nodes.held.contains(node) && !nodes.moved.contains(node); });
  if (!stays) return;
  remarks.push_back(
      {Rank::wrong, 10.0,
       scene.place({"monitors", monitor.name})
           .fault(fmt::format(
               "monitor '{}': {} is fixed at all of its nodes: the displacement stays zero, and so does a strain "
               "made of it",
               monitor.name, fem::name_of<dim>(monitor.dof))),
       "read the displacement of the boundary that moves"});
}

/// Couples at the nodes of a foot, beside which its forces have a moment too. On a plate that moves they are meant.
/// @param held nodes that do not move
template <int dim>
void look_at_couples(const Scene& scene, const fem::Mesh<dim>& mesh, const HeldNodes<dim>& held,
                     const coupler::Monitor& monitor, Remarks& remarks) {
  const std::vector<int> on = mesh.nodes_on(monitor.on);
  if (!fem::is_rotation(monitor.dof) || on.size() < 2) return;
  const bool has_forces = std::ranges::any_of(on, [&](int node) {
    return std::ranges::find(held[static_cast<std::size_t>(node)], true) !=
           held[static_cast<std::size_t>(node)].end();
  });
  if (!has_forces) return;
  remarks.push_back(
      {Rank::doubtful, 2.0,
       scene.place({"monitors", monitor.name})
           .fault(fmt::format(
               "monitor '{}': the reaction of {} is the sum of the couples at the nodes, without the moment of "
               "the forces there",
               monitor.name, fem::name_of<dim>(monitor.dof))),
       "for the whole moment add, in a formula, the reactions of parts of the boundary times their distances; of a beam "
       "read {beam: NAME, value: moment}"});
}

}  // namespace

void monitors(const Scene& scene, Remarks& remarks) {
  scene.the_case().with_problem([&](const auto& problem) {
    const auto held = held_nodes(problem, Movers::left_out);
    for (const coupler::Monitor& monitor : scene.the_case().monitors) {
      if (monitor.kind == coupler::Monitor::Kind::reaction) {
        look_at_reaction(scene, problem, monitor, remarks);
        look_at_couples(scene, problem.mesh, held, monitor, remarks);
      }
      if (monitor.kind == coupler::Monitor::Kind::displacement)
        look_at_displacement(scene, problem, monitor, remarks);
    }
  });
}

void measures(const Scene& scene, Remarks& remarks) {
  for (const coupler::StepTarget& target : scene.the_case().plan) {
    if (target.control != coupler::StepTarget::Control::measure || target.measure.terms.empty()) continue;
    const Given nodes = scene.with_problem(
        [&](const auto& problem) { return given(problem, target.measure.terms.front().dof); });
    const bool free = std::ranges::any_of(target.measure.terms,
                                          [&](const auto& term) { return !nodes.held.contains(term.node); });
    const bool moved = std::ranges::any_of(target.measure.terms,
                                           [&](const auto& term) { return nodes.moved.contains(term.node); });
    if (free || moved) continue;
    remarks.push_back(
        {Rank::wrong, 10.0,
         scene.place({"steps", "stages"})
             .fault("steps: the measure of a stage is of places that are fixed: it cannot grow"),
         "measure a boundary that moves"});
    return;
  }
}

void output(const Scene& scene, Remarks& remarks) {
  const coupler::Case& the_case = scene.the_case();
  if (the_case.output_every <= the_case.steps()) return;
  remarks.push_back(
      {Rank::costly, static_cast<double>(the_case.output_every) / the_case.steps(),
       scene.place({"output", "every"})
           .fault(fmt::format(
               "output: fields are written every {} steps, and there are {}: no field between start and end is written",
               the_case.output_every, the_case.steps())),
       fmt::format("every: {} or less", std::max(1, the_case.steps() / 4))});
}

}  // namespace polargrain::app
