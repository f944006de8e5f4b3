// SPDX-License-Identifier: GPL-2.0-or-later
// Interfaces and beams: they change the mesh, so they are read behind it and before what names its parts.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <utility>

#include "common/error.hpp"
#include "coupler/case/parts.hpp"
#include "fem/beam/beam.hpp"
#include "fem/interface/interface.hpp"
#include "fem/mesh/split.hpp"

namespace polargrain::coupler {
namespace {

/// Reads the structures of a case; the problem is that of the dimension that the case has.
template <int dim>
class StructuresReader {
 public:
  explicit StructuresReader(CaseParts& parts) : parts_(parts), problem_(parts.result.problem_of<dim>()) {}

  void read(const Entry* interfaces, const Entry* beams, const Entry* anchors) {
    if (problem_.deformation == fem::Deformation::large) {
      for (const Entry* const entry : {interfaces, beams, anchors}) {
        if (entry == nullptr) continue;
        parts_.faults.push_back(
            entry->fault("interfaces, beams and anchors are of small deformation; set 'deformation: small'"));
        parts_.has_mesh = false;
      }
      return;
    }
    const std::size_t faults_before = parts_.faults.size();
    if (beams != nullptr)
      each(*beams, "beams", [&](Section& section, Curve& curve) { read_beam(section, curve); });
    if (interfaces != nullptr)
      each(*interfaces, "interfaces",
           [&](Section& section, Curve& curve) { read_interface(section, curve); });
    // Without structures that are not understood their nodes are missing: names of these would be faults that only follow.
    if (parts_.faults.size() > faults_before) parts_.has_mesh = false;
    if (parts_.has_mesh) build();
    if (anchors != nullptr) read_anchors(*anchors, parts_);
  }

 private:
  struct InterfaceHere {
    const Entry* entry;
    fem::InterfaceSettings settings;
    bool holds_rotation = false;
    std::optional<MeasuredWall> measured = {};
  };
  struct BeamHere {
    std::string name;
    fem::BeamSection section;
    std::vector<std::string> clamped;
  };
  /// A curve of the mesh and what lies along it.
  struct Curve {
    std::string on;
    std::vector<fem::TwoSidedFace<dim>> faces;
    std::optional<InterfaceHere> interface = {};
    std::optional<BeamHere> beam = {};
  };

  template <class Read>
  void each(const Entry& entry, const std::string& key, Read read) {
    Section all(entry, key, parts_.faults);
    for (const Entry::Member& member : entry.members) {
      parts_.take_structure_name(all, member.key);
      Section section(member.value, fmt::format("{} '{}'", key.substr(0, key.size() - 1), member.key),
                      parts_.faults);
      name_ = member.key;
      const std::string on =
          section.text("on", "the name of a curve: a boundary, or a set of nodes of whole sides");
      Curve unused;
      Curve* const curve = on.empty() ? nullptr : curve_of(section, on);
      read(section, curve == nullptr ? unused : *curve);
      section.finish();
    }
    all.finish();
  }

  Curve* curve_of(Section& section, const std::string& on) {
    const auto known = std::ranges::find(curves_, on, [](const auto& curve) { return curve->on; });
    if (known != curves_.end()) return known->get();
    if (!parts_.has_mesh) return nullptr;
    const std::size_t faults_before = parts_.faults.size();
    parts_.check_places(section, "on", {on});
    if (parts_.faults.size() > faults_before) return nullptr;
    try {
      curves_.push_back(std::make_unique<Curve>(Curve{on, fem::faces_along(problem_.mesh, on)}));
    } catch (const RunError& error) {
      section.fault("on", fmt::format("on: {}", error.what()));
      return nullptr;
    }
    return curves_.back().get();
  }

