// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/element/element_remarks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/remarks/bounds_of_laws.hpp"
#include "app/remarks/few_grains.hpp"
#include "common/elementary_functions.hpp"
#include "coupler/case/quantity.hpp"
#include "fem/material/cone_matching.hpp"

namespace polargrain::app {
namespace {

using coupler::Dimension;
using coupler::Entry;

/// The number of a key; nothing where it is no single number.
std::optional<double> number_of(const Entry& material, const char* key, Dimension dimension) {
  const Entry* const entry = material.find(key);
  if (entry == nullptr || entry->kind != Entry::Kind::scalar) return {};
  return coupler::parse_quantity(entry->text, dimension);
}

void look_at_packings(const Entry& document, const ElementSpecification& specification, Remarks& remarks) {
  constexpr int kFewDiscs = 50;
  constexpr int kFewSpheres = 100;
  const Entry* const list = document.find("packing");
  if (list == nullptr) return;
  for (std::size_t k = 0; k < specification.cells.size(); ++k) {
    const Packing& packing = specification.cells[k].packing;
    const Entry& place = k < list->items.size() ? list->items[k] : *list;
    if (auto remark = remark_on_grains(packing, place, fmt::format("packing '{}'", specification.names[k]),
                                       packing.dimension == 3 ? kFewSpheres : kFewDiscs))
      remarks.push_back(std::move(*remark));
  }
}

void look_at_stiffness(const Entry& material, double pressure, Remarks& remarks) {
  constexpr double kSoftGround = 1e6;  // Pa
  const auto young = number_of(material, "E", Dimension::pressure);
  if (!young || !(*young > 0.0)) return;
  const Entry& place = *material.find("E");
  const double strain = pressure / *young;
  const std::string remedy = "check the unit of E (soils: 5 to 500 MPa) and of the pressure";
  if (strain > kMostElasticStrain || strain < kLeastElasticStrain)
    remarks.push_back(
        {Rank::wrong, std::max(strain / kMostElasticStrain, kLeastElasticStrain / strain),
         place.fault(fmt::format(
             "material: E is {:.4g} kPa, and the pressure is {:.4g} kPa: that alone is an elastic "
             "strain of {:.3g} %",
             1e-3 * *young, 1e-3 * pressure, 100.0 * strain)),
         remedy});
  else if (*young < kSoftGround)
    remarks.push_back({Rank::doubtful, kSoftGround / *young,
                       place.fault(fmt::format("material: E is {:.4g} kPa", 1e-3 * *young)), remedy});
}

/// A state that a test brings a cone to.
struct TestState {
  std::optional<double> b;  ///< (s2 - s3) / (s1 - s3) there; nothing: plane strain
  /// For messages, and with "_" the value of `match` where there is one.
  [[nodiscard]] std::string name() const {
    if (!b) return "plane strain";
    if (has_match()) return *b == 0.0 ? "triaxial compression" : "triaxial extension";
    return fmt::format("a test with b = {:.3g}", *b);
  }
  [[nodiscard]] bool has_match() const { return !b || *b == 0.0 || *b == 1.0; }
};

/// Of a stage that loads axis 2 while lateral or mean stresses stay, or the volume; empty of other stages. Cycles have two.
std::vector<TestState> states_of(const element::Stage& stage) {
  using element::Constraint;
  if (stage.name == "simple_shear") return {TestState{}};
  const Constraint* axial = nullptr;
  bool others_stay = stage.pore >= 0;
  std::optional<double> place;  // of s33 between s11 and s22
  for (const Constraint& constraint : stage.constraints) {
    const bool is_stress = constraint.kind == Constraint::Kind::stress;
    const bool is_held = constraint.way == Constraint::Way::hold;
    const element::Vector6& weights = constraint.weights;
    const bool is_deviator = constraint.place < 0 && is_stress && weights(k11) > 0.0 && weights(k22) < 0.0;
    if (!is_held && constraint.amount != 0.0 && (constraint.place == k22 || is_deviator)) axial = &constraint;
    if (is_stress && is_held && (constraint.place == k11 || constraint.name == "p")) others_stay = true;
    if (constraint.place == k33 && is_stress) place = 0.0;
    if (constraint.place < 0 && is_stress && weights(k33) == 1.0) place = 0.0 - weights(k22);
  }
  if (axial == nullptr || !others_stay) return {};
  if (!place) return {TestState{}};
  const TestState compression{*place};
  const TestState extension{1.0 - *place};
  if (axial->way == Constraint::Way::cycle) return {compression, extension};
  // A deviator counts compression as positive, a component tension.
  return {(axial->amount > 0.0) == (axial->place < 0) ? compression : extension};
}

/// 1 / sin(angle) = root / M + rest: q = M p in principal stresses, q = sqrt(1 - b + b^2) (s1 - s3).
struct AngleAtRatio {
  explicit AngleAtRatio(double b) : root(2.0 * std::sqrt(1.0 - b + b * b)), rest((1.0 - 2.0 * b) / 3.0) {}
  double root;
  double rest;
};

/// The friction angle of a cone in a state, degrees; nothing where it has no limit there.
std::optional<double> angle_in(const fem::FrozenCone& cone, const TestState& state) {
  if (state.b) {
    const AngleAtRatio at(*state.b);
    const double inverse = at.root / cone.friction + at.rest;
    if (!(inverse > 1.0)) return std::nullopt;
    return arc_sine(1.0 / inverse) * 180.0 / std::numbers::pi;
  }
  const auto strength = fem::plane_strain_from_cone(cone);
  return strength ? std::optional(strength->friction_angle) : std::nullopt;
}

/// The remedy: the keys of a cone that has an angle in a state. @param degrees of that angle
std::string remedy_for(const TestState& state, double degrees, bool in_cycles) {
  std::string word = state.name();
  std::ranges::replace(word, ' ', '_');
  if (state.has_match() && in_cycles)
    return fmt::format("match: {} (a cone has its angle on one side of the cycles alone)", word);
  if (state.has_match()) return fmt::format("match: {}", word);
  // The cone through this state, as the angle that it has in triaxial compression.
  const AngleAtRatio at(*state.b);
  const double slope = at.root / (1.0 / sine(degrees * std::numbers::pi / 180.0) - at.rest);
  const auto there = angle_in({slope, 0.0, 0.0}, TestState{0.0});
  if (!there) return "a cone has this angle in no triaxial test; take grains";
  return fmt::format("match: triaxial_compression with friction_angle: {:.4g} deg has it", *there);
}

/// A cone has its friction angle in the states of `match` alone, by default in plane strain. Where that is given, a strength far above
/// the angle is told.
void look_at_cone(const Entry& material, const ElementSpecification& specification, Remarks& remarks) {
  constexpr double kFarAngle = 1.25;
  constexpr double kNearAngle = 0.02;
  const Entry* const model = material.find("model");
  if (model == nullptr || model->text != "elastoplastic") return;
  const auto friction = number_of(material, "friction_angle", Dimension::angle);
  if (!friction || !(*friction > 0.0)) return;
  const Entry* const given = material.find("match");
  constexpr std::pair<const char*, fem::ConeMatch> kMatches[] = {
      {"plane_strain", fem::ConeMatch::plane_strain},
      {"triaxial_compression", fem::ConeMatch::triaxial_compression},
      {"triaxial_extension", fem::ConeMatch::triaxial_extension},
      {"inner", fem::ConeMatch::inner}};
  const auto match = std::ranges::find_if(kMatches, [&](const auto& known) {
    return known.first == (given == nullptr ? std::string("plane_strain") : given->text);
  });
  if (match == std::end(kMatches)) return;
  constexpr double kOneRadian = 180.0 / std::numbers::pi;
  const double dilatancy = number_of(material, "dilatancy_angle", Dimension::angle).value_or(0.0);
  const double degrees = kOneRadian * *friction;
  const fem::FrozenCone cone = fem::matched_cone({degrees, kOneRadian * dilatancy, 0.0}, match->second);
  for (const element::Stage& stage : specification.stages) {
    const std::vector<TestState> states = states_of(stage);
    for (const TestState& state : states) {
      const auto there = angle_in(cone, state);
      if (there && std::abs(*there - degrees) <= kNearAngle * degrees) continue;
      if (given != nullptr && there && *there < kFarAngle * degrees) continue;
      const std::string remedy = remedy_for(state, degrees, states.size() > 1 && given != nullptr);
      remarks.push_back(
          {Rank::doubtful, there ? std::max(degrees / *there, *there / degrees) : 10.0,
           material.find("friction_angle")
               ->fault(fmt::format(
                   "material: {:.4g} deg hold {}{}; in {} this cone has {}", degrees,
                   given == nullptr ? "in plane strain, the default here" : "where 'match' says: ",
                   given == nullptr ? "" : given->text, state.name(),
                   there ? fmt::format("{:.4g} deg", *there) : std::string("no limit"))),
           given == nullptr ? fmt::format("{}; or say 'match: plane_strain' if it is meant", remedy)
                            : remedy});
      return;
    }
  }
}

void look_at_cohesion(const Entry& material, double pressure, Remarks& remarks) {
  const auto cohesion = number_of(material, "cohesion", Dimension::pressure);
  if (!cohesion || *cohesion <= kMostCohesion * pressure) return;
  remarks.push_back(
      {Rank::doubtful, *cohesion / pressure / kMostCohesion,
       material.find("cohesion")
           ->fault(fmt::format("material: a cohesion of {:.4g} kPa, and the pressure is {:.4g} kPa",
                               1e-3 * *cohesion, 1e-3 * pressure)),
       "check the unit of the cohesion and of the pressure"});
}

/// The prescribed stress that a stage brings from the side of pressure to tension; null: no stress does, or the others outweigh it.
/// @param stresses the normal ones, as far as they are known; goes to the end of the stage
const element::Constraint* tension_in(const element::Stage& stage,
                                      std::array<std::optional<double>, 3>& stresses) {
  using element::Constraint;
  const auto before = std::exchange(stresses, {});
  const Constraint* found = nullptr;
  double sum = 0.0;
  bool is_known = true;  // one that is held where a strain or a sum has left it may outweigh the others
  for (const Constraint& constraint : stage.constraints) {
    if (constraint.kind != Constraint::Kind::stress) continue;
    const bool reaches = constraint.way == Constraint::Way::reach;
    // p counts compression positive; it is the whole mean stress.
    if (reaches && constraint.name == "p" && constraint.amount < 0.0) return &constraint;
    if (constraint.place < 0) is_known = false;
    if (constraint.place < 0 || constraint.place > k33) continue;
    const auto place = static_cast<std::size_t>(constraint.place);
    if (reaches)
      stresses[place] = constraint.amount;
    else if (before[place])
      stresses[place] = *before[place] * (constraint.way == Constraint::Way::scale ? constraint.amount : 1.0);
    is_known = is_known && stresses[place].has_value();
    sum += stresses[place].value_or(0.0);
    if (reaches && constraint.amount > 0.0 && found == nullptr) found = &constraint;
  }
  return is_known && sum > 0.0 ? found : nullptr;
}

/// Keys of tests count compression positive, components tension: a wrong sign pulls at a sample that begins under pressure.
void look_at_tension(const Entry& document, const ElementSpecification& specification, Remarks& remarks) {
  std::array<std::optional<double>, 3> stresses;
  stresses.fill(-specification.pressure);
  const Entry* const list = document.find("stages");
  for (std::size_t k = 1; k < specification.stages.size(); ++k) {  // 0 is the consolidation
    const element::Stage& stage = specification.stages[k];
    const element::Constraint* const pull = tension_in(stage, stresses);
    if (pull == nullptr) continue;
    const Entry& of_stage = list != nullptr && k <= list->items.size() ? list->items[k - 1] : document;
    const bool is_named = of_stage.find("test") != nullptr;
    const std::string key = is_named ? "axial_stress" : pull->name;
    const Entry* const place = of_stage.find(key);
    if (place == nullptr) continue;
    const bool is_component = !is_named && key != "p";
    const double amount = 1e-3 * std::abs(pull->amount);
    remarks.push_back(
        {Rank::wrong, std::max(1.0, 1e3 * amount / specification.pressure),
         place->fault(fmt::format("{}: {} is tension, and the sample begins under {:.4g} kPa of pressure",
                                  key, place->text, 1e-3 * specification.pressure)),
         is_component
             ? fmt::format("{} counts tension positive; write -{:.6g} kPa for compression", key, amount)
             : fmt::format("{} counts compression positive; write {:.6g} kPa", key, amount)});
    return;
  }
}

void look_at_void_ratio(const Entry& document, const ElementSpecification& specification, Remarks& remarks) {
  if (!specification.void_ratio || *specification.void_ratio <= kMostVoidRatio) return;
  remarks.push_back(
      {Rank::doubtful, *specification.void_ratio / kMostVoidRatio,
       document.find("void_ratio")
           ->fault(fmt::format("void_ratio: {:.4g} (sand: 0.4 to 1, clay: to 3)", *specification.void_ratio)),
       fmt::format("check it; if per cent are meant, write {:.4g}", 0.01 * *specification.void_ratio)});
}

}  // namespace

Remarks remarks_on_element(const Entry& document, std::span<const ElementSpecification> specifications) {
  Remarks remarks;
  const ElementSpecification& first = specifications.front();
  look_at_packings(document, first, remarks);
  look_at_tension(document, first, remarks);
  look_at_void_ratio(document, first, remarks);
  if (const Entry* const material = document.find("material")) {
    const double pressure =
        std::ranges::max_element(specifications, {}, &ElementSpecification::pressure)->pressure;
    look_at_stiffness(*material, pressure, remarks);
    look_at_cohesion(*material, pressure, remarks);
    look_at_cone(*material, first, remarks);
  }
  std::ranges::stable_sort(remarks, [](const Remark& a, const Remark& b) {
    return a.rank != b.rank ? a.rank < b.rank : a.weight > b.weight;
  });
  return remarks;
}

}  // namespace polargrain::app
