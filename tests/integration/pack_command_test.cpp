// SPDX-License-Identifier: GPL-2.0-or-later
// polargrain pack from the specification to the engine's own answer for the exported packing.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "tests/integration/command.hpp"

namespace polargrain::testing {
namespace {

const std::string kProgram = POLARGRAIN;
const std::string kEngine = POLARGRAIN_LIGGGHTS;

TEST(PackCommand, ExportsSpheresThatTheEngineFindsUnderTheirPressure) {
  const Scratch scratch("pack");
  write(scratch.path() / "spheres.yaml",
        "grains: 60\nsizes: {law: uniform, radius: [3 mm, 5 mm]}\ndensity: 2650\ndimension: 3\n"
        "script: cells/spheres_hooke_radii.in\npressure: 100 kPa\nfriction: 0\nseed: 5\n");
  const Outcome made = run_in(scratch.path(), kProgram + " pack spheres.yaml -o spheres.h5");
  ASSERT_EQ(made.status, 0) << made.errors;
  EXPECT_NE(made.out.find("60 grains in "), std::string::npos) << made.out;
  EXPECT_FALSE(std::filesystem::exists(scratch.path() / "spheres.h5.log"));
  const Outcome exported = run_in(scratch.path(), kProgram + " pack spheres.h5 --export spheres.data");
  ASSERT_EQ(exported.status, 0) << exported.errors;
  // The engine's own virial over its own volume, none of our averages.
  write(scratch.path() / "look.in",
        "include " + std::filesystem::current_path().string() +
            "/liggghts_inputs/cells/spheres_hooke_radii.in\n"
            "compute s all stress/atom pair\ncompute sum all reduce sum c_s[1] c_s[2] c_s[3]\nthermo_style "
            "custom step vol c_sum[1] c_sum[2] c_sum[3]\n"
            "thermo_modify norm no format float %.10g\nrun 0\n");
  const Outcome looked = run_in(scratch.path(), kEngine + " -in look.in -var packing spheres.data -log none");
  ASSERT_EQ(looked.status, 0) << looked.out;
  std::istringstream lines(looked.out);
  bool found = false;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    double step = 1.0;
    double volume = 0.0;
    double xx = 0.0;
    double yy = 0.0;
    double zz = 0.0;
    if (!(words >> step >> volume >> xx >> yy >> zz) || step != 0.0) continue;
    found = true;
    for (const double virial : {xx, yy, zz}) EXPECT_NEAR(-virial / volume / 1e5, 1.0, 1.5e-3);
  }
  EXPECT_TRUE(found) << looked.out;
}

TEST(PackCommand, ACellRefusesSpheresInSpace) {
  const Scratch scratch("pack_refused");
  write(scratch.path() / "spheres.yaml",
        "grains: 8\nsizes: {law: uniform, radius: [4 mm, 5 mm]}\ndensity: 2650\ndimension: "
        "3\nunbalanced_force_ratio: "
        "0.1\npressure_tolerance: 0.1\nscript: cells/spheres_hooke_radii.in\npressure: 100 kPa\nfriction: "
        "0\nseed: 5\n");
  ASSERT_EQ(run_in(scratch.path(), kProgram + " pack spheres.yaml -o spheres.h5").status, 0);
  const Outcome checked =
      run_in(scratch.path(), kProgram + " check " + std::filesystem::current_path().string() +
                                 "/cases/biaxial/case.yaml --set materials.sand.packing=" +
                                 (scratch.path() / "spheres.h5").string());
  EXPECT_EQ(checked.status, 2);
  EXPECT_NE(checked.errors.find("holds spheres in space; cells are plane"), std::string::npos)
      << checked.errors;
}

}  // namespace
}  // namespace polargrain::testing