  void read_interface(Section& section, Curve& curve) {
    if (curve.interface)
      section.fault("on", fmt::format("on: the interface '{}' lies there; give a curve one interface",
                                      curve.interface->settings.name));
    if (!curve.beam) check_sides(section, curve);
    InterfaceHere here{&section.entry(), {}, false};
    here.settings.name = name_;
    fem::InterfaceParameters& law = here.settings.parameters;
    const bool has_share = section.find("share") != nullptr;
    if (has_share == (section.find("friction") != nullptr)) {
      section.fault("friction",
                    "expected either 'friction', an angle such as 20 deg, or 'share', the part of the "
                    "mobilised friction beside it, such as 2/3");
    } else if (has_share) {
      here.settings.share = read_share(section);
    } else if (is_measured(section)) {
      here.measured = read_measured_friction(section, parts_);
      if (here.measured) {
        law.over_slip = std::make_shared<fem::FrictionCurve>(here.measured->curve);
        // The largest one, for what the tension is held against.
        for (const auto& point : here.measured->curve)
          law.tan_friction = std::max(law.tan_friction, point.friction);
      }
    } else {
      const auto angle =
          section.quantity_or_word("friction", Dimension::angle, Limit::not_negative, {"measured"});
      law.tan_friction = tangent(section, "friction", angle);
    }
    if (!is_measured(section))
      law.tan_dilation = tangent(section, "dilation",
                                 section.quantity_or("dilation", Dimension::angle, Limit::not_negative, 0.0));
    if (!has_share && law.tan_dilation > law.tan_friction)
      section.fault("dilation", "dilation: must not be larger than the friction");
    law.cohesion = section.quantity_or("cohesion", Dimension::pressure, Limit::not_negative, 0.0);
    law.tension = section.quantity_or("tension", Dimension::pressure, Limit::not_negative, 0.0);
    if (law.tension * law.tan_friction > law.cohesion * (1.0 + 1e-9))
      section.fault("tension",
                    "tension: must not be larger than cohesion / tan(friction), where the friction ends");
    law.normal_stiffness =
        section.quantity_if("normal_stiffness", Dimension::bedding, Limit::positive).value_or(0.0);
    law.shear_stiffness =
        section.quantity_if("shear_stiffness", Dimension::bedding, Limit::positive).value_or(0.0);
    if (!is_measured(section))
      law.dilation_until =
          section.quantity_or("dilation_until", Dimension::length, Limit::positive, HUGE_VAL);
    law.cohesion_lasts = section.choice_or("cohesion_after_opening", {"lost", "kept"}, "lost") == "kept";
    const std::string rotation = section.choice_or("rotation", {"free", "held", "measured"}, "free");
    here.holds_rotation = rotation != "free";
    if (rotation == "measured") {
      if (!is_measured(section))
        section.fault(
            "rotation",
            "rotation: measured: comes from the box that 'friction: measured' reads; write that, or "
            "'held' or 'free'");
      else if (here.measured)
        here.settings.turning = here.measured->turning / here.measured->mean_diameter;
    }
    if (here.holds_rotation && problem_.continuum == fem::Continuum::cauchy)
      section.fault("rotation",
                    "rotation: the classical continuum has no micro-rotation to hold; leave it out");
    read_passage(section, name_, parts_);
    curve.interface = std::move(here);
  }

  /// Without a beam an interface has ground on both sides, or a rigid body on one: a curve of both kinds is refused.
  void check_sides(Section& section, const Curve& curve) {
    const auto has_one = [](const fem::TwoSidedFace<dim>& face) { return !face.second; };
    const auto one = std::ranges::find_if(curve.faces, has_one);
    if (one == curve.faces.end() || std::ranges::all_of(curve.faces, has_one)) return;
    section.fault(
        "on",
        fmt::format(
            "on: '{}' has ground on both sides, and on one side alone at {}; {}end it there", curve.on,
            fem::place_text<dim>(problem_.mesh.nodes[static_cast<std::size_t>(one->first_nodes.front())]),
            dim == 2
                ? fmt::format("give it a beam too ('beams: {{NAME: {{on: {}, EA: ..., EI: ...}}}}'), or ",
                              curve.on)
                : ""));
  }

  /// "2/3", or a number from 0 to 1.
  double read_share(Section& section) {
    const Entry& entry = *section.find("share");
    const auto stroke = entry.text.find('/');
    if (stroke != std::string::npos) {
      const auto above = parse_quantity(entry.text.substr(0, stroke), Dimension::number);
      const auto below = parse_quantity(entry.text.substr(stroke + 1), Dimension::number);
      if (above && below && *above > 0.0 && *above <= *below) return *above / *below;
      section.fault("share", "share: expected a part of the friction beside it, such as 2/3, found '" +
                                 entry.text + "'");
      return 0.0;
    }
    const double share = section.quantity("share", Dimension::number, Limit::not_negative);
    if (share > 1.0) section.fault("share", "share: at most 1, the whole friction beside the interface");
    return share;
  }

  static bool is_measured(Section& section) {
    const Entry* const friction = section.find("friction");
    return friction != nullptr && friction->text == "measured";
  }

