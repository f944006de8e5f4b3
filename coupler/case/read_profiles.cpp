// SPDX-License-Identifier: GPL-2.0-or-later
// Values at places inside of the body: monitors with `at`, and profiles along lines.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "coupler/case/parts.hpp"
#include "fem/mesh/find_place.hpp"

namespace polargrain::coupler {
namespace {

constexpr int kMostPoints = 10000;  ///< of a profile

std::vector<double> read_place(Section& section, const std::string& key, CaseParts& parts) {
  return section.quantities(key, static_cast<std::size_t>(parts.result.dimension()), Dimension::length,
                            Limit::any);
}

/// Tells whether some element has a place, and whether values there have two sides; yes and no as long as there is no mesh to look at.
class Body {
 public:
  explicit Body(const CaseParts& parts) : parts_(parts) {
    if (!parts.has_mesh) return;
    materials_ = parts.result.with_problem(
        [&](const auto& problem) { return numbers_of_materials(problem.mesh, parts.result.regions); });
    if (parts.result.space)
      space_.emplace(parts.result.space->mesh);
    else
      plane_.emplace(parts.result.problem.mesh);
  }
  [[nodiscard]] bool has(const std::vector<double>& at) const {
    if (space_) return !space_->find({at[0], at[1], at[2]}).elements.empty();
    return !plane_ || !plane_->find({at[0], at[1]}).elements.empty();
  }
  /// Where one of the values differs on the sides of a place: why, and a place to one side. Else empty.
  [[nodiscard]] std::string sides_of(const std::vector<double>& at,
                                     const std::vector<PlaceValue>& values) const {
    if (space_) return sides_in(*space_, parts_.result.space->mesh, at, values);
    return plane_ ? sides_in(*plane_, parts_.result.problem.mesh, at, values) : "";
  }

 private:
  template <int dim>
  [[nodiscard]] std::string sides_in(const fem::PlaceFinder<dim>& finder, const fem::Mesh<dim>& mesh,
                                     const std::vector<double>& at,
                                     const std::vector<PlaceValue>& values) const {
    using Place = typename Cosserat<dim>::Place;
    constexpr double kAside = 0.05;  // of the way to the middle of the elements
    const Place place = Eigen::Map<const Place>(at.data());
    const fem::Probe<dim> probe = finder.find(place);
    const bool parted = fem::sides_at(mesh, probe).size() > 1;
    const std::vector<fem::Probe<dim>> sides = fem::sides_at(mesh, probe, materials_);
    if (sides.size() < 2) return "";
    const Place middle = fem::middle_of(mesh, sides.front());
    const Place across = fem::middle_of(mesh, sides.back()) - middle;
    const auto jumps = [&](const PlaceValue& value) {
      if (parted || !value.is_stress) return parted;
      // Balance makes the stress normal to a border the same on both sides.
      for (int i = 0; i < dim; ++i)
        if (sides.size() == 2 && value.name == fmt::format("s{0}{0}", i + 1) &&
            std::abs(across(i)) > (1.0 - 1e-9) * across.norm())
          return false;
      return true;
    };
    if (std::ranges::none_of(values, jumps)) return "";
    const Place aside = place + kAside * (middle - place);
    std::string example;
    for (const double x : aside) example += fmt::format("{}{:.4g} m", example.empty() ? "" : ", ", x);
    return fmt::format("{}; give a place to one side, for example [{}]",
                       parted ? "an interface parts the body here, and each side has its own value"
                              : "two materials meet here, and the stress has a value on each side",
                       example);
  }

