// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "fem/solver/problem.hpp"
#include "fem/solver/stabilisation.hpp"

namespace polargrain::fem {
namespace {

using Messages = std::vector<std::string>;

template <class Map>
std::string names_of(const Map& map) {
  Messages names;
  for (const auto& [name, value] : map) names.push_back(name);
  return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
}

template <int dim>
void check_names(const Problem<dim>& problem, Messages& messages) {
  const Mesh<dim>& mesh = problem.mesh;
  const auto check_nodes = [&](const std::string& on) {
    if (mesh.has_nodes_on(on)) return;
    messages.push_back(fmt::format("the mesh has no boundary or node set '{}'; it has {}", on,
                                   fmt::join(mesh.boundary_and_node_set_names(), ", ")));
  };
  for (const PrescribedDof<dim>& item : problem.prescribed) check_nodes(item.on);
  for (const NodeLoad& item : problem.node_loads) check_nodes(item.on);
  for (const BoundaryLoad<dim>& item : problem.boundary_loads) {
    if (mesh.boundaries.contains(item.on)) continue;
    messages.push_back(
        fmt::format("a pressure or traction needs a boundary, '{}' is not a boundary; the mesh has {}",
                    item.on, names_of(mesh.boundaries)));
  }
  for (const BodyLoad<dim>& item : problem.body_loads) {
    if (item.region.empty() || mesh.regions.contains(item.region)) continue;
    messages.push_back(fmt::format("the mesh has no region '{}' for a body load; it has {}", item.region,
                                   names_of(mesh.regions)));
  }
  for (const InitialStress<dim>& item : problem.initial_stresses) {
    if (item.region.empty() || mesh.regions.contains(item.region)) continue;
    messages.push_back(fmt::format("the mesh has no region '{}' for an initial stress; it has {}",
                                   item.region, names_of(mesh.regions)));
  }
  for (const auto& [region, life] : problem.lifetimes) {
    if (mesh.regions.contains(region)) continue;
    messages.push_back(fmt::format("the mesh has no region '{}' to place or remove; it has {}", region,
                                   names_of(mesh.regions)));
  }
}

template <int dim>
void check_materials(const Problem<dim>& problem, Messages& messages) {
  const Mesh<dim>& mesh = problem.mesh;
  std::vector<int> times(mesh.elements.size(), 0);
  for (const auto& [region, material] : problem.materials) {
    const auto elements = mesh.regions.find(region);
    if (elements == mesh.regions.end()) {
      messages.push_back(fmt::format("the mesh has no region '{}' for a material; it has {}", region,
                                     names_of(mesh.regions)));
      continue;
    }
    for (const int e : elements->second) ++times[static_cast<std::size_t>(e)];
  }
  std::size_t none = 0;
  std::size_t several = 0;
  for (const int n : times) {
    none += n == 0 ? 1 : 0;
    several += n > 1 ? 1 : 0;
  }
  if (none > 0) messages.push_back(fmt::format("{} elements have no material: name their region", none));
  if (several > 0) {
    messages.push_back(
        fmt::format("{} elements have more than one material: the regions named overlap", several));
  }
}

/// The first item that gives each (node, dof) its value.
template <int dim>
using GivenValues = std::map<std::pair<int, Dof>, const PrescribedDof<dim>*>;

template <int dim>
bool gives_alike(const Problem<dim>& problem, const PrescribedDof<dim>& a, int node_a,
                 const PrescribedDof<dim>& b, int node_b) {
  const auto factor = [&](const PrescribedDof<dim>& item, int node) {
    return item.profile ? item.profile(problem.mesh.nodes[static_cast<std::size_t>(node)]) : 1.0;
  };
  // Values that count from the beginning of another stage are other values; where both are zero, both hold the node.
  const bool alike = (a.life.begin == b.life.begin && a.from_here == b.from_here) ||
                     (a.value.largest_magnitude() == 0.0 && b.value.largest_magnitude() == 0.0);
  return alike && a.value == b.value && factor(a, node_a) == factor(b, node_b);
}

template <int dim>
bool gives_alike(const Problem<dim>& problem, const PrescribedField<dim>& a, const PrescribedField<dim>& b,
                 int node) {
  const typename Cosserat<dim>::Place& x = problem.mesh.nodes[static_cast<std::size_t>(node)];
  return a.value == b.value && a.factor_at(x) == b.factor_at(x) && a.offset_at(x) == b.offset_at(x);
}

/// Sets of single nodes are made to say something of those nodes; `all` says what holds where nothing else does.
template <int dim>
int precedence(const Mesh<dim>& mesh, const std::string& on) {
  if (on == "all") return 2;
  return mesh.boundaries.contains(on) ? 1 : 0;
}

template <int dim, class Item>
std::vector<const Item*> sorted_by_precedence(const Mesh<dim>& mesh, const std::vector<Item>& given) {
  std::vector<const Item*> items;
  for (const Item& item : given) items.push_back(&item);
  std::ranges::stable_sort(items, {}, [&](const Item* item) { return precedence(mesh, item->on); });
  return items;
}

/// A set of nodes by which a node can be named: the smallest it is in.
template <int dim>
std::string set_of(const Mesh<dim>& mesh, int node) {
  const std::pair<const std::string, std::vector<int>>* smallest = nullptr;
  for (const auto& set : mesh.node_sets) {
    if (set.first == "all" || std::ranges::find(set.second, node) == set.second.end()) continue;
    if (smallest == nullptr || set.second.size() < smallest->second.size()) smallest = &set;
  }
  return smallest == nullptr ? "a physical point of the mesh there" : "'" + smallest->first + "'";
}

template <int dim>
GivenValues<dim> check_prescribed_once(const Problem<dim>& problem, int stage, Messages& messages) {
  GivenValues<dim> first;
  for (const PrescribedDof<dim>* const given : in_precedence(problem, stage)) {
    const PrescribedDof<dim>& item = *given;
    if (!problem.mesh.has_nodes_on(item.on)) continue;
    bool told = false;
    for (const int node : problem.mesh.nodes_on(item.on)) {
      const auto [place, added] = first.try_emplace({node, item.dof}, &item);
      const PrescribedDof<dim>& other = *place->second;
      if (added || told || precedence(problem.mesh, other.on) != precedence(problem.mesh, item.on) ||
          gives_alike(problem, other, node, item, node))
        continue;
      const typename Cosserat<dim>::Place& at = problem.mesh.nodes[static_cast<std::size_t>(node)];
      messages.push_back(fmt::format(
          "{} is given two different values at the node {}, on '{}' and on "
          "'{}': give it once there, or give that node an item of its own, on {}: a set of nodes goes before "
          "boundaries",
          name_of<dim>(item.dof), place_text<dim>(at), other.on, item.on, set_of(problem.mesh, node)));
      told = true;
    }
  }
  return first;
}

/// Ground is one body along a wall or an interface that has not come yet: a movement of one node there moves the others too
/// (Constraints), so two values at one place cannot be.
template <int dim>
void check_ground_in_one(const Problem<dim>& problem, const GivenValues<dim>& given, int stage,
                         Messages& messages) {
  const std::vector<char> has_element = nodes_of_elements(problem.mesh, {});
  const auto at = [](int node) { return static_cast<std::size_t>(node); };
  for (const auto& contribution : problem.contributions) {
    std::map<int, std::vector<int>> in_one;
    for (const auto& [one, other] : contribution->tied_nodes(stage))
      if (has_element[at(one)] != 0 && has_element[at(other)] != 0) in_one[one].push_back(other);
    for (const Dof dof : node_dofs<dim>())
      for (const auto& [node, others] : in_one)
        for (const int other : others) {
          const auto a = given.find({node, dof});
          const auto b = given.find({other, dof});
          if (a == given.end() || b == given.end() ||
              gives_alike(problem, *a->second, node, *b->second, other))
            continue;
          messages.push_back(fmt::format(
              "{} is given two different values at {}, on '{}' and on '{}', where the ground is one body until "
              "{} comes; give it once there",
              name_of<dim>(dof), place_text<dim>(problem.mesh.nodes[at(node)]), a->second->on, b->second->on,
              contribution->name()));
          return;
        }
  }
}

/// A support of one side of a tie must hold the other alike.
template <int dim>
void check_ties(const Problem<dim>& problem, const GivenValues<dim>& given, int stage, Messages& messages) {
  check_ground_in_one(problem, given, stage, messages);
  const Mesh<dim>& mesh = problem.mesh;
  const auto item_at = [&](int node, Dof dof) {
    const auto place = given.find({node, dof});
    return place == given.end() ? nullptr : place->second;
  };
  for (const Tie& tie : problem.ties) {
    const TiedNodes tied = tied_nodes<dim>(mesh, tie);
    if (!tied.fault.empty()) messages.push_back("tie: " + tied.fault);
    for (const Dof dof : node_dofs<dim>()) {
      for (const auto& [follower, leader] : tied.pairs) {
        const PrescribedDof<dim>* a = item_at(follower, dof);
        const PrescribedDof<dim>* b = item_at(leader, dof);
        if (a == nullptr && b == nullptr) continue;
        if (a != nullptr && b != nullptr && gives_alike(problem, *a, follower, *b, leader)) continue;
        const typename Cosserat<dim>::Place& at =
            mesh.nodes[static_cast<std::size_t>(a != nullptr ? follower : leader)];
        messages.push_back(fmt::format(
            "{} is given at the node {}, and not alike at the node it is tied to ('{}' to '{}'): give it "
            "on both sides or on neither",
            name_of<dim>(dof), place_text<dim>(at), tie.on, tie.to));
        break;
      }
    }
  }
}

/// Whether a pressure is zero until a later stage leaves no ground on both sides of where it acts.
template <int dim>
bool waits_for_its_side(const Problem<dim>& problem, const BoundaryLoad<dim>& load, int stage) {
  const auto count = static_cast<int>(problem.stage_starts.size());
  for (int later = stage + 1; later < count; ++later) {
    if (!covered_sides(problem.mesh, sides_in_stage(problem, load, later), elements_in_stage(problem, later))
             .empty())
      continue;
    const double begin = problem.stage_starts[static_cast<std::size_t>(later)];
    return std::isfinite(begin) && load.pressure.largest_magnitude_until(begin) == 0.0;
  }
  return false;
}

/// A pressure that begins with a stage pushes against an outward normal, which a side between two elements has not. Ground that
/// covers the side later takes the load away.
template <int dim>
void check_pressures(const Problem<dim>& problem, int stage, Messages& messages) {
  for (const BoundaryLoad<dim>& load : problem.boundary_loads) {
    if (load.life.begin != stage || load.pressure.largest_magnitude() == 0.0 ||
        !problem.mesh.boundaries.contains(load.on))
      continue;
    const std::vector<BoundarySide> covered =
        covered_sides(problem.mesh, sides_in_stage(problem, load, stage), elements_in_stage(problem, stage));
    if (covered.empty() || waits_for_its_side(problem, load, stage)) continue;
    const std::vector<int> nodes = problem.mesh.side_nodes(covered.front());
    messages.push_back(fmt::format(
        "the pressure on '{}' has ground on both sides at {}: it has no side to act from; let it begin in the "
        "stage that removes one side, or give 'traction', which has a direction",
        load.on, place_text<dim>(problem.mesh.nodes[static_cast<std::size_t>(nodes.front())])));
  }
}

/// The faults that a later stage of construction has of its own.
template <int dim>
void check_stage(const Problem<dim>& problem, int stage, Messages& messages) {
  const std::vector<char> there = elements_in_stage(problem, stage);
  if (!there.empty() && std::ranges::find(there, 1) == there.end()) {
    messages.emplace_back("no element is left");
    return;
  }
  check_ties(problem, check_prescribed_once(problem, stage, messages), stage, messages);
  for (const BoundaryLoad<dim>& load : problem.boundary_loads) {
    if (load.life.begin != stage || !sides_in_stage(problem, load, stage).empty()) continue;
    messages.push_back(fmt::format(
        "the load on '{0}' begins here, where '{0}' is no boundary of what is there: the elements on both of its sides are "
        "there, or neither; let it begin with the stage that removes or places one side",
        load.on));
  }
  check_pressures(problem, stage, messages);
  for (const std::string& motion : free_rigid_motions(problem, stage)) {
    messages.push_back(fmt::format(
        "the supports of this stage leave a rigid motion of what is there free: {}; give a support that holds it",
        motion));
  }
}

template <int dim>
void check_contributions(const Problem<dim>& problem, int stage, Messages& messages) {
  for (const auto& contribution : problem.contributions)
    if (contribution->life.holds(stage))
      for (std::string& message : contribution->faults_of_stage(problem, stage))
        messages.push_back(std::move(message));
}

/// Nodes that share one unknown must not be given it.
template <int dim>
void check_equal_dofs(const Problem<dim>& problem, const GivenValues<dim>& given, Messages& messages) {
  for (const EqualDof& equal : problem.equal_dofs) {
    if (!problem.mesh.has_nodes_on(equal.on)) {
      messages.push_back(fmt::format("the mesh has no boundary or node set '{}'; it has {}", equal.on,
                                     fmt::join(problem.mesh.boundary_and_node_set_names(), ", ")));
      continue;
    }
    for (const int node : problem.mesh.nodes_on(equal.on)) {
      if (!given.contains({node, equal.dof})) continue;
      messages.push_back(
          fmt::format("{} is to be equal on '{}' and is given at the node {} of it: leave out "
                      "one of the two",
                      name_of<dim>(equal.dof), equal.on,
                      place_text<dim>(problem.mesh.nodes[static_cast<std::size_t>(node)])));
      break;
    }
  }
}

/// The fields as they are declared. @returns whether they can be numbered
template <int dim>
bool check_fields(const Problem<dim>& problem, Messages& messages) {
  const std::size_t before = messages.size();
  for (std::size_t k = 0; k < problem.fields.size(); ++k) {
    const NodalField& field = problem.fields[k];
    if (number_of_field(problem.fields, field.name) != k)
      messages.push_back(fmt::format("two nodal fields are named '{}'", field.name));
    std::vector<char> seen(problem.mesh.nodes.size(), 0);
    for (const int node : field.nodes) {
      const auto number = static_cast<std::size_t>(node);
      if (node < 0 || number >= seen.size() || seen[number]++ != 0) {
        messages.push_back(fmt::format("the field '{}' names node {} twice, or the mesh has no such node",
                                       field.name, node));
        break;
      }
    }
    if (!field.initial.empty() && field.initial.size() != field.nodes.size())
      messages.push_back(fmt::format("the field '{}' has {} nodes and {} values at time 0", field.name,
                                     field.nodes.size(), field.initial.size()));
  }
  return messages.size() == before;
}

template <int dim>
void check_prescribed_fields(const Problem<dim>& problem, int stage, Messages& messages) {
  const FieldPlaces<dim> places = problem.places();
  std::map<int, const PrescribedField<dim>*> first;
  for (const PrescribedField<dim>* const item : fields_in_precedence(problem, stage)) {
    const std::size_t field = number_of_field(problem.fields, item->field);
    if (field == problem.fields.size()) {
      messages.push_back(
          fmt::format("there is no nodal field '{}' to be given on '{}'", item->field, item->on));
      continue;
    }
    if (!problem.mesh.has_nodes_on(item->on)) {
      messages.push_back(fmt::format("the mesh has no boundary or node set '{}'; it has {}", item->on,
                                     fmt::join(problem.mesh.boundary_and_node_set_names(), ", ")));
      continue;
    }
    bool any = false;
    bool told = false;
    for (const int node : problem.mesh.nodes_on(item->on)) {
      const int entry = places.entry(field, node);
      if (entry < 0) continue;
      any = true;
      const auto [place, added] = first.try_emplace(entry, item);
      const PrescribedField<dim>& other = *place->second;
      if (added || told || precedence(problem.mesh, other.on) != precedence(problem.mesh, item->on) ||
          gives_alike(problem, other, *item, node))
        continue;
      messages.push_back(fmt::format(
          "'{}' is given two different values at the node {}, on '{}' and on '{}': give that node an item of "
          "its own, on {}: a set of nodes goes before boundaries",
          item->field, place_text<dim>(problem.mesh.nodes[static_cast<std::size_t>(node)]), other.on,
          item->on, set_of(problem.mesh, node)));
      told = true;
    }
    if (!any)
      messages.push_back(
          fmt::format("no node of '{}' carries the field '{}', which is given there", item->on, item->field));
  }
}

}  // namespace

template <int dim>
std::vector<const PrescribedDof<dim>*> in_precedence(const Problem<dim>& problem, int stage) {
  std::vector<const PrescribedDof<dim>*> items = sorted_by_precedence(problem.mesh, problem.prescribed);
  std::erase_if(items, [&](const PrescribedDof<dim>* item) { return !item->life.holds(stage); });
  return items;
}

template <int dim>
std::vector<const PrescribedField<dim>*> fields_in_precedence(const Problem<dim>& problem, int stage) {
  std::vector<const PrescribedField<dim>*> items =
      sorted_by_precedence(problem.mesh, problem.prescribed_fields);
  std::erase_if(items, [&](const PrescribedField<dim>* item) { return !item->life.holds(stage); });
  return items;
}

template <int dim>
Messages faults(const Problem<dim>& problem) {
  Messages messages;
  if (problem.mesh.elements.empty()) return {"the mesh has no elements"};
  check_names(problem, messages);
  check_materials(problem, messages);
  const bool has_stages = problem.stages.size() > 1;
  if (!messages.empty() && has_stages) return messages;  // names that a stage needs are missing
  const GivenValues<dim> given = check_prescribed_once(problem, 0, messages);
  check_ties(problem, given, 0, messages);
  check_pressures(problem, 0, messages);
  check_equal_dofs(problem, given, messages);
  const bool has_fields = check_fields(problem, messages);
  if (has_fields) check_prescribed_fields(problem, 0, messages);
  for (const auto& contribution : problem.contributions) {
    for (std::string& message : contribution->faults(problem))
      messages.push_back(contribution->name() + ": " + std::move(message));
    if (has_stages && !contribution->takes_stages())
      messages.push_back("stages of construction do not take " + contribution->name() + " yet");
  }
  check_contributions(problem, 0, messages);
  if (has_stages && Stabilisation<dim>::of(problem.mesh, problem.continuum, problem.deformation))
    messages.push_back(
        "stages of construction do not take elements with one integration point yet; take those with more, such as Q8R, H8 or H20R");
  for (std::string& message : distorted_elements(problem.mesh)) messages.push_back(std::move(message));
  for (const std::string& motion : free_rigid_motions(problem, 0)) {
    messages.push_back(
        fmt::format("the supports leave a rigid motion free: {}; give a support that holds it", motion));
  }
  for (std::size_t stage = 1; stage < problem.stages.size(); ++stage) {
    Messages own;
    check_stage(problem, static_cast<int>(stage), own);
    check_contributions(problem, static_cast<int>(stage), own);
    if (has_fields) check_prescribed_fields(problem, static_cast<int>(stage), own);
    for (const std::string& message : own)
      if (std::ranges::find(messages, message) == messages.end())
        messages.push_back(fmt::format("stage '{}': {}", problem.stages[stage], message));
  }
  return messages;
}

template std::vector<const PrescribedDof<2>*> in_precedence<2>(const Problem<2>& problem, int stage);
template std::vector<const PrescribedDof<3>*> in_precedence<3>(const Problem<3>& problem, int stage);
template std::vector<const PrescribedField<2>*> fields_in_precedence<2>(const Problem<2>& problem, int stage);
template std::vector<const PrescribedField<3>*> fields_in_precedence<3>(const Problem<3>& problem, int stage);
template Messages faults<2>(const Problem<2>& problem);
template Messages faults<3>(const Problem<3>& problem);

}  // namespace polargrain::fem