  double tangent(Section& section, const std::string& key, std::optional<double> angle) {
    constexpr double kSteepest = 1.4;  // 80 degrees
    const Entry* const entry = section.find(key);
    if (angle && *angle > 0.0 && *angle < kSteepest && is_plain_number(entry->text)) {
      section.fault(
          key,
          fmt::format(
              "{0}: expected an angle with its unit, found '{1}'; write '{2:.3g} deg' for a coefficient of {1}, or "
              "'{1} rad'",
              key, entry->text, std::atan(*angle) * 180.0 / std::numbers::pi));
      return 0.0;
    }
    if (!angle || *angle < kSteepest) return std::tan(angle.value_or(0.0));
    section.fault(key, fmt::format("{}: must be below 80 deg", key));
    return 0.0;
  }

  void read_beam(Section& section, Curve& curve) {
    if (dim == 3) {
      section.fault("on", "beams are of the plane; in space model the wall by elements");
      for (const Entry::Member& member : section.entry().members) section.find(member.key);
      return;
    }
    if (curve.beam)
      section.fault("on",
                    fmt::format("on: the beam '{}' lies there; give a curve one beam", curve.beam->name));
    BeamHere here;
    here.name = name_;
    here.section.axial_stiffness = section.quantity("EA", Dimension::force_per_length, Limit::positive);
    here.section.bending_stiffness = section.quantity("EI", Dimension::moment, Limit::positive);
    here.section.shear_stiffness = section.quantity_or("GA", Dimension::force_per_length, Limit::positive,
                                                       here.section.axial_stiffness / 3.0);
    here.section.plastic_moment = section.quantity_or("Mp", Dimension::force, Limit::positive, HUGE_VAL);
    here.section.plastic_axial_force =
        section.quantity_or("Np", Dimension::force_per_length, Limit::positive, HUGE_VAL);
    if (section.find("clamped") != nullptr)
      here.clamped = section.words("clamped", "names of places on the beam");
    clamped_sections_.emplace_back(&section.entry(), here.clamped);
    curve.beam = std::move(here);
  }

  void build() {
    // Curves that open, all at once; the beam's nodes are copies where it lies in an interface.
    std::vector<std::vector<fem::TwoSidedFace<dim>>> opening;
    std::vector<std::size_t> number(curves_.size(), 0);
    for (std::size_t c = 0; c < curves_.size(); ++c) {
      if (!curves_[c]->interface) continue;
      number[c] = opening.size();
      opening.push_back(curves_[c]->faces);
    }
    const auto before = opening;
    fem::split_along(problem_.mesh, opening);
    struct Own {
      std::vector<std::vector<int>> beam_faces;
    };
    std::vector<Own> own(curves_.size());
    std::map<int, int> own_of;  // original node: node of all walls of beams that meet there
    for (std::size_t c = 0; c < curves_.size(); ++c) {
      Curve& curve = *curves_[c];
      if (!curve.interface) continue;
      curve.faces = opening[number[c]];
      const bool one_sided = !curve.faces.front().second;
      if (!curve.beam && !one_sided) continue;
      const fem::OwnNodes<dim> nodes = curve.beam
                                           ? fem::add_own_nodes(problem_.mesh, before[number[c]], own_of)
                                           : fem::add_own_nodes(problem_.mesh, before[number[c]]);
      own[c].beam_faces = nodes.face_nodes;
      add_node_set(curve.beam ? curve.beam->name : curve.interface->settings.name, nodes.nodes);
      fix_rotations(curve.beam ? curve.beam->name : curve.interface->settings.name);
      if (!curve.beam)
        parts_.rigid_bodies.emplace_back(curve.interface->settings.name, curve.interface->entry);
    }
    for (std::size_t c = 0; c < curves_.size(); ++c)
      if (!curves_[c]->interface) own[c].beam_faces = weld(*curves_[c], own_of);
    if constexpr (dim == 2) {
      for (std::size_t c = 0; c < curves_.size(); ++c)
        if (curves_[c]->beam) add_rotations(*curves_[c], own[c].beam_faces);
      for (std::size_t c = 0; c < curves_.size(); ++c)
        if (curves_[c]->beam) add_beam(*curves_[c], own[c].beam_faces);
      check_clamped();
    }
    WallsAt walls;
    for (std::size_t c = 0; c < curves_.size(); ++c)
      if (curves_[c]->beam && curves_[c]->interface)
        for (const std::vector<int>& face : own[c].beam_faces)
          for (const int node : face) walls[node][curves_[c]->beam->name] = beams_.at(curves_[c]->beam->name);
    for (std::size_t c = 0; c < curves_.size(); ++c)
      if (curves_[c]->interface) add_interfaces(*curves_[c], own[c].beam_faces, walls);
  }

