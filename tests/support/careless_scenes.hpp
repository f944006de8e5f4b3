// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <gtest/gtest.h>

#include <string>

#include "app/remarks/remarks.hpp"
#include "tests/integration/command.hpp"

namespace polargrain::testing {

/// Boxes of grains under a compression: right in every number.
inline const std::string kGrains = R"(title: Compression of boxes of grains
mesh:
  rectangle: {size: [0.2 m, 0.4 m], elements: [10, 20]}
continuum: cosserat
materials:
  sand: {model: cell, script: cell.in, packing: grains.h5, lc: 8 mm}
regions: {all: sand}
boundary:
  - {on: bottom, fix: [u1, u2]}
  - {on: top, fix: [u1], move: {u2: -8 mm}}
  - {on: [left, right], pressure: 100 kPa}
steps: {count: 20, tolerance: 1e-2}
monitors:
  top_force: {on: top, reaction: u2}
  shortening: {on: top, displacement: u2}
  axial_strain: -shortening / 0.4 m
  stress_ratio: -top_force / (0.2 m * 100 kPa)
output: {every: 5, table: [axial_strain, stress_ratio]}
)";

/// Level ground of a law in its own stress, then a load: right in every number.
inline const std::string kGround = R"(title: Ground under its weight and a load
mesh:
  rectangle: {size: [10 m, 5 m], elements: [20, 10]}
materials:
  soil: {model: elastoplastic, E: 30 MPa, nu: 0.3, Gc: 12 MPa, lc: 20 cm, friction_angle: 30 deg, dilatancy_angle: 5 deg, cohesion: 10 kPa}
regions: {all: soil}
boundary:
  - {on: bottom, fix: [u1, u2]}
  - {on: [left, right], fix: [u1]}
  - {on: top, pressure: [[0, 10 kPa], [1, 60 kPa]]}
body:
  - {unit_weight: 18 kN/m3}
initial_stress:
  - {surface: 5 m, unit_weight: 18 kN/m3, K0: 0.5, surcharge: 10 kPa}
steps: {count: 10, tolerance: 1e-6}
monitors:
  base_force: {on: bottom, reaction: u2}
  settlement: {on: top, displacement: u2}
  pressure: -base_force / 10 m
)";

/// One change to one of them.
struct Careless {
  std::string name;
  std::string base;
  std::string good;
  std::string bad;
  std::string message = {};  ///< part of the message expected
  app::Rank rank = app::Rank::wrong;
  std::string script_good = {};  ///< a change to the script of the grains
  std::string script_bad = {};
  std::string packing = {};     ///< content of grains.csv; nothing: grains.h5 is packing100.h5
  double mean_overlap = 0.005;  ///< of the grains at rest, over their radius
};

inline void PrintTo(const Careless& scene, std::ostream* out) {
  *out << scene.name;
}

inline std::string replaced(std::string text, const std::string& good, const std::string& bad) {
  if (good.empty()) return text;
  const std::size_t place = text.find(good);
  EXPECT_NE(place, std::string::npos) << good;
  if (place != std::string::npos) text.replace(place, good.size(), bad);
  return text;
}

/// kGrains with slips that are spread.
inline const std::string kSpreadGrains = replaced(
    replaced(kGrains, "continuum: cosserat", "continuum: {kind: cauchy, spread: 50 mm}"), ", lc: 8 mm", "");

/// The engine's findings on packing100 under hooke_radii.in, rounded: no engine is started here.
inline app::PackingAtRest packing_at_rest_of_tests() {
  app::PackingAtRest packing;
  for (const int i : {k11, k22}) packing.stress(i) = -100e3;
  packing.moduli = {16e6, 14e6, 100.0, 0.2};
  packing.mean_overlap = 0.005;
  return packing;
}

inline app::Remarks remarks_of(const Careless& scene) {
  const std::string source = POLARGRAIN_SOURCE_DIRECTORY;
  const Scratch scratch("careless_" + scene.name);
  const std::filesystem::path& at = scratch.path();
  write(at / "case.yaml", replaced(scene.base, scene.good, scene.bad));
  write(at / "cell.in", replaced(content(source + "/liggghts_inputs/cells/hooke_radii.in"), scene.script_good,
                                 scene.script_bad));
  std::filesystem::copy_file(source + "/cases/footing_cells/packing100.h5", at / "grains.h5");
  if (!scene.packing.empty()) write(at / "grains.csv", scene.packing);
  const coupler::Case the_case = coupler::read_case(at / "case.yaml");
  app::PackingsAtRest packings;
  for (const auto& [name, material] : the_case.materials)
    if (material->needs_workers()) {
      packings[name] = packing_at_rest_of_tests();
      packings[name].mean_overlap = scene.mean_overlap;
    }
  return app::remarks_on(the_case, std::vector<std::string>{}, packings);
}

}  // namespace polargrain::testing
