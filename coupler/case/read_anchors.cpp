// SPDX-License-Identifier: GPL-2.0-or-later
// Anchors, between nodes of the mesh and of the structures that are read before them.
#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "common/error.hpp"
#include "coupler/case/parts.hpp"
#include "fem/beam/anchor.hpp"

namespace polargrain::coupler {
namespace {

template <int dim>
class AnchorsReader {
 public:
  explicit AnchorsReader(CaseParts& parts) : parts_(parts), problem_(parts.result.problem_of<dim>()) {}

  void read(const Entry& entry) {
    Section all(entry, "anchors", parts_.faults);
    bool all_are_there = entry.kind == Entry::Kind::map;
    for (const Entry::Member& member : entry.members) {
      parts_.take_structure_name(all, member.key);
      Section section(member.value, fmt::format("anchor '{}'", member.key), parts_.faults);
      all_are_there = read_anchor(section, member.key) && all_are_there;
      section.finish();
    }
    all.finish();
    // Names of those that are missing would be faults that only follow.
    if (!all_are_there) parts_.has_mesh = false;
  }

 private:
  /// The one node of a place. @returns -1 and a fault when it has more nodes, or no node
  int node_of(Section& section, const std::string& key) {
    const std::string name = section.text(key, "the name of a set of one node, or in 'to' a place [x1, x2]");
    if (!parts_.has_mesh || name.empty()) return -1;
    const std::size_t faults_before = parts_.faults.size();
    parts_.check_places(section, key, {name});
    if (parts_.faults.size() > faults_before) return -1;
    const std::vector<int> nodes = problem_.mesh.nodes_on(name);
    if (nodes.size() == 1) return nodes.front();
    section.fault(
        key, fmt::format("{}: '{}' has {} nodes; an anchor needs one: a physical point, or the end of a beam",
                         key, name, nodes.size()));
    return -1;
  }

  /// @returns whether it is there, so that others can name it
  bool read_anchor(Section& section, const std::string& name) {
    const Dimension force =
        dim == 2 && section.find("spacing") == nullptr ? Dimension::force_per_length : Dimension::force;
    const double spacing =
        dim == 2 ? section.quantity_if("spacing", Dimension::length, Limit::positive).value_or(1.0) : 1.0;
    fem::AnchorSettings<dim> settings;
    settings.name = name;
    const std::size_t faults_before = parts_.faults.size();
    settings.from = node_of(section, "from");
    const Entry* const to = section.find("to");
    if (to != nullptr && to->kind == Entry::Kind::sequence) {
      const std::vector<double> place = section.quantities("to", dim, Dimension::length, Limit::any);
      for (int i = 0; i < dim; ++i) settings.fixed(i) = place[static_cast<std::size_t>(i)];
    } else {
      settings.to = node_of(section, "to");
    }
    const bool has_ends =
        parts_.faults.size() == faults_before && settings.from >= 0 && settings.to.value_or(0) >= 0;
    read_forces(section, force, spacing, settings);
    // A wrong number is a fault of its own: the anchor stays known to the names of it that follow.
    if (!has_ends) return false;
    try {
      auto anchor = std::make_shared<fem::Anchor<dim>>(problem_.mesh, settings);
      parts_.add_structure(name, CaseParts::Structure::Kind::anchor);
      problem_.contributions.push_back(std::move(anchor));
      return true;
    } catch (const RunError& error) {
      section.fault("to", fmt::format("to: {}", error.what()));
      return false;
    }
  }

  void read_forces(Section& section, Dimension force, double spacing, fem::AnchorSettings<dim>& settings) {
    const std::size_t faults_before = parts_.faults.size();
    settings.axial_stiffness = section.quantity("EA", force, Limit::positive) / spacing;
    settings.prestress = section.quantity_or("prestress", force, Limit::any, 0.0) / spacing;
    settings.strength = section.quantity_or("strength", force, Limit::positive, HUGE_VAL) / spacing;
    settings.compressive_strength =
        section.quantity_or("compressive_strength", force, Limit::not_negative, HUGE_VAL) / spacing;
    if (parts_.faults.size() > faults_before) return;  // numbers that would be compared are not known
    if (settings.prestress < 0.0)
      section.fault(
          "prestress",
          fmt::format("prestress: expected a tension, zero or greater, found '{}'; write it without "
                      "the minus, or leave it out for a strut",
                      section.find("prestress")->text));
    else if (settings.prestress > settings.strength)
      section.fault("prestress", "prestress: must not be beyond the strength");
  }

  CaseParts& parts_;
  fem::Problem<dim>& problem_;
};

}  // namespace

void read_anchors(const Entry& anchors, CaseParts& parts) {
  if (parts.result.space)
    AnchorsReader<3>(parts).read(anchors);
  else
    AnchorsReader<2>(parts).read(anchors);
}

}  // namespace polargrain::coupler