  /// The nodes of a beam without an interface: of the ground, and where it meets a wall in an interface, of that.
  std::vector<std::vector<int>> weld(Curve& curve, const std::map<int, int>& own_of) {
    std::vector<std::vector<int>> beam_faces;
    for (fem::TwoSidedFace<dim>& face : curve.faces) {
      std::vector<int>& nodes = beam_faces.emplace_back(face.first_nodes);
      face.first_nodes = problem_.mesh.side_nodes(face.first);  // another curve may have parted it
      for (std::size_t a = 0; a < nodes.size(); ++a) {
        const auto own = own_of.find(nodes[a]);
        nodes[a] = own == own_of.end() ? face.first_nodes[a] : own->second;
      }
    }
    return beam_faces;
  }

  void add_node_set(const std::string& name, const std::vector<int>& nodes) {
    if (problem_.mesh.has_nodes_on(name)) {
      parts_.faults.push_back(curve_entry(name)->fault(fmt::format(
          "'{0}': the mesh has a part of this name; choose another, since '{0}' names the nodes of its own",
          name)));
      return;
    }
    problem_.mesh.node_sets[name] = nodes;
  }

  const Entry* curve_entry(const std::string& name) const {
    for (const auto& curve : curves_)
      if (curve->interface &&
          (curve->interface->settings.name == name || (curve->beam && curve->beam->name == name)))
        return curve->interface->entry;
    return nullptr;
  }

  /// Holds the micro-rotations of nodes without elements; the rotation of a beam is a field.
  void fix_rotations(const std::string& name) {
    for (const fem::Dof dof : fem::node_dofs<dim>())
      if (fem::is_rotation(dof)) parts_.own_rotations.push_back({name, dof});
  }

  void add_rotations(const Curve& curve, const std::vector<std::vector<int>>& faces) {
    if (problem_.fields.empty() || problem_.fields.front().name != fem::kBeamRotation)
      problem_.fields.insert(
          problem_.fields.begin(),
          fem::NodalField{.name = fem::kBeamRotation, .unit = "rad", .nodes = {}, .is_motion = true});
    std::vector<int>& nodes = problem_.fields.front().nodes;
    double low[2] = {HUGE_VAL, HUGE_VAL};
    double high[2] = {-HUGE_VAL, -HUGE_VAL};
    std::vector<int> own;
    for (const std::vector<int>& face : faces)
      for (const int node : face) {
        if (std::ranges::find(nodes, node) == nodes.end()) nodes.push_back(node);
        own.push_back(node);
        for (int i = 0; i < 2; ++i) {
          low[i] = std::min(low[i], problem_.mesh.nodes[static_cast<std::size_t>(node)](i));
          high[i] = std::max(high[i], problem_.mesh.nodes[static_cast<std::size_t>(node)](i));
        }
      }
    // Its ends: the lowest and the highest node, of a flat beam the first and the last from the left.
    const int axis = high[1] - low[1] >= high[0] - low[0] ? 1 : 0;
    const auto by_place = [&](int a, int b) {
      return problem_.mesh.nodes[static_cast<std::size_t>(a)](axis) <
             problem_.mesh.nodes[static_cast<std::size_t>(b)](axis);
    };
    const std::string& name = curve.beam->name;
    problem_.mesh.node_sets[name + (axis == 1 ? "_bottom" : "_left")] = {
        *std::ranges::min_element(own, by_place)};
    problem_.mesh.node_sets[name + (axis == 1 ? "_top" : "_right")] = {
        *std::ranges::max_element(own, by_place)};
  }

  void add_beam(const Curve& curve, const std::vector<std::vector<int>>& faces) {
    const auto places = problem_.places();
    std::vector<fem::BeamElement> elements;
    for (std::size_t f = 0; f < faces.size(); ++f) {
      if constexpr (dim == 2) {
        fem::BeamElement& element =
            elements.emplace_back(fem::BeamElement{curve.faces[f].type, faces[f], {}});
        for (const int node : faces[f]) element.rotations.push_back(places.entry(0, node));
      }
    }
    if constexpr (dim == 2) {
      parts_.add_structure(curve.beam->name, CaseParts::Structure::Kind::beam);
      problem_.contributions.push_back(std::make_shared<fem::Beam>(problem_.mesh, curve.beam->name,
                                                                   curve.beam->section, std::move(elements)));
      beams_[curve.beam->name] = problem_.contributions.back();
    }
  }

