// SPDX-License-Identifier: GPL-2.0-or-later
// Interfaces, beams and anchors against the ground beside them.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "app/remarks/in_units.hpp"
#include "app/remarks/kinds.hpp"
#include "app/remarks/lengths.hpp"
#include "app/remarks/outline.hpp"
#include "fem/beam/beam.hpp"

namespace polargrain::app {
namespace {

using coupler::Dimension;
using coupler::Entry;

/// Of the confined modulus of the element beside it over its size. Below, two bodies sink into each other by as much as the
/// element is compressed.
constexpr double kSoftInterface = 1.0;
/// Beyond it a gap of a millionth of the element decides whether the interface carries.
constexpr double kHardInterface = 1e6;
constexpr double kThickBeam = 5.0;    // m
constexpr double kThinBeam = 0.5e-3;  // m
constexpr double kStiffBeam = 250e9;  // Pa: steel has 210

/// Confined modulus of a region, Pa; nothing where it is not known.
std::optional<double> confined_modulus(const Scene& scene, const SceneRegion& region) {
  double shear = 0.0;
  double poisson = 0.0;
  if (region.cell == nullptr) {
    const auto young = scene.quantity({"materials", region.material, "E"}, Dimension::pressure);
    const auto ratio = scene.quantity({"materials", region.material, "nu"}, Dimension::number);
    if (!young || !ratio) return {};
    poisson = *ratio;
    shear = 0.5 * *young / (1.0 + poisson);
  } else if (region.packing != nullptr) {
    shear = region.packing->moduli.shear;
    poisson = region.packing->moduli.poisson;
  }
  if (!(shear > 0.0) || !(poisson < 0.5)) return {};
  return 2.0 * shear * (1.0 - poisson) / (1.0 - 2.0 * poisson);
}

/// The ground beside a curve.
struct Beside {
  double stiffness = 0.0;  ///< largest confined modulus over the size of its element, Pa/m
  double friction = 0.0;   ///< largest friction angle, rad; 0: not known
  std::string material = {};
};

template <int dim>
Beside beside(const Scene& scene, const fem::Mesh<dim>& mesh, const std::string& on) {
  std::vector<int> nodes = mesh.nodes_on(on);
  std::ranges::sort(nodes);
  Beside found;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    const auto shared = std::ranges::count_if(
        mesh.elements[e].nodes, [&](int node) { return std::ranges::binary_search(nodes, node); });
    if (shared < dim) continue;  // a side has so many corners at least
    const SceneRegion& region = scene.region_of(static_cast<int>(e));
    if (const auto modulus = confined_modulus(scene, region))
      found.stiffness = std::max(found.stiffness, *modulus / scene.body().elements[e]);
    const Entry* const angle = scene.find({"materials", region.material, "friction_angle"});
    if (angle == nullptr || angle->kind != Entry::Kind::scalar) continue;
    const auto friction = coupler::parse_quantity(angle->text, Dimension::angle);
    if (friction && *friction > found.friction) {
      found.friction = *friction;
      found.material = region.material;
    }
  }
  return found;
}

std::string stiffness_text(double value) {
  return value < 1e9 ? fmt::format("{:.3g} MPa/m", 1e-6 * value) : fmt::format("{:.3g} GPa/m", 1e-9 * value);
}

void look_at_interface(const Scene& scene, const std::string& name, const Beside& ground, Remarks& remarks) {
  for (const char* const key : {"normal_stiffness", "shear_stiffness"}) {
    const auto stiffness = scene.quantity({"interfaces", name, key}, Dimension::bedding);
    if (!stiffness || ground.stiffness <= 0.0) continue;
    const double ratio = *stiffness / ground.stiffness;
    if (ratio >= kSoftInterface && ratio <= kHardInterface) continue;
    remarks.push_back(
        {ratio < 0.1 * kSoftInterface ? Rank::wrong : Rank::doubtful,
         std::max(kSoftInterface / ratio, ratio / kHardInterface),
         scene.place({"interfaces", name, key})
             .fault(fmt::format("interfaces: '{}': {} of {} is {:.2g} of Eoed/h of the element beside it: {}",
                                name, key, stiffness_text(*stiffness), ratio,
                                ratio < 1.0 ? "the interface gives way more than the ground"
                                            : "rounding decides whether it carries")),
         fmt::format("leave it out: the default is {}, 30 times Eoed/h",
                     stiffness_text(30.0 * ground.stiffness))});
  }
  const auto friction = scene.quantity({"interfaces", name, "friction"}, Dimension::angle);
  constexpr double kDegrees = 180.0 / std::numbers::pi;
  if (friction && ground.friction > 0.0 && *friction > ground.friction * (1.0 + 1e-9))
    remarks.push_back(
        {Rank::doubtful, *friction / ground.friction,
         scene.place({"interfaces", name, "friction"})
             .fault(fmt::format(
                 "interfaces: '{}': its friction of {:.3g} deg is above the {:.3g} deg of material '{}' beside it: the "
                 "ground yields first, and the interface never slides",
                 name, kDegrees * *friction, kDegrees * ground.friction, ground.material)),
         "a wall has 1/3 to all of the friction of the ground: friction, or share: 2/3"});
}

/// A plate that has both stiffnesses: EA = E t, EI = E t^3 / 12.
void look_at_beam(const Scene& scene, const std::string& name, Remarks& remarks) {
  const auto axial = scene.quantity({"beams", name, "EA"}, Dimension::force_per_length);
  const auto bending = scene.quantity({"beams", name, "EI"}, Dimension::moment);
  if (!axial || !bending || *axial <= 0.0) return;
  const double thickness = std::sqrt(12.0 * *bending / *axial);
  const double most = std::min(kThickBeam, scene.body().smaller_side());
  const double modulus = *axial / thickness;
  if (thickness >= kThinBeam && thickness <= most && modulus <= kStiffBeam) return;
  remarks.push_back(
      {Rank::wrong, std::max({thickness / most, kThinBeam / thickness, modulus / kStiffBeam}),
       scene.place({"beams", name, "EI"})
           .fault(fmt::format(
               "beams: '{}': EA and EI belong to a plate {} thick, sqrt(12 EI / EA), of {:.3g} GPa", name,
               metres(thickness), 1e-9 * modulus)),
       "check the units: EA in MN/m, EI in MNm2/m, both of a metre of thickness"});
}

bool is_held_along(const OutlineSide<2>& side, const HeldNodes<2>& held, int axis) {
  return std::ranges::all_of(side.nodes, [&](int node) {
    return held[static_cast<std::size_t>(node)][static_cast<std::size_t>(axis)];
  });
}

/// The axis normal to a side whose supports hold it along its normal; -1 of others.
int held_axis(const OutlineSide<2>& side, const HeldNodes<2>& held) {
  const int axis = std::abs(side.normal(0)) > std::abs(side.normal(1)) ? 0 : 1;
  const bool is_level = std::abs(side.normal(axis)) > 1.0 - 1e-9;
  return is_level && is_held_along(side, held, axis) ? axis : -1;
}

/// Ends of a beam, and the node behind each, an element away.
std::vector<std::pair<int, int>> ends_of(const fem::Beam& beam) {
  std::map<int, std::vector<int>> neighbours;
  for (std::size_t e = 0; e < beam.elements(); ++e) {
    const std::vector<int>& entries = beam.entries(e);  // displacements of its nodes in turn, ends first
    const int one = entries[0] / Cosserat<2>::dofs;
    const int other = entries[2] / Cosserat<2>::dofs;
    neighbours[one].push_back(other);
    neighbours[other].push_back(one);
  }
  std::vector<std::pair<int, int>> ends;
  for (const auto& [node, others] : neighbours)
    if (others.size() == 1) ends.emplace_back(node, others.front());
  return ends;
}

/// A beam that meets a held side has nodes of its own where an interface parts it from the ground: free along the normal it slides
/// through the side. At a plane of symmetry, a side that is free along itself, one that may turn is a hinge in the whole.
void look_at_ends(const Scene& scene, const fem::Problem<2>& problem, Remarks& remarks) {
  const auto place_of = [&](int node) { return problem.mesh.nodes[static_cast<std::size_t>(node)]; };
  std::vector<char> is_turn_given(problem.mesh.nodes.size(), 0);
  for (const fem::PrescribedField<2>& item : problem.prescribed_fields)
    if (item.field == fem::kBeamRotation)
      for (const int node : problem.mesh.nodes_on(item.on)) is_turn_given[static_cast<std::size_t>(node)] = 1;
  const HeldNodes<2> held = held_nodes(problem, Movers::left_out);
  const HeldNodes<2> given = held_nodes(problem);
  const std::vector<OutlineSide<2>>& outline = scene.outline<2>();
  for (const auto& contribution : problem.contributions) {
    const auto* const beam = dynamic_cast<const fem::Beam*>(contribution.get());
    if (beam == nullptr) continue;
    const std::string& name = beam->short_name();
    for (const auto& [end, behind] : ends_of(*beam)) {
      const Eigen::Vector2d way = (place_of(end) - place_of(behind)).normalized();
      const auto meets = [&](const OutlineSide<2>& side) {
        return std::abs(way.dot(side.normal)) > 0.5 && held_axis(side, held) >= 0 &&
               std::ranges::any_of(side.nodes, [&](int node) { return place_of(node) == place_of(end); });
      };
      const auto side = std::ranges::find_if(outline, meets);
      if (side == outline.end()) continue;
      const int axis = held_axis(*side, held);
      const bool is_symmetry = !is_held_along(*side, held, 1 - axis);
      const bool turns = is_symmetry && is_turn_given[static_cast<std::size_t>(end)] == 0;
      const bool slides = !given[static_cast<std::size_t>(end)][static_cast<std::size_t>(axis)];
      if (!turns && !slides) continue;
      std::string on = name;
      for (const char* const suffix : {"_top", "_bottom", "_left", "_right"})
        if (problem.mesh.has_nodes_on(name + suffix) &&
            problem.mesh.nodes_on(name + suffix) == std::vector<int>{end})
          on = name + suffix;
      const char* const fixed = axis == 0 ? "u1" : "u2";
      const char* const found =
          !slides ? "and may turn there: at a plane of symmetry that is a hinge"
          : turns
              ? "but its own node is free there: it slides through the side, and may turn: at a plane of symmetry that "
                "is a gap and a hinge"
              : "but its own node is free there: it slides through the side";
      remarks.push_back(
          {Rank::doubtful, slides ? 4.0 : 2.0,
           scene.place({"beams", name})
               .fault(fmt::format("beams: '{}' ends at {}, on a side where {} is fixed, {}", name,
                                  fem::place_text<2>(place_of(end)), fixed, found)),
           is_symmetry ? fmt::format("at a plane of symmetry give {{on: {}, fix: [{}, w]}} below 'boundary'",
                                     on, fixed)
                       : fmt::format("give {{on: {}, fix: [{}]}} below 'boundary'", on, fixed)});
    }
  }
}

/// An interface parts the ground, and with it a beam whose nodes are those of the ground: one of its ends lies on another.
void look_at_parted_beams(const Scene& scene, const fem::Problem<2>& problem, Remarks& remarks) {
  const auto place_of = [&](int node) { return problem.mesh.nodes[static_cast<std::size_t>(node)]; };
  for (const auto& contribution : problem.contributions) {
    const auto* const beam = dynamic_cast<const fem::Beam*>(contribution.get());
    if (beam == nullptr) continue;
    const std::vector<std::pair<int, int>> ends = ends_of(*beam);
    const auto parted = std::ranges::find_if(ends, [&](const auto& end) {
      return std::ranges::any_of(ends, [&](const auto& other) {
        return other.first != end.first && place_of(other.first) == place_of(end.first);
      });
    });
    if (parted == ends.end()) continue;
    remarks.push_back(
        {Rank::wrong, 2.0,
         scene.place({"beams", beam->short_name()})
             .fault(fmt::format(
                 "beams: '{}' is cut at {}, where an interface crosses it: no force and no moment of it passes",
                 beam->short_name(), fem::place_text<2>(place_of(parted->first)))),
         "to let it pass, lay an interface along the beam too, which gives it nodes of its own"});
  }
}

template <int dim>
bool holds(const fem::Mesh<dim>& mesh, int element, const typename Cosserat<dim>::Place& place) {
  const auto sides = static_cast<int>(mesh.elements[static_cast<std::size_t>(element)].type->sides.size());
  for (int k = 0; k < sides; ++k) {
    const OutlineSide<dim> side = side_at(mesh, {element, k});
    if (side.normal.dot(place - side.centre) > 0.0) return false;
  }
  return true;
}

/// An element that holds a place with ground on all sides of it, also where it lies between elements; -1: there is no such one.
template <int dim>
int element_around(const fem::Mesh<dim>& mesh, const typename Cosserat<dim>::Place& place, double size) {
  constexpr double kBeside = 1e-6;
  int found = -1;
  for (int corner = 0; corner < 1 << dim; ++corner) {
    typename Cosserat<dim>::Place here = place;
    for (int i = 0; i < dim; ++i)
      here(i) += ((corner >> i & 1) != 0 ? 1.0 : -1.0) * (1.0 + 0.1 * i) * kBeside * size;
    found = -1;
    for (int e = 0; found < 0 && e < static_cast<int>(mesh.elements.size()); ++e)
      if (holds(mesh, e, here)) found = e;
    if (found < 0) return -1;
  }
  return found;
}

/// A far end that nothing moves, in the midst of ground that does.
template <int dim>
void look_at_anchor(const Scene& scene, const fem::Mesh<dim>& mesh, const std::string& name,
                    Remarks& remarks) {
  const Entry* const to = scene.find({"anchors", name, "to"});
  if (to == nullptr || to->items.size() != dim) return;
  typename Cosserat<dim>::Place place;
  for (int i = 0; i < dim; ++i) {
    const auto value =
        coupler::parse_quantity(to->items[static_cast<std::size_t>(i)].text, Dimension::length);
    if (!value) return;
    place(i) = *value;
  }
  const int element = element_around(mesh, place, scene.body().smaller_side());
  if (element < 0) return;
  remarks.push_back(
      {Rank::doubtful, 2.0,
       to->fault(fmt::format(
           "anchors: '{}': its far end ({:.4g}) m lies within region '{}' and is fixed there: it does not move "
           "with the ground",
           name, fmt::join(place, ", "), scene.region_of(element).name)),
       "name a node of the ground, to: NAME; or put the end beyond the mesh"});
}

template <int dim>
void look_at_structures(const Scene& scene, const fem::Mesh<dim>& mesh, Remarks& remarks) {
  const auto visit = [&](const char* key, auto look) {
    if (const Entry* const list = scene.find({key}))
      for (const Entry::Member& member : list->members) look(member);
  };
  visit("interfaces", [&](const Entry::Member& member) {
    const Entry* const on = member.value.find("on");
    if (on != nullptr && on->kind == Entry::Kind::scalar && mesh.has_nodes_on(on->text))
      look_at_interface(scene, member.key, beside(scene, mesh, on->text), remarks);
  });
  visit("beams", [&](const Entry::Member& member) { look_at_beam(scene, member.key, remarks); });
  visit("anchors", [&](const Entry::Member& member) { look_at_anchor(scene, mesh, member.key, remarks); });
}

}  // namespace

void structures(const Scene& scene, Remarks& remarks) {
  scene.with_problem([&](const auto& problem) { look_at_structures(scene, problem.mesh, remarks); });
  // With the supports of all stages: one of a later stage may hold it.
  if (scene.dimension() == 2) {
    look_at_ends(scene, scene.the_case().problem, remarks);
    look_at_parted_beams(scene, scene.the_case().problem, remarks);
  }
}

}  // namespace polargrain::app
