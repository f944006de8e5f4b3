// SPDX-License-Identifier: GPL-2.0-or-later
// The boxes of grains: how many grains, how large the box, how soft the contacts, and what the grains weigh.
#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "app/remarks/few_grains.hpp"
#include "app/remarks/kinds.hpp"
#include "app/remarks/lengths.hpp"

namespace polargrain::app {
namespace {

constexpr int kFewGrains = 50;
constexpr double kNarrowBox = 3.0;  // largest grains
constexpr double kSoft = 0.02;      // mean overlap over the smaller radius
constexpr double kHard = 1e-8;
constexpr double kLightGrain = 100.0;  // kg/m^3
constexpr double kHeavyGrain = 25e3;   // kg/m^3, heavier than any element
constexpr double kLargeGrain = 0.5;    // m, mean diameter
constexpr double kSmallBody = 5.0;     // mean diameters
constexpr double kSmallElement = 0.2;  // mean diameters

/// The smallest distance between two opposite sides of the box, m.
double width_of_box(const Packing& packing) {
  const double area = packing.box.determinant();
  const double plane = area / std::max(packing.box.col(0).norm(), packing.box.col(1).norm());
  return packing.dimension == 3 ? std::min(plane, packing.thickness) : plane;
}

/// The least and the largest density of the grains, kg/m^3. In a plane packing they may be discs as high as the box, or spheres: only
/// their mass says so.
std::pair<double, double> densities_of(const Packing& packing) {
  double spheres = 0.0;
  for (const Grain& grain : packing.grains)
    spheres += 4.0 / 3.0 * std::numbers::pi * grain.radius * grain.radius * grain.radius;
  const double mass = packing.grain_mass();
  return {mass / std::max(packing.grain_volume(), spheres), mass / std::min(packing.grain_volume(), spheres)};
}

double largest_diameter(const Packing& packing) {
  double largest = 0.0;
  for (const Grain& grain : packing.grains) largest = std::max(largest, 2.0 * grain.radius);
  return largest;
}

}  // namespace

std::optional<Remark> remark_on_grains(const Packing& packing, const coupler::Entry& place,
                                       const std::string& whose, int least) {
  const auto count = static_cast<double>(packing.grains.size());
  if (const double ratio = width_of_box(packing) / largest_diameter(packing); ratio < kNarrowBox)
    return Remark{
        Rank::wrong, kNarrowBox / ratio,
        place.fault(fmt::format(
            "{}: the box of grains is {:.2g} of its largest grains wide (at least {:g}): a grain meets its own image, and "
            "the box has a strength of its own",
            whose, ratio, kNarrowBox)),
        "make the packing of more grains: 100 and more discs, 300 and more spheres"};
  if (count < least)
    return Remark{
        Rank::doubtful, least / count,
        place.fault(fmt::format(
            "{}: a box has {} grains; the stress of so few scatters by some {:.0f} % from box to box", whose,
            packing.grains.size(), 100.0 / std::sqrt(count))),
        "make the packing of 100 grains or more (grains: of its specification)"};
  return {};
}

void few_grains(const Scene& scene, Remarks& remarks) {
  for (const SceneRegion& region : scene.regions()) {
    if (region.cell == nullptr) continue;
    const Packing& packing = region.cell->packing;
    const coupler::Entry& place = scene.place({"materials", region.material, "packing"});
    if (auto remark =
            remark_on_grains(packing, place, fmt::format("material '{}'", region.material), kFewGrains))
      remarks.push_back(std::move(*remark));
  }
}

void softness(const Scene& scene, Remarks& remarks) {
  for (const SceneRegion& region : scene.regions()) {
    if (region.packing == nullptr || region.packing->mean_overlap <= 0.0) continue;
    const double overlap = region.packing->mean_overlap;
    if (overlap > kSoft)
      remarks.push_back(
          {Rank::doubtful, overlap / kSoft,
           scene.place({"materials", region.material, "script"})
               .fault(fmt::format(
                   "material '{}': grains at rest overlap by {:.2g} % of their radius on average (sand: below 0.1 %, usual "
                   "in such models: below 1 %): strength and volume are of soft grains",
                   region.material, 100.0 * overlap)),
           "raise the stiffness of the contacts in the script (check its unit: Pa), and make the packing again"});
    else if (overlap < kHard)
      remarks.push_back(
          {Rank::costly, std::sqrt(kHard / overlap),
           scene.place({"materials", region.material, "script"})
               .fault(fmt::format(
                   "material '{}': grains at rest overlap by {:.1e} of their radius; time steps shrink with the root of "
                   "that, and results no longer change",
                   region.material, overlap)),
           "lower the stiffness of the contacts in the script (check its unit: Pa)"});
  }
}

void size_of_grains(const Scene& scene, Remarks& remarks) {
  for (const SceneRegion& region : scene.regions()) {
    if (region.cell == nullptr) continue;
    const Packing& packing = region.cell->packing;
    const double diameter = 2.0 * packing.mean_radius();
    const coupler::Entry& place = scene.place({"materials", region.material, "packing"});
    if (diameter > kLargeGrain)
      remarks.push_back({Rank::doubtful, diameter / kLargeGrain,
                         place.fault(fmt::format("material '{}': the mean diameter of the grains is {:.3g} m",
                                                 region.material, diameter)),
                         "check the unit of the sizes: without one they are in m"});
    const double body = smaller_whole_side(scene);
    const double ratio = body / diameter;
    if (ratio < kSmallBody)
      remarks.push_back(
          {Rank::doubtful, kSmallBody / ratio,
           place.fault(fmt::format(
               "material '{}': the body is {:.3g} mean diameters wide ({:.3g} mm of {:.3g} mm): too few grains to "
               "be a continuum",
               region.material, ratio, 1e3 * body, 1e3 * diameter)),
           "check the units of the mesh and of the grains"});
    else if (const double element = usual_element(scene, region) / diameter; element < kSmallElement)
      remarks.push_back(
          {Rank::doubtful, kSmallElement / element,
           place.fault(fmt::format(
               "material '{}': the elements of region '{}' measure {:.2g} mean diameters ({:.3g} mm of {:.3g} mm): a "
               "grain is larger than the elements whose stress its box gives",
               region.material, region.name, element, 1e3 * element * diameter, 1e3 * diameter)),
           "fewer elements, or smaller grains; check the units of the mesh and of the grains"});
    const auto [least, largest] = densities_of(packing);
    if (largest < kLightGrain || least > kHeavyGrain)
      remarks.push_back(
          {Rank::doubtful, std::max(kLightGrain / largest, least / kHeavyGrain),
           place.fault(fmt::format("material '{}': the grains weigh {:.3g} kg/m3", region.material,
                                   largest < kLightGrain ? largest : least)),
           "give the density of the specification in kg/m3 (quartz 2650), and make the packing again"});
  }
}

}  // namespace polargrain::app
