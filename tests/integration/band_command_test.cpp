// SPDX-License-Identifier: GPL-2.0-or-later
// polargrain band on result directories whose band is known: grain dumps and the fields of a run.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <numbers>

#include "band/frames.hpp"
#include "tests/integration/command.hpp"

namespace {

using namespace polargrain::testing;

constexpr double kSpacing = 0.01;
constexpr double kInclination = 55.0 * std::numbers::pi / 180.0;

/// A dump of 20 x 40 grains that have slid along a band by `slide` (m) and turned in it.
std::string dump(double slide) {
  std::string text =
      "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n800\nITEM: BOX BOUNDS ff ff ff\n0 1\n0 1\n0 1\n"
      "ITEM: ATOMS id x y radius f_turned \n";
  for (int k = 799; k >= 0; --k) {  // in no order of their own
    const double x = kSpacing * (k % 20 + 0.5 + 0.3 * std::sin(7.0 * k));
    const double y = kSpacing * (k / 20 + 0.5 + 0.3 * std::cos(11.0 * k));
    const double s = -std::sin(kInclination) * (x - 0.1) + std::cos(kInclination) * (y - 0.2);
    const double u = 0.5 * slide * std::erf(s / 0.02);
    text += fmt::format("{} {:.10g} {:.10g} 0.005 {:.10g} \n", k + 1, x + u * std::cos(kInclination),
                        y + u * std::sin(kInclination), std::abs(s) < 0.02 ? 10.0 * slide : 0.0);
  }
  return text;
}

void write_grains(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder / "grains");
  std::string history = "step,axial_strain\n";
  for (int frame = 0; frame <= 6; ++frame) {
    // Nothing slides before frame 2.
    write(folder / fmt::format("grains/step-{:07}.dump", 100 * frame), dump(0.004 * std::max(0, frame - 2)));
    if (frame > 0) history += fmt::format("{},{}\n", 100 * frame, 0.01 * frame);
  }
  write(folder / "history.csv", history);
}

TEST(BandCommand, MeasuresGrains) {
  const Scratch scratch("band_grains");
  write_grains(scratch.path() / "run");
  const Outcome outcome = run_in(
      scratch.path(), std::string(POLARGRAIN) + " band run --from 0.03 --window 0.01 --fields samples.csv");
  ASSERT_EQ(outcome.status, 0) << outcome.errors;
  std::cout << outcome.out;
  const std::string json = content(scratch.path() / "run/band.json");
  const auto value = [&](const std::string& key) {
    return std::stod(json.substr(json.find("\"" + key + "\": ") + key.size() + 4));
  };
  // Shear of a slide u erf(s / a): Gaussian of deviation a / sqrt 2, half width 1.665 a = 33.3 mm; smoothed
  // by the neighbourhood (25 mm radius: 18.6 mm) and by the profile (11.8 mm): 39.9 mm.
  // The grains sample the band at a spacing: a tenth of it over half the band's length of 0.1 m is 0.6
  // degrees.
  EXPECT_NEAR(value("inclination_degrees"), 55.0, 0.6);
  EXPECT_NEAR(value("thickness"), 0.0399, 0.03 * 0.0399);
  EXPECT_NEAR(value("rotation_outside"), 0.0, 1e-12);
  EXPECT_NEAR(value("rotation_inside"), 0.12, 0.002);
  // Nothing deforms until 0.02; the next increment is all band. Between the middles of the two, 0.015 and
  // 0.025, the localisation crosses 2 close to the first.
  EXPECT_NEAR(value("onset_strain"), 0.0155, 5e-4);
  const std::string samples = content(scratch.path() / "samples.csv");
  EXPECT_EQ(std::count(samples.begin(), samples.end(), '\n'), 801);
}

TEST(BandCommand, ReadsTheFieldsOfARun) {
  const Scratch scratch("band_fields");
  write(scratch.path() / "case.yaml", R"(title: elastic
mesh: {rectangle: {size: [0.2 m, 0.4 m], elements: [4, 8]}}
materials: {rock: {model: elastic, E: 1 GPa, nu: 0.25, Gc: 0.1 GPa, lc: 1 mm}}
regions: {all: rock}
boundary:
  - {on: bottom, fix: [u2]}
  - {on: bottom_left, fix: [u1]}
  - {on: top, move: {u2: -4 mm}}
steps: {count: 4}
monitors:
  shortening: {on: top, displacement: u2}
  axial_strain: -shortening / 0.4 m
output: {every: 1}
)");
  ASSERT_EQ(run_in(scratch.path(), std::string(POLARGRAIN) + " run case.yaml -o run --quiet").status, 0);
  const polargrain::band::Frames frames(scratch.path() / "run", "axial_strain");
  ASSERT_EQ(frames.axial_strains().size(), 5U);
  const auto samples = frames.increment(1, 4, false);
  ASSERT_EQ(samples.size(), 128U);
  // Plane strain: e22 = -0.0075 in three quarters of the path, e11 = -nu / (1 - nu) e22.
  for (const auto& sample : samples) {
    EXPECT_NEAR(sample.shear, 0.0075 * 4.0 / 3.0, 1e-12);
    EXPECT_NEAR(sample.volume_strain, -0.0075 * 2.0 / 3.0, 1e-12);
    EXPECT_NEAR(sample.area, 0.0025 / 4.0, 1e-12);
    EXPECT_NEAR(sample.rotation, 0.0, 1e-12);
  }
  const Outcome outcome = run_in(scratch.path(), std::string(POLARGRAIN) + " band run");
  EXPECT_EQ(outcome.status, 0) << outcome.errors;
  EXPECT_NE(outcome.out.find("no band"), std::string::npos) << outcome.out;
  EXPECT_NE(content(scratch.path() / "run/band.json").find("\"found\": false"), std::string::npos);
}

TEST(BandCommand, NamesWhatIsWrong) {
  const Scratch scratch("band_bad");
  const auto errors = [&](const std::string& arguments) {
    const Outcome outcome = run_in(scratch.path(), std::string(POLARGRAIN) + " band " + arguments);
    EXPECT_EQ(outcome.status, 2) << arguments;
    return outcome.errors;
  };
  EXPECT_NE(errors("nowhere").find("at least two frames"), std::string::npos);
  write_grains(scratch.path() / "run");
  EXPECT_NE(errors("run --strain nothing").find("there is no column 'nothing'"), std::string::npos);
  EXPECT_NE(errors("run --from 0.05 --to 0.05").find("one frame"), std::string::npos);
  write(scratch.path() / "run/grains/step-0000600.dump", "ITEM: ATOMS id x y f_turned\n1 2 x 4\n");
  EXPECT_NE(errors("run").find("step-0000600.dump:2: 'x' is no number"), std::string::npos) << errors("run");
  write(scratch.path() / "run/history.csv", "step,axial_strain\n100,0.01\n");
  EXPECT_NE(errors("run").find("there is no row of step 200"), std::string::npos);
}

}  // namespace
