// SPDX-License-Identifier: GPL-2.0-or-later
// The water in the pores: `water`, the items of `boundary` that give its pressure or bring it in, and its monitors.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "coupler/case/parts.hpp"
#include "coupler/case/water_values.hpp"
#include "fem/water/free_water.hpp"

namespace polargrain::coupler {
namespace {

constexpr const char* kPermeabilities =
    "k such as 1e-5 m/s, 'kozeny_carman: {diameter: 0.2 mm}', or a list of [void ratio, k]";

bool is_yes(const std::string& word) {
  return word == "true" || word == "yes";
}
const std::vector<std::string> kYesOrNo{"true", "false", "yes", "no"};

/// @param unit_weight of the water, N/m^3
fem::Permeability read_permeability(Section& section, double unit_weight, Faults& faults) {
  const fem::Permeability nothing = fem::Permeability::constant(0.0);
  const Entry* const entry = section.require("permeability", kPermeabilities);
  if (entry == nullptr) return nothing;
  if (entry->kind == Entry::Kind::scalar)
    return fem::Permeability::constant(section.quantity("permeability", Dimension::flow, Limit::positive));
  if (entry->kind == Entry::Kind::sequence) {
    std::vector<fem::PiecewiseLinear::Knot> knots;
    for (const auto& [void_ratio, k] :
         section.pairs("permeability", Dimension::number, Dimension::flow, Limit::positive))
      knots.push_back({void_ratio, k});
    return knots.empty() ? nothing : fem::Permeability::table(fem::PiecewiseLinear(std::move(knots)));
  }
  Section choice(*entry, section.name() + ": permeability", faults);
  fem::KozenyCarman grains;
  if (const Entry* const of = choice.require("kozeny_carman", "a map such as {diameter: 0.2 mm}")) {
    Section kozeny(*of, section.name() + ": kozeny_carman", faults);
    grains.diameter = kozeny.quantity("diameter", Dimension::length, Limit::positive);
    grains.factor = kozeny.quantity_or("factor", Dimension::number, Limit::positive, grains.factor);
    kozeny.finish();
  }
  choice.finish();
  return grains.diameter > 0.0 ? fem::Permeability::kozeny_carman(grains, unit_weight) : nothing;
}

/// The keys that a region may have for itself, and which of them are there.
struct RegionKeys {
  fem::WaterOfRegion water;
  bool has_void_ratio = false;
  bool has_permeability = false;
};

RegionKeys read_region(Section& section, const RegionKeys& otherwise, double unit_weight, Faults& faults) {
  RegionKeys keys = otherwise;
  fem::WaterOfRegion& water = keys.water;
  keys.has_void_ratio = section.find("void_ratio") != nullptr || otherwise.has_void_ratio;
  keys.has_permeability = section.find("permeability") != nullptr || otherwise.has_permeability;
  water.void_ratio = section.quantity_or("void_ratio", Dimension::number, Limit::positive, water.void_ratio);
  water.bulk_modulus =
      section.quantity_or("bulk_modulus", Dimension::pressure, Limit::positive, water.bulk_modulus);
  constexpr double kOfAir = 100e3;  // Pa
  if (water.bulk_modulus < kOfAir)
    section.fault("bulk_modulus",
                  fmt::format("bulk_modulus: {:.4g} Pa; air has 100 kPa, water 2.2 GPa: write the unit",
                              water.bulk_modulus));
  water.undrained = is_yes(section.choice_or("undrained", kYesOrNo, water.undrained ? "yes" : "no"));
  if (section.find("permeability") != nullptr)
    water.permeability = read_permeability(section, unit_weight, faults);
  return keys;
}

/// That a region has all it needs, once its own keys and the common ones are known.
void check_region(const RegionKeys& keys, Section& section) {
  if (!keys.water.undrained && !keys.has_permeability)
    section.fault(
        "permeability",
        fmt::format(
            "{}: the key 'permeability' is missing; expected {}, or 'undrained: true' where no water flows",
            section.name(), kPermeabilities));
  if (!keys.water.undrained && keys.water.permeability.varies() && !keys.has_void_ratio)
    section.fault("permeability",
                  fmt::format("{}: a permeability by the void ratio needs 'void_ratio', that at the start",
                              section.name()));
}

void read_regions(const Entry& entry, const RegionKeys& common, WaterOfCase& water, CaseParts& parts) {
  Section regions(entry, "water: regions", parts.faults);
  std::vector<std::string> known;
  for (const auto& [region, material] : parts.result.regions) known.push_back(region);
  for (const Entry::Member& member : entry.members) {
    regions.find(member.key);
    if (std::ranges::find(known, member.key) == known.end()) {
      const std::string guess = nearest(member.key, known);
      regions.fault(member.key, fmt::format("water: regions: there is no region '{}'; {}", member.key,
                                            guess.empty() ? "there are " + listed(known)
                                                          : "did you mean '" + guess + "'?"));
      continue;
    }
    Section own(member.value, fmt::format("water: region '{}'", member.key), parts.faults);
    RegionKeys keys;
    for_its_faults(parts.faults, [&] {  // left out, they are as of the water
      keys = read_region(own, common, water.options.unit_weight, parts.faults);
    });
    check_region(keys, own);
    own.finish();
    water.regions[member.key] = keys.water;
  }
  regions.finish();
}

/// p at given nodes: by the height of a water level, or the same at all of them.
template <int dim>
fem::PrescribedField<dim> given_pressure(const fem::TimeTable& value, std::optional<double> unit_weight) {
  fem::PrescribedField<dim> given{fem::kPorePressure, "", value};
  if (unit_weight) {
    using Place = typename Cosserat<dim>::Place;
    given.profile = [weight = *unit_weight](const Place&) { return weight; };
    given.offset = [weight = *unit_weight](const Place& x) { return -weight * x(dim - 1); };
  }
  return given;
}

/// Whether water flows anywhere. If not, all boundaries are closed.
bool flows(const WaterOfCase& water) {
  return std::ranges::any_of(water.regions, [](const auto& region) { return !region.second.undrained; });
}

void prescribe(const std::vector<std::string>& places, const fem::TimeTable& value,
               std::optional<double> unit_weight, CaseParts& parts) {
  if (!flows(*parts.water)) return;
  const auto add = [&]<int dim>(fem::Problem<dim>& problem) {
    fem::PrescribedField<dim> given = given_pressure<dim>(value, unit_weight);
    for (const std::string& place : places) {
      given.on = place;
      problem.prescribed_fields.push_back(given);
    }
  };
  parts.result.with_problem(add);
}

/// Whether free water stands above all of a boundary at all times.
bool always_covers(Section& item, const fem::TimeTable& level, const std::string& boundary,
                   CaseParts& parts) {
  const double highest = parts.result.with_problem([&](const auto& problem) {
    double height = -HUGE_VAL;
    for (const int node : problem.mesh.nodes_on(boundary))
      height = std::max(height, problem.mesh.nodes[static_cast<std::size_t>(node)].template tail<1>()(0));
    return height;
  });
  double lowest = level.at(0.0);
  if (item.find("free_water")->kind == Entry::Kind::sequence)
    for (const auto& [time, height] : item.pairs("free_water", parts.time(), Dimension::length, Limit::any))
      lowest = std::min(lowest, height);
  return lowest >= highest;
}

/// Whether a stage before this one has left a boundary open. A pressure that is given there from now on would jump.
template <int dim>
bool was_open(const fem::Problem<dim>& problem, const std::string& boundary, const CaseParts& parts) {
  if (parts.now.number == 0) return false;
  const fem::PoreWater<dim>* const water = fem::pore_water_of(problem);
  return water != nullptr && std::ranges::any_of(water->options().open_sides, [&](const fem::OpenSide& side) {
           return side.on == boundary && side.life && side.life->begin < parts.now.number;
         });
}

/// A boundary that free water leaves dry in part or for a while. A pressure given there would feed or drain dry ground for ever.
template <int dim>
void leave_open(fem::Problem<dim>& problem, const std::string& boundary, CaseParts& parts) {
  if (!flows(*parts.water)) return;
  std::optional<fem::OpenSide> side;
  std::optional<double> before;
  fem::PoreWater<dim>* water = nullptr;  // of stages: it is there when they are read
  for (const auto& contribution : problem.contributions) {
    if (auto* const there = dynamic_cast<fem::PoreWater<dim>*>(contribution.get())) water = there;
    const auto* const free = dynamic_cast<const fem::FreeWater<dim>*>(contribution.get());
    if (free == nullptr || free->on() != boundary) continue;
    // The last one is that of this item; a stage that ends it ends the side too.
    if (side) before = side->level.at(parts.now.start);
    side = fem::OpenSide{boundary, free->level(),
                         std::shared_ptr<const fem::Lifetime>(contribution, &contribution->life)};
  }
  if (!side) return;
  if (before && parts.now.number > 0 && parts.now.end) {
    side->level_before = *before;
    side->start = parts.now.start;
    side->end = *parts.now.end;
  }
  if (water != nullptr)
    water->open_side(problem, std::move(*side));
  else
    parts.water->options.open_sides.push_back(std::move(*side));
}

}  // namespace

void read_water(const Entry& entry, CaseParts& parts) {
  Section section(entry, "water", parts.faults);
  WaterOfCase water{&entry, {}, {}};
  water.options.unit_weight =
      section.quantity_or("unit_weight", Dimension::unit_weight, Limit::positive, water.options.unit_weight);
  if (section.find("level") != nullptr)
    water.options.table = section.quantity("level", Dimension::length, Limit::any);
  water.options.pressure_change =
      section.quantity_if("pressure_change", Dimension::pressure, Limit::positive).value_or(0.0);
  if (water.options.pressure_change > 0.0)
    water.options.shortest_step = section.quantity("shortest_step", Dimension::duration, Limit::positive);
  const RegionKeys common = read_region(section, {}, water.options.unit_weight, parts.faults);
  if (const Entry* const regions = section.find("regions")) {
    read_regions(*regions, common, water, parts);
  } else {
    check_region(common, section);
    for (const auto& [region, material] : parts.result.regions) water.regions[region] = common.water;
  }
  section.finish();
  parts.water = std::move(water);
}

bool read_water_boundary(Section& item, const std::vector<std::string>& places, CaseParts& parts,
                         const TableReader& table) {
  static const std::vector<std::string> kKeys{"drained", "pore_pressure", "water_level", "free_water",
                                              "flux"};
  std::vector<std::string> found;
  for (const std::string& key : kKeys)
    if (item.find(key) != nullptr) found.push_back(key);
  if (found.empty()) return false;
  const std::string& key = found.front();
  if (!parts.water) {
    item.fault(key, fmt::format("{}: the case has no water; give 'water' with its permeability", key));
    return true;
  }
  if (found.size() > 1)
    item.fault(found[1],
               fmt::format("{}: beside '{}'; a boundary has one of {}", found[1], key, listed(kKeys)));
  const fem::PoreWaterOptions& options = parts.water->options;
  if (key == "flux") {
    if (parts.now.number > 0)
      item.fault(
          key,
          "flux: a flux begins with the case; give a table over the time in the list 'boundary' of the case");
    parts.check_places(item, "on", places, "a flux");
    const fem::TimeTable value = table(key, Dimension::flow);
    if (!flows(*parts.water)) return true;
    for (const std::string& place : places) parts.water->options.fluxes.push_back({place, value});
  } else if (key == "pore_pressure") {
    prescribe(places, table(key, Dimension::pressure), {}, parts);
  } else if (key == "water_level" || key == "free_water") {
    if (!options.table)
      item.fault(
          key,
          key +
              ": without 'level' below 'water', the level at the start, pressures are those in excess of water at rest; give it, or 'pore_pressure'");
    const fem::TimeTable level = table(key, Dimension::length);
    if (key == "water_level") {
      prescribe(places, level, options.unit_weight, parts);
    } else {
      for (const std::string& boundary : add_free_water(item, places, level, parts))
        parts.result.with_problem([&]<int dim>(fem::Problem<dim>& problem) {
          if (always_covers(item, level, boundary, parts) && !was_open<dim>(problem, boundary, parts))
            prescribe({boundary}, level, options.unit_weight, parts);
          else
            leave_open<dim>(problem, boundary, parts);
        });
    }
  } else if (is_yes(item.choice_or(key, kYesOrNo, "no"))) {
    if (options.table) {
      prescribe(places, fem::TimeTable::constant(*options.table), options.unit_weight, parts);
    } else {
      prescribe(places, fem::TimeTable::constant(0.0), {}, parts);
    }
  }
  return true;
}

void add_water(CaseParts& parts) {
  if (!parts.water || !parts.has_mesh || !parts.faults.empty()) {
    add_water_at_interfaces(parts);
    return;
  }
  const auto add = [&]<int dim>(fem::Problem<dim>& problem) {
    const auto water = fem::add_pore_water<dim>(problem, parts.water->regions, parts.water->options);
    for (const std::string& message : water->faults(problem))
      parts.faults.push_back(parts.water->entry->fault("water: " + message));
  };
  parts.result.with_problem(add);
  add_water_at_interfaces(parts);
}

bool read_water_monitor(Section& section, CaseParts& parts, Monitor& monitor) {
  if (section.find("water") == nullptr) return false;
  monitor.kind = Monitor::Kind::water;
  monitor.value = section.choice("water", values_of_water());
  monitor.on = section.words("on", "the name of a boundary or node set, or a list of them");
  section.finish();
  parts.check_places(section, "on", monitor.on);
  if (!parts.water) {
    section.fault("water", section.name() + ": the case has no water; give 'water' with its permeability");
  } else if (parts.faults.empty() && !has_water_at(parts.result, monitor.on)) {
    section.fault("on", section.name() + ": no corner of an element with water is there");
  }
  return true;
}

}  // namespace polargrain::coupler
