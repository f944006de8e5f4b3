// SPDX-License-Identifier: GPL-2.0-or-later
// Water at interfaces and walls: how it passes them, and free water before them.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "coupler/case/parts.hpp"
#include "fem/interface/interface.hpp"
#include "fem/water/free_water.hpp"

namespace polargrain::coupler {
namespace {

constexpr const char* kPermeable = "permeable";
constexpr const char* kImpervious = "impervious";
constexpr const char* kLeaky = "leaky";

template <int dim>
using Interfaces = std::vector<std::shared_ptr<fem::Interface<dim>>>;

/// The interfaces of one name: one, or one on each side of a wall of beams.
template <int dim>
Interfaces<dim> interfaces_of(const fem::Problem<dim>& problem, const CaseParts::Structure& structure) {
  Interfaces<dim> found;
  for (const std::size_t number : structure.contributions)
    if (auto interface = std::dynamic_pointer_cast<fem::Interface<dim>>(problem.contributions[number]))
      found.push_back(std::move(interface));
  return found;
}

std::vector<int> ascending(std::vector<int> numbers) {
  std::ranges::sort(numbers);
  return numbers;
}

/// Faces with ground on both sides, with or without a wall between.
template <int dim>
std::vector<fem::AcrossFace<dim>> faces_across(const Interfaces<dim>& interfaces) {
  std::vector<fem::AcrossFace<dim>> faces;
  const fem::Interface<dim>& first = *interfaces.front();
  if (interfaces.size() == 1) {
    for (std::size_t e = 0; e < first.elements(); ++e)
      if (const auto& face = first.face(e); face.neighbours.size() == 2)
        faces.push_back({face.type, face.nodes_a, face.nodes_b, face.neighbours[0], face.neighbours[1]});
    return faces;
  }
  std::map<std::vector<int>, const fem::InterfaceFace<dim>*> at_wall;
  for (std::size_t e = 0; e < interfaces[1]->elements(); ++e)
    at_wall[ascending(interfaces[1]->face(e).nodes_b)] = &interfaces[1]->face(e);
  for (std::size_t e = 0; e < first.elements(); ++e) {
    const fem::InterfaceFace<dim>& one = first.face(e);
    const auto other = at_wall.find(ascending(one.nodes_b));
    if (other == at_wall.end()) continue;
    fem::AcrossFace<dim> face{one.type, one.nodes_a, {}, one.neighbours[0], other->second->neighbours[0]};
    for (const int node : one.nodes_b) {
      const auto place = std::ranges::find(other->second->nodes_b, node) - other->second->nodes_b.begin();
      face.nodes_b.push_back(other->second->nodes_a[static_cast<std::size_t>(place)]);
    }
    faces.push_back(std::move(face));
  }
  return faces;
}

template <int dim>
void add_water_at(const std::string& name, CaseParts::Structure& structure, fem::Problem<dim>& problem,
                  CaseParts& parts) {
  const Interfaces<dim> interfaces = interfaces_of(problem, structure);
  for (const auto& interface : interfaces) interface->take_water(problem);
  const PassageOfInterface& passage = parts.passages.at(name);
  const std::vector<fem::AcrossFace<dim>> faces = faces_across<dim>(interfaces);
  if (faces.empty()) {
    if (passage.is_given && passage.options.passage != fem::Passage::impervious)
      parts.faults.push_back(passage.entry->fault(fmt::format(
          "interface '{}': water: ground lies on one side alone, where a wall is closed; leave it out, or give the "
          "boundary a pressure",
          name)));
    return;
  }
  fem::WaterAcrossOptions options = passage.options;
  options.unit_weight = parts.water->options.unit_weight;
  options.theta = parts.water->options.theta;
  structure.contributions.push_back(problem.contributions.size() - 1);  // the place of the pore water
  fem::add_water_across<dim>(problem, std::make_shared<fem::WaterAcross<dim>>(problem, options, faces));
}

/// The faces of a wall that has a name, with its interfaces.
template <int dim>
std::vector<fem::BareFace<dim>> faces_of_wall(const std::string& wall, const fem::Problem<dim>& problem,
                                              const CaseParts& parts) {
  std::vector<fem::BareFace<dim>> faces;
  for (const auto& [name, structure] : parts.structures) {
    if (structure.kind != CaseParts::Structure::Kind::interface) continue;
    const bool is_rigid = structure.along.empty() && name == wall;
    if (!is_rigid && structure.along != wall) continue;
    const Interfaces<dim> interfaces = interfaces_of(problem, structure);
    std::map<std::vector<int>, int> sides;  // with ground, of each face of the wall
    for (const auto& interface : interfaces)
      for (std::size_t e = 0; e < interface->elements(); ++e) ++sides[ascending(interface->face(e).nodes_b)];
    const auto is_one_sided = [&](const fem::InterfaceFace<dim>& face) {
      return sides.at(ascending(face.nodes_b)) == 1;
    };
    for (const auto& interface : interfaces) {
      if (interface->face(0).neighbours.size() != 1) continue;  // two grounds without a wall
      const auto more = fem::bare_sides_of_wall<dim>(interface, is_one_sided);
      faces.insert(faces.end(), more.begin(), more.end());
    }
  }
  return faces;
}

}  // namespace

void read_passage(Section& section, const std::string& interface, CaseParts& parts) {
  PassageOfInterface& passage = parts.passages[interface];
  passage.entry = &section.entry();
  passage.is_given = section.find("water") != nullptr;
  passage.options.name = interface;
  const std::string kind = section.choice_or("water", {kPermeable, kImpervious, kLeaky}, kPermeable);
  if (kind == kImpervious) passage.options.passage = fem::Passage::impervious;
  if (kind == kLeaky) {
    passage.options.passage = fem::Passage::leaky;
    passage.options.resistance = section.quantity("resistance", Dimension::duration, Limit::positive);
  } else if (section.find("resistance") != nullptr) {
    section.fault("resistance",
                  "resistance: thickness over permeability of a wall that leaks; write 'water: leaky' too");
  }
}

void add_water_at_interfaces(CaseParts& parts) {
  if (!parts.water) {
    for (const auto& [name, passage] : parts.passages)
      if (passage.is_given)
        parts.faults.push_back(passage.entry->fault(fmt::format(
            "interface '{}': water: the case has no water; give 'water' with its permeability", name)));
    return;
  }
  if (!parts.has_mesh || !parts.faults.empty()) return;
  parts.result.with_problem([&]<int dim>(fem::Problem<dim>& problem) {
    for (auto& [name, structure] : parts.structures)
      if (structure.kind == CaseParts::Structure::Kind::interface)
        add_water_at<dim>(name, structure, problem, parts);
  });
}

std::vector<std::string> add_free_water(Section& item, const std::vector<std::string>& places,
                                        const fem::TimeTable& level, CaseParts& parts) {
  std::vector<std::string> boundaries;
  if (!parts.has_mesh) return boundaries;
  parts.result.with_problem([&]<int dim>(fem::Problem<dim>& problem) {
    for (const std::string& place : places) {
      std::vector<fem::BareFace<dim>> faces = faces_of_wall<dim>(place, problem, parts);
      if (faces.empty()) {
        const std::size_t faults_before = parts.faults.size();
        parts.check_places(item, "on", {place}, "free water");
        if (parts.faults.size() > faults_before) continue;
        faces = fem::bare_sides_of_ground<dim>(problem.mesh, place);
        boundaries.push_back(place);
      }
      problem.contributions.push_back(std::make_shared<fem::FreeWater<dim>>(
          problem.mesh, place, level, parts.water->options.unit_weight, std::move(faces)));
    }
  });
  return boundaries;
}

}  // namespace polargrain::coupler
