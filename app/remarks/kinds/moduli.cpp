// SPDX-License-Identifier: GPL-2.0-or-later
// Moduli that are given against those that they belong to: G and Gc of cells, Gc of laws.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/remarks/kinds.hpp"

namespace polargrain::app {
namespace {

constexpr double kFarModulus = 100.0;  // a slip from MPa to kPa or GPa is a thousand

void look_at(const Scene& scene, const SceneRegion& region, const char* key, double other,
             const std::string& of, Remarks& remarks) {
  const auto value = scene.quantity({"materials", region.material, key}, coupler::Dimension::pressure);
  if (!value || *value <= 0.0 || !(other > 0.0)) return;
  const double off = std::max(*value / other, other / *value);
  if (off <= kFarModulus) return;
  remarks.push_back(
      {Rank::doubtful, off / kFarModulus,
       scene.place({"materials", region.material, key})
           .fault(fmt::format("material '{}': {} is {:.4g} MPa, {:.3g} times {} ({:.4g} MPa)",
                              region.material, key, 1e-6 * *value, *value / other, of, 1e-6 * other)),
       "check its unit; Gc is of the order of G"});
}

}  // namespace

void moduli(const Scene& scene, Remarks& remarks) {
  for (const SceneRegion& region : scene.regions()) {
    if (region.cell != nullptr) {
      if (region.packing == nullptr) continue;
      const double shear = region.packing->moduli.shear;
      look_at(scene, region, "G", shear, "the modulus of the packing at rest", remarks);
      look_at(scene, region, "Gc", shear, "the shear modulus of the packing at rest", remarks);
      continue;
    }
    if (scene.is_classical()) continue;
    const auto young = scene.quantity({"materials", region.material, "E"}, coupler::Dimension::pressure);
    const auto poisson = scene.quantity({"materials", region.material, "nu"}, coupler::Dimension::number);
    if (young && poisson && *poisson > -1.0)
      look_at(scene, region, "Gc", *young / (2.0 * (1.0 + *poisson)), "the shear modulus of E and nu",
              remarks);
  }
}

}  // namespace polargrain::app
