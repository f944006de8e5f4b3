// SPDX-License-Identifier: GPL-2.0-or-later
// Runs in real time with one thing wrong each, and odd ones that are right.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "tests/support/careless_features.hpp"

namespace polargrain::testing {
namespace {

using app::Rank;

const std::string kColumn = R"(title: A column shaken at its base
continuum: cauchy
mesh: {rectangle: {size: [1 m, 10 m], elements: [1, 20]}}
materials:
  soil: {model: elastic, E: 40 MPa, nu: 0.3, density: 2000 kg/m3}
regions: {all: soil}
boundary:
  - {on: bottom, fix: [u1, u2]}
  - {on: top, traction: {u1: [[0, 10 kPa], [0.1, 10 kPa], [0.11, 0]]}}
  - {on: [left, right], fix: [u2]}
  - {on: left, tie: right}
steps: {method: explicit, time: real, duration: 2 s, count: 200, mass_damping: 3}
monitors:
  top: {on: top, displacement: u1}
output: {every: 50, table: [top]}
)";

INSTANTIATE_TEST_SUITE_P(RealTime, CarelessFeatures,
                         ::testing::Values(Careless{"DensityInTons", kColumn, "density: 2000 kg/m3",
                                                    "density: 2.0", "a density of 2 kg/m3"}),
                         [](const auto& info) { return info.param.name; });

INSTANTIATE_TEST_SUITE_P(RealTime, OddFeatures, ::testing::Values(Careless{"FreeVibration", kColumn, "", ""}),
                         [](const auto& info) { return info.param.name; });

/// On 2 s of the column on a base that moves after quake.csv.
app::Remarks remarks_on_motion_of(const Scratch& scratch) {
  write(scratch.path() / "case.yaml",
        replaced(replaced(kColumn, "  - {on: bottom, fix: [u1, u2]}\n",
                          "  - {on: bottom, fix: [u2], accelerate: {u1: quake.csv}}\n"),
                 "  - {on: top, traction: {u1: [[0, 10 kPa], [0.1, 10 kPa], [0.11, 0]]}}\n", ""));
  return app::remarks_on(coupler::read_case(scratch.path() / "case.yaml"), std::vector<std::string>{}, {});
}

/// A motion of `rows` rows 0.01 s apart, of this amplitude in m/s2. @returns the remarks on 2 s of it
app::Remarks remarks_on_motion(int rows, double amplitude) {
  const Scratch scratch("careless_motion");
  std::string table = "time,acceleration\n";
  for (int row = 0; row < rows; ++row)
    table += fmt::format("{},{}\n", 0.01 * row, amplitude * std::sin(0.12 * row));
  write(scratch.path() / "quake.csv", table);
  return remarks_on_motion_of(scratch);
}

TEST(RealTime, NeedsExplicitSteps) {
  const Scratch scratch("careless_method");
  for (const char* const method : {"", "method: newton, ", "method: automatic, "}) {
    write(scratch.path() / "case.yaml", replaced(kColumn, "method: explicit, ", method));
    try {
      (void)coupler::read_case(scratch.path() / "case.yaml");
      ADD_FAILURE() << method;
    } catch (const InputError& error) {
      EXPECT_EQ(error.faults().front().line, 12);
      EXPECT_EQ(error.faults().front().message,
                "steps: time: real time has explicit steps alone; write 'method: explicit'");
    }
  }
}

/// A column between a base that moves and a top that stands has no base to damp it against.
TEST(RealTime, DampsAgainstOneBase) {
  const Scratch scratch("careless_base");
  write(scratch.path() / "quake.csv", "time,acceleration\n0,0\n1,1\n2,0\n");
  const std::string shaken =
      replaced(replaced(kColumn, "{on: bottom, fix: [u1, u2]}",
                        "{on: bottom, fix: [u2], accelerate: {u1: quake.csv}}"),
               "{on: top, traction: {u1: [[0, 10 kPa], [0.1, 10 kPa], [0.11, 0]]}}", "{on: top, fix: [u1]}");
  write(scratch.path() / "case.yaml", shaken);
  try {
    (void)coupler::read_case(scratch.path() / "case.yaml");
    ADD_FAILURE() << "a base with two motions";
  } catch (const InputError& error) {
    ASSERT_EQ(error.faults().size(), 1U);
    EXPECT_EQ(error.faults().front().line, 12);
    EXPECT_EQ(
        error.faults().front().message,
        "steps: mass_damping: it damps the motion relative to the base, and along u1 'bottom' and 'top' move "
        "differently; accelerate both alike, or leave mass_damping out");
  }
  write(scratch.path() / "case.yaml", replaced(shaken, ", mass_damping: 3", ""));
  EXPECT_NO_THROW((void)coupler::read_case(scratch.path() / "case.yaml"));
  write(scratch.path() / "case.yaml",
        replaced(shaken, "{on: top, fix: [u1]}", "{on: top, accelerate: {u1: quake.csv}}"));
  EXPECT_NO_THROW((void)coupler::read_case(scratch.path() / "case.yaml"));
}

TEST(QuietBoundary, MovesThoughItIsFixedAtTheStart) {
  const Scratch scratch("careless_quiet");
  write(scratch.path() / "case.yaml",
        replaced(replaced(kColumn, "{on: bottom, fix: [u1, u2]}", "{on: bottom, fix: [u1, u2], quiet: true}"),
                 "monitors:\n", "monitors:\n  base: {on: bottom, displacement: u1}\n"));
  const app::Remarks remarks =
      app::remarks_on(coupler::read_case(scratch.path() / "case.yaml"), std::vector<std::string>{}, {});
  EXPECT_TRUE(remarks.empty()) << app::text_of(remarks, true);
}

TEST(Motions, ThatGoOnBehindTheRunAreTold) {
  const app::Remarks remarks = remarks_on_motion(501, 1.0);
  EXPECT_TRUE(is_told_of_features(remarks, "the motion of 'quake.csv' lasts 5 s, and the run ends at 2 s",
                                  Rank::wrong))
      << app::text_of(remarks, true);
}

TEST(Motions, InCentimetresAreTold) {
  const app::Remarks remarks = remarks_on_motion(201, 100.0);
  EXPECT_TRUE(is_told_of_features(remarks, "m/s2, 10 times gravity", Rank::wrong))
      << app::text_of(remarks, true);
}

/// Every second row has another sign: 50 Hz. Shear waves of sqrt(15.4 MPa / 2000 kg/m3) = 87.7 m/s are 1.75 m long then, and
/// elements have 0.707 m.
TEST(Motions, TooFastForTheElementsAreTold) {
  const Scratch scratch("careless_noise");
  std::string table = "time,acceleration\n";
  for (int row = 0; row <= 200; ++row) table += fmt::format("{},{}\n", 0.01 * row, row % 2 == 0 ? 1.0 : -1.0);
  write(scratch.path() / "quake.csv", table);
  const app::Remarks remarks = remarks_on_motion_of(scratch);
  EXPECT_TRUE(is_told_of_features(
      remarks, "has 50 Hz in the mean, whose shear wave is 1.75 m long in region 'all': 2.5 elements",
      Rank::doubtful))
      << app::text_of(remarks, true);
}

/// Swings of 1 m/s2 and 1 Hz reach 0.32 m/s; an offset of 0.5 m/s2 carries the base to 1 m/s.
TEST(Motions, WithAnOffsetAreTold) {
  const Scratch scratch("careless_offset");
  std::string table = "time,acceleration\n";
  for (int row = 0; row <= 200; ++row)
    table += fmt::format("{},{}\n", 0.01 * row, 0.5 + std::sin(2.0 * std::numbers::pi * 0.01 * row));
  write(scratch.path() / "quake.csv", table);
  const app::Remarks remarks = remarks_on_motion_of(scratch);
  EXPECT_TRUE(
      is_told_of_features(remarks, "ends with 1e+03 mm/s and its swings reach 318 mm/s", Rank::doubtful))
      << app::text_of(remarks, true);
}

TEST(Motions, AsLongAsTheRunAreRight) {
  const app::Remarks remarks = remarks_on_motion(201, 1.0);
  EXPECT_TRUE(remarks.empty()) << app::text_of(remarks, true);
}

}  // namespace
}  // namespace polargrain::testing
