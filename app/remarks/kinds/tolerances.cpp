// SPDX-License-Identifier: GPL-2.0-or-later
// Keys of accuracy that no longer ask for an answer that can be used.
#include <fmt/format.h>

#include "app/remarks/in_units.hpp"
#include "app/remarks/kinds.hpp"
#include "app/remarks/stress_scale.hpp"

namespace polargrain::app {
namespace {

struct Bound {
  const char* key;
  double largest;
  const char* what;
  const char* remedy;
};

constexpr const char* kOutOfBalance =
    "of the forces may be out of balance at the end of a step, and a monitor is wrong by as much";
constexpr const char* kBalanceOfSteps =
    "1e-2 for cells, 1e-3 and less for laws; where a step fails, its advice says why";
/// Grains answer with noise, laws do not.
constexpr Bound kOfBoxes = {"tolerance", 0.05, kOutOfBalance, kBalanceOfSteps};
constexpr Bound kOfLaws = {"tolerance", 0.02, kOutOfBalance, kBalanceOfSteps};

constexpr Bound kOfSteps[] = {
    {"noise", 10.0, "times the noise of the stresses may be out of balance at the end of a step", "2"},
    {"moment_tolerance", 0.1, "of the moments may be out of balance at the end of a step", "as 'tolerance'"},
    {"jump_residual", 0.2, "of the forces may be out of balance where a jump is passed", "0.05"},
    {"largest_strain", 2.0, "of strain may be asked for in one correction", "0.05 for cells, 1 for laws"}};

constexpr Bound kOfMaterials[] = {
    {"inertial_number", 5e-3,
     "is the rate: grains no longer rest on each other, and the stress rises with the rate",
     "6e-4, at most 2e-3; where a step fails, more steps help, not a higher rate"},
    {"unbalanced_force_ratio", 0.05, "of a contact force may be out of balance at read-out", "5e-3"},
    {"unbalanced_moment_ratio", 0.05, "of a contact force may be out of balance at read-out", "5e-3"},
    {"damping", 0.5, "of the critical damping: grains creep to where they rest", "0.12"}};

constexpr Bound kOfAdaptive = {"tolerance", 0.2, "of the pressure may the stress of a point be off",
                               "1 to 5 %"};

void look_at(const Scene& scene, const Scene::Path& section, const Bound& bound, Remarks& remarks) {
  Scene::Path path = section;
  path.emplace_back(bound.key);
  const auto value = scene.quantity(path, coupler::Dimension::number);
  if (!value || *value <= bound.largest) return;
  const std::string name = section.size() > 1 ? fmt::format("material '{}'", section[1]) : section[0];
  remarks.push_back(
      {*value > 2.0 * bound.largest ? Rank::wrong : Rank::doubtful, *value / bound.largest,
       scene.place(path).fault(fmt::format("{}: {}: {:.3g} {}", name, bound.key, *value, bound.what)),
       bound.remedy});
}

/// A reference pressure states what the tolerance of `adaptive` is a share of: it must be one of this scene.
void look_at_reference(const Scene& scene, const SceneRegion& region, Remarks& remarks) {
  constexpr double kMost = 10.0;    // times the largest stress of the scene
  constexpr double kLeast = 0.001;  // of it
  const Scene::Path path = {"materials", region.material, "adaptive", "reference_pressure"};
  const auto reference = scene.quantity(path, coupler::Dimension::pressure);
  const double stress = std::max(stress_scale(scene), Scene::pressure_of(region));
  if (!reference || stress <= 0.0) return;
  const std::string seen =
      fmt::format("material '{}': reference_pressure is {}, the largest stress of the case {}",
                  region.material, pascals(*reference), pascals(stress));
  const std::string remedy = "give a pressure that the grains have in this case; check its unit";
  if (*reference > kMost * stress)
    remarks.push_back({Rank::wrong, *reference / (kMost * stress),
                       scene.place(path).fault(seen + ": a tolerance that is a share of it allows any error"),
                       remedy});
  else if (*reference < kLeast * stress)
    remarks.push_back({Rank::costly, kLeast * stress / *reference,
                       scene.place(path).fault(seen + ": a tolerance that is a share of it saves nothing"),
                       remedy});
}

}  // namespace

void tolerances(const Scene& scene, Remarks& remarks) {
  look_at(scene, {"steps"}, scene.has_cells() ? kOfBoxes : kOfLaws, remarks);
  for (const Bound& bound : kOfSteps) look_at(scene, {"steps"}, bound, remarks);
  for (const auto& [name, material] : scene.the_case().materials)
    if (material->needs_workers()) {
      for (const Bound& bound : kOfMaterials) look_at(scene, {"materials", name}, bound, remarks);
      look_at(scene, {"materials", name, "adaptive"}, kOfAdaptive, remarks);
    }
  for (const SceneRegion& region : scene.regions())
    if (region.cell != nullptr) look_at_reference(scene, region, remarks);
}

}  // namespace polargrain::app