  void check_clamped() {
    for (const auto& [entry, places] : clamped_sections_) {
      if (places.empty()) continue;
      Section section(*entry, "beam", parts_.faults);
      parts_.check_places(section, "clamped", places);
      for (const std::string& place : places)
        problem_.prescribed_fields.push_back(
            {fem::kBeamRotation, place, fem::TimeTable::constant(0.0), {}, {}});
    }
  }

  /// The walls of beams in interfaces at a node of theirs, by name.
  using WallsAt = std::map<int, std::map<std::string, std::shared_ptr<const fem::Contribution<dim>>>>;

  void add_interfaces(const Curve& curve, const std::vector<std::vector<int>>& own_faces,
                      const WallsAt& walls) {
    const InterfaceHere& here = *curve.interface;
    std::vector<fem::InterfaceFace<dim>> first;
    std::vector<fem::InterfaceFace<dim>> second;
    for (std::size_t f = 0; f < curve.faces.size(); ++f) {
      const fem::TwoSidedFace<dim>& face = curve.faces[f];
      const bool has_own = !own_faces.empty();
      fem::InterfaceFace<dim>& one = first.emplace_back(fem::InterfaceFace<dim>{
          face.type, face.first_nodes, has_own ? own_faces[f] : face.second_nodes, {face.first.element}, {}});
      if (here.holds_rotation) one.rotation_b = rotations_of(curve, one.nodes_b);
      if (!face.second) continue;
      if (!has_own) {
        one.neighbours.push_back(face.second->element);
        continue;
      }
      one.nodes_across = face.second_nodes;
      // The wall as the second side sees it: its nodes in the order of that element.
      const fem::TwoSidedFace<dim> turned = face.seen_from_second(problem_.mesh);
      fem::InterfaceFace<dim> other{turned.type, turned.first_nodes, {}, {turned.first.element}, {}};
      for (const int node : turned.second_nodes) {
        const auto place = std::ranges::find(face.first_nodes, node) - face.first_nodes.begin();
        other.nodes_b.push_back(own_faces[f][static_cast<std::size_t>(place)]);
      }
      if (here.holds_rotation) other.rotation_b = rotations_of(curve, other.nodes_b);
      second.push_back(std::move(other));
    }
    fem::InterfaceSettings settings = here.settings;
    settings.parts_ground =
        std::ranges::any_of(curve.faces, [](const auto& face) { return face.second.has_value(); });
    for (const fem::TwoSidedFace<dim>& face : curve.faces)
      for (std::size_t a = 0; a < face.second_nodes.size(); ++a)
        if (face.first_nodes[a] == face.second_nodes[a]) settings.single_nodes.insert(face.first_nodes[a]);
    const std::string along = curve.beam ? curve.beam->name : "";
    parts_.add_structure(here.settings.name, CaseParts::Structure::Kind::interface, along);
    const std::pair<std::string, std::string> sides = sides_of(curve, first);
    if (!second.empty()) settings.name = name_on_side(here, sides.first);
    add_interface(settings, std::move(first), curve, walls);
    if (second.empty()) return;
    settings.name = name_on_side(here, sides.second);
    parts_.add_structure(here.settings.name, CaseParts::Structure::Kind::interface, along);
    add_interface(settings, std::move(second), curve, walls);
  }

  std::string name_on_side(const InterfaceHere& here, const std::string& side) {
    std::string name = here.settings.name + " " + side;
    if (!parts_.structure_names.insert(name).second)
      parts_.faults.push_back(here.entry->fault(fmt::format(
          "interface '{}': its {} side is '{}', a name that another interface, beam or anchor has; "
          "rename one of them",
          here.settings.name, side, name)));
    return name;
  }

  void add_interface(const fem::InterfaceSettings& settings, std::vector<fem::InterfaceFace<dim>> faces,
                     const Curve& curve, const WallsAt& walls) {
    std::map<int, std::vector<std::shared_ptr<const fem::Contribution<dim>>>> met;
    if (curve.beam)
      for (const fem::InterfaceFace<dim>& face : faces)
        for (const int node : face.nodes_b)
          if (!met.contains(node))
            for (const auto& [name, wall] : walls.at(node))
              if (name != curve.beam->name) met[node].push_back(wall);
    const auto interface = std::make_shared<fem::Interface<dim>>(problem_.mesh, settings, std::move(faces));
    interface->meet(std::move(met));
    problem_.contributions.push_back(interface);
  }

