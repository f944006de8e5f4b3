// SPDX-License-Identifier: GPL-2.0-or-later
// Values at places inside of the body: monitors with `at`, and profiles along lines.
#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "coupler/case/parts.hpp"
#include "fem/mesh/find_place.hpp"

namespace polargrain::coupler {
namespace {

constexpr int kMostPoints = 10000;  ///< of a profile

std::vector<double> read_place(Section& section, const std::string& key, CaseParts& parts) {
  return section.quantities(key, static_cast<std::size_t>(parts.result.dimension()), Dimension::length,
                            Limit::any);
}

/// Tells whether some element has a place; yes as long as there is no mesh to look at.
class Body {
 public:
  explicit Body(const CaseParts& parts) {
    if (!parts.has_mesh) return;
    if (parts.result.space)
      space_.emplace(parts.result.space->mesh);
    else
      plane_.emplace(parts.result.problem.mesh);
  }
  [[nodiscard]] bool has(const std::vector<double>& at) const {
    if (space_) return !space_->find({at[0], at[1], at[2]}).elements.empty();
    return !plane_ || !plane_->find({at[0], at[1]}).elements.empty();
  }

 private:
  std::optional<fem::PlaceFinder<2>> plane_;
  std::optional<fem::PlaceFinder<3>> space_;
};

/// Evenly along a straight line, both ends included.
std::vector<std::vector<double>> places_between(Section& section, CaseParts& parts) {
  const std::vector<double> from = read_place(section, "from", parts);
  const std::vector<double> to = read_place(section, "to", parts);
  const int points = section.whole_or("points", 2, 51);
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

/// The nodes of a boundary, by their coordinates: the settlement trough of a surface, a wall from below upwards.
std::vector<std::vector<double>> places_on(Section& section, CaseParts& parts) {
  const std::string on = section.text("on", "the name of a boundary or node set");
  parts.check_places(section, "on", {on});
  std::vector<std::vector<double>> places;
  parts.result.with_problem([&](const auto& problem) {
    if (!parts.has_mesh || !problem.mesh.has_nodes_on(on)) return;
    for (const int node : problem.mesh.nodes_on(on)) {
      const auto& place = problem.mesh.nodes[static_cast<std::size_t>(node)];
      places.emplace_back(place.begin(), place.end());
    }
  });
  std::ranges::sort(places);
  return places;
}

/// A name of place_values; a fault at the key where the name is unknown.
PlaceValue value_of(Section& section, const std::string& key, const std::string& name, CaseParts& parts) {
  const int dimension = parts.result.dimension();
  if (const PlaceValue* const value = place_value(name, dimension)) return *value;
  const std::vector<std::string> known = names_of_place_values(dimension);
  const std::string guess = nearest(name, known);
  section.fault(key, fmt::format("{}: expected one of {}, found '{}'{}", key, listed(known), name,
                                 guess.empty() ? "" : "; did you mean '" + guess + "'?"));
  return {};
}

}  // namespace

void read_place_monitor(Section& section, Monitor& monitor, CaseParts& parts) {
  monitor.kind = Monitor::Kind::place;
  monitor.at = read_place(section, "at", parts);
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
  if (!Body(parts).has(monitor.at))
    section.fault("at", "at: this place is outside of the body; give one inside, on the mesh as it is made");
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
