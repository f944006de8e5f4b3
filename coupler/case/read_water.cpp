// SPDX-License-Identifier: GPL-2.0-or-later
// The water in the pores: `water`, and the items of `boundary` that give its pressure or bring it in.
#include <fmt/format.h>

#include "coupler/case/parts.hpp"

namespace polargrain::coupler {
namespace {

fem::Permeability read_permeability(Section& section, double unit_weight, Faults& faults) {
  const Entry* const entry = section.require(
      "permeability", "k in m/s, 'kozeny_carman: {diameter: ...}' or a list of [void ratio, k]");
  if (entry == nullptr) return fem::Permeability::constant(0.0);
  if (entry->kind == Entry::Kind::scalar)
    return fem::Permeability::constant(
        section.quantity("permeability", Dimension::velocity, Limit::not_negative));
  if (entry->kind == Entry::Kind::sequence) {
    std::vector<fem::PiecewiseLinear::Knot> knots;
    for (const auto& [void_ratio, k] :
         section.pairs("permeability", Dimension::number, Dimension::velocity, Limit::not_negative))
      knots.push_back({void_ratio, k});
    return knots.empty() ? fem::Permeability::constant(0.0)
                         : fem::Permeability::table(fem::PiecewiseLinear(std::move(knots)));
  }
  Section choice(*entry, section.name() + ": permeability", faults);
  fem::KozenyCarman grains;
  if (const Entry* const of = choice.require("kozeny_carman", "a map with the diameter of the grains")) {
    Section kozeny(*of, section.name() + ": kozeny_carman", faults);
    grains.diameter = kozeny.quantity("diameter", Dimension::length, Limit::positive);
    grains.factor = kozeny.quantity_or("factor", Dimension::number, Limit::positive, grains.factor);
    kozeny.finish();
  }
  choice.finish();
  return fem::Permeability::kozeny_carman(grains, unit_weight);
}

/// Keys that a region may have for itself.
fem::WaterOfRegion read_region(Section& section, const fem::WaterOfRegion& otherwise, double unit_weight,
                               Faults& faults) {
  fem::WaterOfRegion water = otherwise;
  water.void_ratio =
      section.quantity_or("void_ratio", Dimension::number, Limit::positive, otherwise.void_ratio);
  water.bulk_modulus =
      section.quantity_or("bulk_modulus", Dimension::pressure, Limit::positive, otherwise.bulk_modulus);
  const std::string word = otherwise.undrained ? "yes" : "no";
  water.undrained = section.choice_or("undrained", {"yes", "no"}, word) == "yes";
  if (section.find("permeability") != nullptr)
    water.permeability = read_permeability(section, unit_weight, faults);
  return water;
}

void check_permeability(const fem::WaterOfRegion& water, bool given, Section& section) {
  if (water.undrained || given) return;
  section.fault("permeability",
                section.name() +
                    ": the key 'permeability' is missing; give k in m/s, 'kozeny_carman', a table, or "
                    "'undrained: yes' where no water flows");
}

}  // namespace

void read_water(const Entry& entry, CaseParts& parts) {
  Section section(entry, "water", parts.faults);
  WaterOfCase water{&entry, {}, {}};
  water.options.unit_weight =
      section.quantity_or("unit_weight", Dimension::unit_weight, Limit::positive, water.options.unit_weight);
  if (section.find("table") != nullptr)
    water.options.table = section.quantity("table", Dimension::length, Limit::any);
  water.options.theta = section.quantity_or("theta", Dimension::number, Limit::positive, 1.0);
  if (water.options.theta < 0.5 || water.options.theta > 1.0)
    section.fault("theta",
                  "theta: the weight of the end of a step lies between 0.5 and 1 (1 damps, the default)");
  const fem::WaterOfRegion common = read_region(section, {}, water.options.unit_weight, parts.faults);
  const bool has_permeability = section.find("permeability") != nullptr;
  const Entry* const regions = section.find("regions");
  if (regions == nullptr) {
    check_permeability(common, has_permeability, section);
    for (const auto& [region, material] : parts.result.regions) water.regions[region] = common;
  } else {
    Section of_regions(*regions, "water: regions", parts.faults);
    for (const Entry::Member& member : regions->members) {
      of_regions.find(member.key);
      if (!parts.result.regions.contains(member.key)) {
        std::vector<std::string> known;
        for (const auto& [region, material] : parts.result.regions) known.push_back(region);
        const std::string guess = nearest(member.key, known);
        of_regions.fault(member.key, fmt::format("water: no region is named '{}'; {}", member.key,
                                                 guess.empty() ? "there are " + listed(known)
                                                               : "did you mean '" + guess + "'?"));
      }
      Section own(member.value, fmt::format("water in '{}'", member.key), parts.faults);
      const fem::WaterOfRegion made = read_region(own, common, water.options.unit_weight, parts.faults);
      check_permeability(made, has_permeability || own.find("permeability") != nullptr, own);
      water.regions[member.key] = made;
      own.finish();
    }
    of_regions.finish();
  }
  section.finish();
  parts.water = std::move(water);
}

void read_water_boundary(Section& item, const std::vector<std::string>& places, CaseParts& parts,
                         const std::function<fem::TimeTable(const std::string&, Dimension)>& table) {
  for (const char* const key : {"pore_pressure", "water_level", "flux"}) {
    if (item.find(key) == nullptr) continue;
    if (!parts.water) {
      item.fault(key, fmt::format("{}: the case has no water; give 'water' with its permeability", key));
      return;
    }
    const double unit_weight = parts.water->options.unit_weight;
    const std::string name = key;
    if (name == "flux") {
      parts.check_places(item, "on", places, "a flux");
      for (const std::string& place : places)
        parts.water->options.fluxes.push_back({place, table(name, Dimension::velocity)});
      continue;
    }
    const bool level = name == "water_level";
    const fem::TimeTable value = table(name, level ? Dimension::length : Dimension::pressure);
    const auto prescribe = [&]<int dim>(fem::Problem<dim>& problem) {
      fem::PrescribedField<dim> given{fem::kPorePressure, "", value};
      if (level) {
        using Place = typename Cosserat<dim>::Place;
        given.profile = [unit_weight](const Place&) { return unit_weight; };
        given.offset = [unit_weight](const Place& x) { return -unit_weight * x(dim - 1); };
      }
      for (const std::string& place : places) {
        given.on = place;
        problem.prescribed_fields.push_back(given);
      }
    };
    parts.result.with_problem(prescribe);
    if (level && !parts.water->options.table)
      item.fault(
          key,
          "water_level: needs the weight of the water: give 'table', the height of the water table at the start, "
          "below 'water'");
  }
}

void add_water(CaseParts& parts) {
  if (!parts.water || !parts.has_mesh || !parts.faults.empty()) return;
  parts.result.with_problem([&](auto& problem) {
    const auto water = fem::add_pore_water(problem, parts.water->regions, parts.water->options);
    for (const std::string& message : water->faults(problem))
      parts.faults.push_back(parts.water->entry->fault("water: " + message));
  });
}

}  // namespace polargrain::coupler