  const CaseParts& parts_;
  std::vector<int> materials_;
  std::optional<fem::PlaceFinder<2>> plane_;
  std::optional<fem::PlaceFinder<3>> space_;
};

/// Evenly along a straight line, both ends included. @returns nothing, with faults, when one of them is not understood
std::vector<std::vector<double>> places_between(Section& section, CaseParts& parts) {
  const std::size_t faults_before = parts.faults.size();
  const std::vector<double> from = read_place(section, "from", parts);
  const std::vector<double> to = read_place(section, "to", parts);
  const bool are_known = parts.faults.size() == faults_before;
  const int points = section.whole_or("points", 2, 51);
  if (!are_known) return {};
  std::vector<std::vector<double>> places{from};
  if (from == to)
    section.fault(
        "to",
        "to: the same place as 'from'; give the other end of the line, or read one place by a monitor "
        "with 'at'");
  if (points > kMostPoints) {
    section.fault("points", fmt::format("points: at most {}", kMostPoints));
    return places;
  }
  for (int point = 1; point < points; ++point) {
    std::vector<double>& place = places.emplace_back(from);
    for (std::size_t i = 0; i < place.size(); ++i) place[i] += (to[i] - from[i]) * point / (points - 1);
  }
  return places;
}

using PlaceOfNode = std::vector<double>;
/// The places of a curve, each with those that come before and behind it.
using Neighbours = std::map<PlaceOfNode, std::set<PlaceOfNode>>;

/// The nodes of the sides of elements that can lie on a curve, one list a side: in space of the edges of faces.
std::vector<std::vector<int>> lines_of(const fem::Mesh<2>& mesh, const std::string& on) {
  std::vector<std::vector<int>> lines;
  if (const auto boundary = mesh.boundaries.find(on); boundary != mesh.boundaries.end()) {
    for (const fem::BoundarySide& side : boundary->second) lines.push_back(mesh.side_nodes(side));
  } else {
    for (std::size_t e = 0; e < mesh.elements.size(); ++e)
      for (std::size_t side = 0; side < mesh.elements[e].type->sides.size(); ++side)
        lines.push_back(mesh.side_nodes({static_cast<int>(e), static_cast<int>(side)}));
  }
  return lines;
}
std::vector<std::vector<int>> lines_of(const fem::Mesh<3>& mesh, const std::string&) {
  std::vector<std::vector<int>> lines;
  for (const fem::Element<3>& element : mesh.elements)
    for (const auto& face : element.type->sides)
      for (const auto& edge : face.type->sides) {
        std::vector<int>& line = lines.emplace_back();
        for (const int a : edge.nodes)
          line.push_back(element.nodes[static_cast<std::size_t>(face.nodes[static_cast<std::size_t>(a)])]);
      }
  return lines;
}

/// By places: the copies of a node on both sides of an interface are one.
template <int dim>
Neighbours neighbours_on(const fem::Mesh<dim>& mesh, const std::string& on) {
  const auto place = [&](int node) {
    const auto& x = mesh.nodes[static_cast<std::size_t>(node)];
    return PlaceOfNode(x.begin(), x.end());
  };
  Neighbours beside;
  for (const int node : mesh.nodes_on(on)) beside[place(node)];
  for (const std::vector<int>& line : lines_of(mesh, on)) {
    std::vector<PlaceOfNode> way;
    for (const int node : line) way.push_back(place(node));
    if (!std::ranges::all_of(way, [&](const PlaceOfNode& here) { return beside.contains(here); })) continue;
    std::rotate(way.begin() + 1, way.begin() + 2, way.end());  // both ends come before the middle node
    for (std::size_t k = 1; k < way.size(); ++k) {
      beside[way[k - 1]].insert(way[k]);
      beside[way[k]].insert(way[k - 1]);
    }
  }
  return beside;
}

/// The first place that a curve leaves in more than two ways, or the end of all places.
Neighbours::const_iterator first_branch(const Neighbours& beside) {
  return std::ranges::find_if(beside, [](const auto& one) { return one.second.size() > 2; });
}

std::vector<PlaceOfNode> in_order(const Neighbours& beside) {
  std::vector<PlaceOfNode> places;
  if (first_branch(beside) != beside.end()) {
    for (const auto& [place, others] : beside) places.push_back(place);
    return places;
  }
  std::set<PlaceOfNode> done;
  const auto follow = [&](PlaceOfNode place) {
    while (done.insert(place).second) {
      places.push_back(place);
      for (const PlaceOfNode& next : beside.at(place)) {
        if (done.contains(next)) continue;
        place = next;
        break;
      }
    }
  };
  for (const auto& [place, others] : beside)
    if (others.size() < 2) follow(place);
  for (const auto& [place, others] : beside) {
    if (done.contains(place)) continue;
    const PlaceOfNode& one = *others.begin();
    const PlaceOfNode& other = *others.rbegin();
    // A closed curve turns to one hand in the plane; in space it goes to its lower neighbour first.
    const double turn = place.size() > 2 ? 1.0
                                         : (one[0] - place[0]) * (other[1] - place[1]) -
                                               (one[1] - place[1]) * (other[0] - place[0]);
    done.insert(place);
    places.push_back(place);
    follow(turn > 0.0 ? one : other);
    places.push_back(place);
  }
  return places;
}

/// Whether a name stands for an area, as 'all' does: a set that holds all nodes of some element.
template <int dim>
bool holds_an_element(const fem::Mesh<dim>& mesh, const std::string& on) {
  const auto set = mesh.node_sets.find(on);
  if (set == mesh.node_sets.end()) return false;
  const std::set<int> nodes(set->second.begin(), set->second.end());
  return std::ranges::any_of(mesh.elements, [&](const fem::Element<dim>& element) {
    return std::ranges::all_of(element.nodes, [&](int node) { return nodes.contains(node); });
  });
}

/// Rows along several ways have no order, and a curve drawn through them would run to and fro.
template <int dim>
void check_branches(Section& section, const fem::Mesh<dim>& mesh, const std::string& on) {
  if (holds_an_element(mesh, on)) return;
  const Neighbours beside = neighbours_on(mesh, on);
  const auto branch = first_branch(beside);
  if (branch == beside.end()) return;
  std::vector<std::string> at;
  for (const double x : branch->first) at.push_back(fmt::format("{:.4g} m", x));
  section.fault("on",
                fmt::format("on: '{}' branches at [{}], and a profile goes one way; give {}, or a line by "
                            "'from' and 'to'",
                            on, fmt::join(at, ", "),
                            dim == 2 ? "each branch a name in the mesh" : "an edge in place of a face"));
}

/// The nodes of a boundary: the settlement trough of a surface, a wall from below upwards, a lining around.
std::vector<std::vector<double>> places_on(Section& section, CaseParts& parts) {
  const std::string on = section.text("on", "the name of a boundary or node set");
  parts.check_places(section, "on", {on});
  std::vector<std::vector<double>> places;
  parts.result.with_problem([&]<int dim>(const fem::Problem<dim>& problem) {
    if (!parts.has_mesh || !problem.mesh.has_nodes_on(on)) return;
    check_branches<dim>(section, problem.mesh, on);
    places = places_along<dim>(problem.mesh, on);
  });
  return places;
}

/// Tells of a line that runs along a border of two sides; across it each side has a row.
void check_run_along(Section& section, const Profile& profile, const Body& body) {
  for (std::size_t k = 0; k + 1 < profile.places.size(); ++k) {
    std::vector<double> between = profile.places[k];
    for (std::size_t i = 0; i < between.size(); ++i)
      between[i] = 0.5 * (between[i] + profile.places[k + 1][i]);
    const std::string sides = body.sides_of(between, profile.values);
    if (sides.empty()) continue;
    const std::string key = section.find("on") != nullptr ? "on" : "from";
    section.fault(key, fmt::format("{}: the line runs along a border: {}, by 'from' and 'to'", key, sides));
    return;
  }
}

/// The name of a value that a cauchy continuum does not have; empty: it has this one.
std::string missing_in_cauchy(const PlaceValue& value) {
  if (value.unit == "rad") return "micro-rotation";
  return value.unit == "N/m" ? "couple stress" : "";
}

bool is_classical(const CaseParts& parts) {
  return parts.result.with_problem(
      [](const auto& problem) { return problem.continuum == fem::Continuum::cauchy; });
}

/// A name of place_values; a fault at the key where the name is unknown, or stays zero.
PlaceValue value_of(Section& section, const std::string& key, const std::string& name, CaseParts& parts) {
  const int dimension = parts.result.dimension();
  if (const PlaceValue* const value = place_value(name, dimension)) {
    if (const std::string missing = missing_in_cauchy(*value); !missing.empty() && is_classical(parts)) {
      section.fault(
          key,
          fmt::format("{}: {}: a cauchy continuum has no {}, and it stays zero; set 'continuum: cosserat'",
                      key, name, missing));
      return {};
    }
    return *value;
  }
  const std::vector<std::string> known = names_of_place_values(dimension);
  const std::string guess = nearest(name, known);
  section.fault(key, fmt::format("{}: expected one of {}, found '{}'{}", key, listed(known), name,
                                 guess.empty() ? "" : "; did you mean '" + guess + "'?"));
  return {};
}

}  // namespace

template <int dim>
std::vector<std::vector<double>> places_along(const fem::Mesh<dim>& mesh, const std::string& on) {
  return in_order(neighbours_on<dim>(mesh, on));
}
template std::vector<std::vector<double>> places_along<2>(const fem::Mesh<2>&, const std::string&);
template std::vector<std::vector<double>> places_along<3>(const fem::Mesh<3>&, const std::string&);

void read_place_monitor(Section& section, Monitor& monitor, CaseParts& parts) {
  monitor.kind = Monitor::Kind::place;
  const std::size_t faults_before = parts.faults.size();
  monitor.at = read_place(section, "at", parts);
  const bool is_known = parts.faults.size() == faults_before;
  const bool stress = section.find("stress") != nullptr;
  const bool displacement = section.find("displacement") != nullptr;
  if (section.find("on") != nullptr) section.fault("on", "on: 'at' says where; keep one of them");
  if (stress == displacement) {
    section.fault("at", "at: give 'displacement' or 'stress' with it, for example stress: s22");
    return;
  }
  const std::string key = stress ? "stress" : "displacement";
  monitor.component = value_of(section, key, section.text(key, "the name of a component"), parts);
  if (!monitor.component.name.empty() && monitor.component.is_stress != stress)
    section.fault(key, fmt::format("{}: '{}' is no {}", key, monitor.component.name, key));
  if (!is_known) return;  // the place that stands in for it says nothing
  const Body body(parts);
  if (!body.has(monitor.at))
    section.fault("at", "at: this place is outside of the body; give one inside, on the mesh as it is made");
  else if (const std::string sides = body.sides_of(monitor.at, {monitor.component}); !sides.empty())
    section.fault("at", "at: " + sides);
}

void read_profiles(const Entry& entry, CaseParts& parts) {
  Section profiles(entry, "profiles", parts.faults);
  const Body body(parts);
  for (const Entry::Member& member : entry.members) {
    profiles.find(member.key);
    Section section(member.value, fmt::format("profile '{}'", member.key), parts.faults);
    Profile profile;
    profile.name = member.key;
    if (member.key.empty() ||
        member.key.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-") !=
            std::string::npos)
      profiles.fault(member.key,
                     "the name of a profile is part of the name of a file: letters, digits, _ and -");
    if (section.find("on") != nullptr) {
      profile.places = places_on(section, parts);
    } else {
      profile.places = places_between(section, parts);
    }
    for (const std::string& name : section.words("values", "a list of components, for example [s22, u2]"))
      profile.values.push_back(value_of(section, "values", name, parts));
    section.finish();
    check_run_along(section, profile, body);
    if (!profile.places.empty() &&
        std::ranges::none_of(profile.places, [&](const auto& place) { return body.has(place); }))
      section.fault("from",
                    "no point of this line lies in the body; give 'from' and 'to' on the "
                    "mesh as it is made");
    parts.result.profiles.push_back(profile);
  }
  profiles.finish();
}

}  // namespace polargrain::coupler
