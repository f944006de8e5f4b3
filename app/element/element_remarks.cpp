// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/element/element_remarks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

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

/// In triaxial compression, degrees: the inverse of M = 6 sin / (3 - sin).
double angle_in_compression(const fem::FrozenCone& cone) {
  return arc_sine(3.0 * cone.friction / (6.0 + cone.friction)) * 180.0 / std::numbers::pi;
}

/// The strength of the default cone is that of plane strain. The test is another one.
void look_at_cone(const Entry& material, const ElementSpecification& specification, Remarks& remarks) {
  const Entry* const model = material.find("model");
  if (model == nullptr || model->text != "elastoplastic" || material.find("match") != nullptr) return;
  const auto is_triaxial = [](const element::Stage& stage) { return stage.name == "triaxial"; };
  if (std::ranges::none_of(specification.stages, is_triaxial)) return;
  const auto friction = number_of(material, "friction_angle", Dimension::angle);
  if (!friction || !(*friction > 0.0)) return;
  constexpr double kOneRadian = 180.0 / std::numbers::pi;
  const double dilatancy = number_of(material, "dilatancy_angle", Dimension::angle).value_or(0.0);
  const double degrees = kOneRadian * *friction;
  const double there = angle_in_compression(
      fem::matched_cone({degrees, kOneRadian * dilatancy, 0.0}, fem::ConeMatch::plane_strain));
  remarks.push_back(
      {Rank::doubtful, degrees / there,
       material.find("friction_angle")
           ->fault(fmt::format(
               "material: {:.4g} deg hold in plane strain, the default here; in triaxial compression this "
               "cone has {:.4g} deg",
               degrees, there)),
       "match: triaxial_compression; or say 'match: plane_strain' if it is meant"});
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
    look_at_cone(*material, first, remarks);
  }
  std::ranges::stable_sort(remarks, [](const Remark& a, const Remark& b) {
    return a.rank != b.rank ? a.rank < b.rank : a.weight > b.weight;
  });
  return remarks;
}

}  // namespace polargrain::app
