// SPDX-License-Identifier: GPL-2.0-or-later
// The internal length lc against elements, grains and body.
#include <fmt/format.h>

#include <algorithm>

#include "app/remarks/in_units.hpp"
#include "app/remarks/kinds.hpp"
#include "app/remarks/lengths.hpp"
#include "fem/mesh/gmsh.hpp"

namespace polargrain::app {
namespace {

void against_elements(const Scene& scene, const SceneRegion& region, double length, Remarks& remarks) {
  const double element = usual_element(scene, region);
  const double ratio = element / length;
  constexpr double kRounding = 1.02;  // of a length written with two digits
  // A single element has one strain throughout; where nothing softens a mesh sets no band.
  if (region.elements.size() == 1 || !softens(scene, region)) return;
  if (ratio <= kRounding * kMostElementOverLength) return;
  remarks.push_back(
      {Rank::doubtful, ratio / kMostElementOverLength,
       scene.place({"materials", region.material, "lc"})
           .fault(fmt::format(
               "material '{}': the elements of region '{}' measure {:.3g} mm, {:.3g} times lc (at most {:g}): "
               "bands of shear are as wide as the elements, and the curve behind a peak depends on the mesh",
               region.material, region.name, 1e3 * element, ratio, kMostElementOverLength)),
       fmt::format("elements of {:.4g} mm where bands are expected, or 'lc: {:.3g} mm' and more",
                   1e3 * kMostElementOverLength * length, 1e3 * element / kMostElementOverLength)});
}

/// Where no bands are looked for: a mesh in millimetres that is read in metres, or a wrong unit of lc.
void far_below_elements(const Scene& scene, const SceneRegion& region, double length, Remarks& remarks) {
  constexpr double kMost = 1e4;  // elements of 1 m have some 1,000 lengths of a sand
  const double element = usual_element(scene, region);
  const double ratio = element / length;
  if (region.elements.size() == 1 || ratio <= kMost) return;
  if (is_strong(scene, region) && softens(scene, region)) return;
  remarks.push_back(
      {Rank::doubtful, ratio / kMost,
       scene.place({"materials", region.material, "lc"})
           .fault(fmt::format("material '{}': the elements of region '{}' measure {}, {:.0f} times lc (at "
                              "most {:.0f}): lc has no effect",
                              region.material, region.name, metres(element), ratio, kMost)),
       "a mesh file is read in metres: one in millimetres needs Mesh.ScalingFactor = 0.001; check the "
       "unit of lc"});
}

void against_body(const Scene& scene, const SceneRegion& region, double length, Remarks& remarks) {
  const double body = smaller_whole_side(scene);
  const double share = length / body;
  if (share <= kMostLengthOverBody) return;
  remarks.push_back(
      {share > 1.0 ? Rank::wrong : Rank::doubtful, share / kMostLengthOverBody,
       scene.place({"materials", region.material, "lc"})
           .fault(fmt::format(
               "material '{}': lc is {:.3g} mm, {:.3g} times the smaller side of the body ({:.3g} mm): couple "
               "stresses stiffen all of it, and no band of shear has room",
               region.material, 1e3 * length, share, 1e3 * body)),
       "give lc a few tenths to a few times the mean diameter of the grains; check its unit"});
}

void against_grains(const Scene& scene, const SceneRegion& region, double length, Remarks& remarks) {
  if (region.cell == nullptr) return;
  const double diameter = 2.0 * region.cell->packing.mean_radius();
  const double ratio = length / diameter;
  if (ratio >= kLeastLengthOverGrain && ratio <= kMostLengthOverGrain) return;
  remarks.push_back(
      {Rank::doubtful, ratio > 1.0 ? ratio / kMostLengthOverGrain : kLeastLengthOverGrain / ratio,
       scene.place({"materials", region.material, "lc"})
           .fault(
               fmt::format("material '{}': lc is {:.3g} mm, {:.3g} mean diameters of the grains ({:.3g} mm)",
                           region.material, 1e3 * length, ratio, 1e3 * diameter)),
       fmt::format(
           "measured are 0.3 to 1 diameters; more, up to {:g}, is for meshes that cannot resolve a band; check its unit",
           kMostLengthOverGrain)});
}

/// Grains that carry the couple stresses themselves have a length of their own, about their mean diameter.
void controlled_rotations(const Scene& scene, const SceneRegion& region, Remarks& remarks) {
  constexpr double kMostElementOverGrain = 5.0;
  constexpr std::size_t kFewElements = 16;  // in so few no band is looked for
  if (region.cell == nullptr || region.cell->control.rotations != CellRotations::controlled) return;
  const double element = usual_element(scene, region);
  const double ratio = element / (2.0 * region.cell->packing.mean_radius());
  if (ratio <= kMostElementOverGrain || region.elements.size() <= kFewElements) return;
  remarks.push_back(
      {Rank::doubtful, ratio / kMostElementOverGrain,
       scene.place({"materials", region.material, "rotations"})
           .fault(fmt::format(
               "material '{}': with controlled rotations bands are some grains wide, and the elements of region '{}' measure "
               "{:.3g} mm, {:.3g} mean diameters (at most {:g})",
               region.material, region.name, 1e3 * element, ratio, kMostElementOverGrain)),
       "smaller elements where bands are expected, or 'rotations: free' with an lc that the mesh resolves"});
}

/// Columns of discs and spheres in explicit steps flew apart with elements Q8R, and did not with Q4R (docs/theory/spread.md): within an
/// element nothing spreads.
void points_that_part(const Scene& scene, Remarks& remarks) {
  if (!scene.the_case().is_explicit()) return;
  scene.with_problem([&]<int dim>(const fem::Problem<dim>& problem) {
    for (const SceneRegion& region : scene.regions()) {
      if (region.cell == nullptr || region.elements.empty()) continue;
      const auto first = static_cast<std::size_t>(region.elements.front());
      const fem::ElementType<dim>& type = *problem.mesh.elements[first].type;
      if (type.quadrature.size() == 1) continue;
      remarks.push_back(
          {Rank::doubtful, 1.0,
           scene.place({"continuum", "spread"})
               .fault(fmt::format(
                   "continuum: region '{}' spreads its slips in explicit steps with elements {} of {} points: slips "
                   "of an element are alike, and its boxes can part from each other until nodes fly",
                   region.name, type.name, type.quadrature.size())),
           fmt::format("'element: {}' in the mesh", fem::kOnePoint<dim>)});
    }
  });
}

/// Slips that are spread: bands have the width that is given only where elements and body leave room for it.
void spread_of_slips(const Scene& scene, Remarks& remarks) {
  const double spread = scene.the_case().spread;
  if (spread <= 0.0) return;
  const coupler::Entry& place = scene.place({"continuum", "spread"});
  const double body = std::ranges::max(whole_sides(scene));  // a column may be one element wide
  if (spread > kMostSpreadOverBody * body)
    remarks.push_back(
        {spread > body ? Rank::wrong : Rank::doubtful, spread / (kMostSpreadOverBody * body),
         place.fault(fmt::format(
             "continuum: spread is {:.3g} mm, {:.3g} times the larger side of the body ({:.3g} mm; "
             "at most {:g}): slips are alike all over it, and no band has room",
             1e3 * spread, spread / body, 1e3 * body, kMostSpreadOverBody)),
         "give the width that bands of the sand have, some ten mean diameters of its grains; check its unit"});
  points_that_part(scene, remarks);
  for (const SceneRegion& region : scene.regions()) {
    const double element = usual_element(scene, region);
    const double ratio = element / spread;
    constexpr double kRounding = 1.02;  // of a spread written with two digits
    if (region.elements.size() == 1 || !softens(scene, region)) continue;
    if (ratio <= kRounding * kMostElementOverSpread) continue;
    remarks.push_back(
        {Rank::doubtful, ratio / kMostElementOverSpread,
         place.fault(fmt::format(
             "continuum: the elements of region '{}' measure {:.3g} mm, {:.3g} times the spread (at most {:g}): bands of "
             "slip are as wide as the elements, and the curve behind a peak depends on the mesh",
             region.name, 1e3 * element, ratio, kMostElementOverSpread)),
         fmt::format("elements of {:.4g} mm where bands are expected, or 'spread: {:.3g} mm' and more",
                     1e3 * kMostElementOverSpread * spread, 1e3 * element / kMostElementOverSpread)});
  }
}

}  // namespace

void internal_length(const Scene& scene, Remarks& remarks) {
  spread_of_slips(scene, remarks);
  if (scene.is_classical()) return;
  const bool slips_set_bands = scene.the_case().spread > 0.0;
  for (const SceneRegion& region : scene.regions()) {
    if (!slips_set_bands) controlled_rotations(scene, region, remarks);
    const auto length = scene.quantity({"materials", region.material, "lc"}, coupler::Dimension::length);
    if (!length || *length <= 0.0) continue;
    if (is_strong(scene, region) && !slips_set_bands) against_elements(scene, region, *length, remarks);
    far_below_elements(scene, region, *length, remarks);
    against_body(scene, region, *length, remarks);
    against_grains(scene, region, *length, remarks);
  }
}

void plastic_length(const Scene& scene, Remarks& remarks) {
  for (const SceneRegion& region : scene.regions()) {
    const auto plastic = scene.quantity({"materials", region.material, "lp"}, coupler::Dimension::length);
    const auto length = scene.quantity({"materials", region.material, "lc"}, coupler::Dimension::length);
    if (!plastic || !length || *length <= 0.0) continue;
    const double ratio = *plastic / *length;
    const double body = *plastic / smaller_whole_side(scene);
    if (ratio <= kMostPlasticOverLength && ratio >= 1.0 / kMostPlasticOverLength &&
        body <= kMostLengthOverBody)
      continue;
    remarks.push_back(
        {Rank::doubtful, std::max({1.0, ratio / kMostPlasticOverLength, body / kMostLengthOverBody}),
         scene.place({"materials", region.material, "lp"})
             .fault(fmt::format(
                 "material '{}': lp is {:.3g} mm, {:.3g} times lc and {:.3g} of the smaller side of the body: {}",
                 region.material, 1e3 * *plastic, ratio, body,
                 ratio > 1.0 ? "couple stresses have next to no limit"
                             : "couple stresses have next to no strength")),
         "give lp about a mean diameter of the grains, near lc; check its unit"});
  }
}

}  // namespace polargrain::app