  /// Words for the sides of a wall, first that of the faces: inside or outside of a closed curve of the plane, else where the
  /// ground lies.
  std::pair<std::string, std::string> sides_of(const Curve& curve,
                                               const std::vector<fem::InterfaceFace<dim>>& first) const {
    static const std::map<std::string, std::string> opposite{
        {"left", "right"}, {"right", "left"}, {"below", "above"}, {"above", "below"}};
    if constexpr (dim == 2) {
      const auto at = [&](int node) { return problem_.mesh.nodes[static_cast<std::size_t>(node)]; };
      if (at(curve.faces.front().first_nodes[0]) == at(curve.faces.back().first_nodes[1])) {
        // The first side lies to the left of the way.
        double twice_area = 0.0;
        for (const fem::TwoSidedFace<dim>& face : curve.faces) {
          const Eigen::Vector2d from = at(face.first_nodes[0]);
          const Eigen::Vector2d to = at(face.first_nodes[1]);
          twice_area += from(0) * to(1) - from(1) * to(0);
        }
        if (twice_area > 0.0) return {"inside", "outside"};
        return {"outside", "inside"};
      }
    }
    const std::string side = side_of(first);
    return {side, opposite.at(side)};
  }

  /// Where the ground lies that the faces belong to: left or right of a steep wall, below or above a flat one.
  std::string side_of(const std::vector<fem::InterfaceFace<dim>>& faces) const {
    typename Cosserat<dim>::Place towards = Cosserat<dim>::Place::Zero();
    for (const fem::InterfaceFace<dim>& face : faces) {
      const typename Cosserat<dim>::Place centre =
          problem_.mesh.element_positions(face.neighbours.front()).colwise().mean();
      for (const int node : face.nodes_a)
        towards += centre - problem_.mesh.nodes[static_cast<std::size_t>(node)];
    }
    constexpr int up = dim - 1;
    if (towards.template head<up>().norm() < std::abs(towards(up)))
      return towards(up) > 0.0 ? "above" : "below";
    return towards(0) > 0.0 ? "right" : "left";
  }

  std::vector<int> rotations_of(const Curve& curve, const std::vector<int>& nodes) const {
    std::vector<int> entries;
    const auto places = problem_.places();
    for (const int node : nodes) {
      if (curve.beam) {
        entries.push_back(places.entry(0, node));
        continue;
      }
      for (int k = 0; k < Cosserat<dim>::rotations; ++k)
        entries.push_back(fem::entry_of<dim>(node) + dim + k);
    }
    return entries;
  }

  CaseParts& parts_;
  fem::Problem<dim>& problem_;
  std::vector<std::unique_ptr<Curve>> curves_;
  std::vector<std::pair<const Entry*, std::vector<std::string>>> clamped_sections_;
  std::map<std::string, std::shared_ptr<const fem::Contribution<dim>>> beams_;
  std::string name_;  ///< of what is read
};

template <int dim>
void finish(CaseParts& parts) {
  fem::Problem<dim>& problem = parts.result.problem_of<dim>();
  const auto is_given = [&](const std::string& name, fem::Dof dof) {
    return std::ranges::any_of(problem.prescribed,
                               [&](const auto& item) { return item.on == name && item.dof == dof; });
  };
  for (const auto& [name, entry] : parts.rigid_bodies) {
    for (const fem::Dof dof : fem::node_dofs<dim>()) {
      if (fem::is_rotation(dof) || is_given(name, dof)) continue;
      parts.faults.push_back(entry->fault(fmt::format(
          "interface '{0}': the rigid body behind it needs {1}; give it below 'boundary', for example "
          "{{on: {0}, fix: [{1}]}}",
          name, fem::name_of<dim>(dof))));
    }
  }
  for (const auto& [name, dof] : parts.own_rotations)
    if (!is_given(name, dof)) problem.prescribed.push_back({name, dof, fem::TimeTable::constant(0.0), {}});
}

}  // namespace

void read_structures(const Entry* interfaces, const Entry* beams, const Entry* anchors, CaseParts& parts) {
  if (parts.result.space)
    StructuresReader<3>(parts).read(interfaces, beams, anchors);
  else
    StructuresReader<2>(parts).read(interfaces, beams, anchors);
}

void finish_structures(CaseParts& parts) {
  parts.result.space ? finish<3>(parts) : finish<2>(parts);
}

}  // namespace polargrain::coupler
