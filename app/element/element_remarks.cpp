// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/element/element_remarks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

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

/// The bounds of strain are those of `check` (kinds/laws.cpp).
void look_at_stiffness(const Entry& material, double pressure, Remarks& remarks) {
  constexpr double kMostStrain = 0.05;
  constexpr double kLeastStrain = 1e-7;
  constexpr double kSoftGround = 1e6;  // Pa
  const auto young = number_of(material, "E", Dimension::pressure);
  if (!young || !(*young > 0.0)) return;
  const Entry& place = *material.find("E");
  const double strain = pressure / *young;
  const std::string remedy = "check the unit of E (soils: 5 to 500 MPa) and of the pressure";
  if (strain > kMostStrain || strain < kLeastStrain)
    remarks.push_back(
        {Rank::wrong, std::max(strain / kMostStrain, kLeastStrain / strain),
         place.fault(fmt::format(
             "material: E is {:.4g} kPa, and the pressure is {:.4g} kPa: that alone is an elastic "
             "strain of {:.3g} %",
             1e-3 * *young, 1e-3 * pressure, 100.0 * strain)),
         remedy});
  else if (*young < kSoftGround)
    remarks.push_back({Rank::doubtful, kSoftGround / *young,
                       place.fault(fmt::format("material: E is {:.4g} kPa", 1e-3 * *young)), remedy});
}

/// States that a test brings a cone to.
enum class TestState { compression, extension, plane_strain };

/// Of a stage that loads axis 2 under lateral stresses that stay; nothing of other stages.
std::optional<TestState> state_of(const element::Stage& stage) {
  using element::Constraint;
  if (stage.name == "simple_shear") return TestState::plane_strain;
  const Constraint* axial = nullptr;
  bool lateral_stays = stage.pore >= 0;
  bool third_is_stress = false;
  for (const Constraint& constraint : stage.constraints) {
    const bool is_stress = constraint.kind == Constraint::Kind::stress;
    const bool is_held = constraint.way == Constraint::Way::hold;
    if (!is_held && constraint.amount != 0.0 &&
        (constraint.place == k22 || (is_stress && constraint.place < 0)))
      axial = &constraint;
    if (constraint.place == k11 && is_stress && is_held) lateral_stays = true;
    if (constraint.place == k33 && is_stress) third_is_stress = true;
    if (constraint.place < 0 && is_stress && constraint.amount == 0.0) third_is_stress = true;
  }
  if (axial == nullptr || !lateral_stays) return {};
  if (!third_is_stress) return TestState::plane_strain;
  // A deviator counts compression as positive, a component tension.
  const bool is_deviator = axial->place < 0;
  return (axial->amount > 0.0) == is_deviator || axial->way == Constraint::Way::cycle ? TestState::compression
                                                                                      : TestState::extension;
}

const char* name_of(TestState state) {
  switch (state) {
    case TestState::compression:
      return "triaxial compression";
    case TestState::extension:
      return "triaxial extension";
    case TestState::plane_strain:
      break;
  }
  return "plane strain";
}

/// The friction angle of a cone in a state, degrees; nothing where it has no limit there.
std::optional<double> angle_in(const fem::FrozenCone& cone, TestState state) {
  switch (state) {
    case TestState::compression:  // the inverse of M = 6 sin / (3 - sin)
      return arc_sine(3.0 * cone.friction / (6.0 + cone.friction)) * 180.0 / std::numbers::pi;
    case TestState::extension:
      return fem::angle_in_extension(cone);
    case TestState::plane_strain:
      break;
  }
  const auto strength = fem::plane_strain_from_cone(cone);
  return strength ? std::optional(strength->friction_angle) : std::nullopt;
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
    const auto state = state_of(stage);
    if (!state) continue;
    const auto there = angle_in(cone, *state);
    if (there && std::abs(*there - degrees) <= kNearAngle * degrees) continue;
    if (given != nullptr && there && *there < kFarAngle * degrees) continue;
    std::string word = name_of(*state);
    std::ranges::replace(word, ' ', '_');
    remarks.push_back(
        {Rank::doubtful, there ? std::max(degrees / *there, *there / degrees) : 10.0,
         material.find("friction_angle")
             ->fault(
                 fmt::format("material: {:.4g} deg hold {}{}; in {} this cone has {}", degrees,
                             given == nullptr ? "in plane strain, the default here" : "where 'match' says: ",
                             given == nullptr ? "" : given->text, name_of(*state),
                             there ? fmt::format("{:.4g} deg", *there) : std::string("no limit"))),
         given == nullptr ? fmt::format("match: {}; or say 'match: plane_strain' if it is meant", word)
                          : fmt::format("match: {}", word)});
    return;
  }
}

/// The bound is that of `check` (kinds/laws.cpp).
void look_at_cohesion(const Entry& material, double pressure, Remarks& remarks) {
  constexpr double kMostCohesion = 10.0;  // of the pressure
  const auto cohesion = number_of(material, "cohesion", Dimension::pressure);
  if (!cohesion || *cohesion <= kMostCohesion * pressure) return;
  remarks.push_back(
      {Rank::doubtful, *cohesion / pressure / kMostCohesion,
       material.find("cohesion")
           ->fault(fmt::format("material: a cohesion of {:.4g} kPa, and the pressure is {:.4g} kPa",
                               1e-3 * *cohesion, 1e-3 * pressure)),
       "check the unit of the cohesion and of the pressure"});
}

}  // namespace

Remarks remarks_on_element(const Entry& document, std::span<const ElementSpecification> specifications) {
  Remarks remarks;
  const ElementSpecification& first = specifications.front();
  look_at_packings(document, first, remarks);
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
