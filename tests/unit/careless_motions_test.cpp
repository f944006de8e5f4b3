// SPDX-License-Identifier: GPL-2.0-or-later
// Runs in real time with one thing wrong each, and odd ones that are right.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/remarks/shortest_pulse.hpp"
#include "app/remarks/sizes.hpp"
#include "coupler/case/document_kind.hpp"
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

/// The same at rest in its weight.
const std::string kHeavyColumn =
    replaced(kColumn, "  - {on: [left, right], fix: [u2]}\n  - {on: left, tie: right}\n",
             "  - {on: left, tie: right}\n"
             "body: [{unit_weight: 20 kN/m3}]\n"
             "initial_stress: [{surface: 10 m, unit_weight: 20 kN/m3, K0: 0.43}]\n");

INSTANTIATE_TEST_SUITE_P(
    RealTime, CarelessFeatures,
    ::testing::Values(
        Careless{"DensityInTons", kColumn, "density: 2000 kg/m3", "density: 2.0", "a density of 2 kg/m3"},
        Careless{"DensityOfWater", kHeavyColumn, "density: 2000 kg/m3", "density: 1000 kg/m3",
                 "a density of 1000 kg/m3 weighs 9.81 kN/m3, and region 'all' has 20 kN/m3 below body",
                 Rank::doubtful}),
    [](const auto& info) { return info.param.name; });

INSTANTIATE_TEST_SUITE_P(RealTime, OddFeatures,
                         ::testing::Values(Careless{"FreeVibration", kColumn, "", ""},
                                           Careless{"VibrationInItsWeight", kHeavyColumn, "", ""},
                                           Careless{"VibrationOfSubmergedGround",
                                                    replaced(kHeavyColumn, "body: [{unit_weight: 20",
                                                             "body: [{unit_weight: 10"),
                                                    "10 m, unit_weight: 20", "10 m, unit_weight: 10"}),
                         [](const auto& info) { return info.param.name; });

/// On 2 s of the column on a base that moves after a file.
app::Remarks remarks_on_motion_of(const Scratch& scratch, const std::string& file = "quake.csv") {
  write(scratch.path() / "case.yaml",
        replaced(replaced(kColumn, "  - {on: bottom, fix: [u1, u2]}\n",
                          "  - {on: bottom, fix: [u2], accelerate: {u1: " + file + "}}\n"),
                 "  - {on: top, traction: {u1: [[0, 10 kPa], [0.1, 10 kPa], [0.11, 0]]}}\n", ""));
  return app::remarks_on(coupler::read_case(scratch.path() / "case.yaml"), std::vector<std::string>{}, {});
}

/// A motion of `rows` rows 0.01 s apart, of this amplitude in m/s2.
std::string swings(int rows, double amplitude) {
  std::string table = "time,acceleration\n";
  for (int row = 0; row < rows; ++row)
    table += fmt::format("{},{}\n", 0.01 * row, amplitude * std::sin(0.12 * row));
  return table;
}

/// @returns the remarks on 2 s of it
app::Remarks remarks_on_motion(int rows, double amplitude) {
  const Scratch scratch("careless_motion");
  write(scratch.path() / "quake.csv", swings(rows, amplitude));
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
  // What is pushed against a support is damped against the support.
  write(scratch.path() / "case.yaml",
        replaced(shaken, "accelerate: {u1: quake.csv}", "move: {u1: [[0, 0], [2, 10 mm]]}"));
  EXPECT_NO_THROW((void)coupler::read_case(scratch.path() / "case.yaml"));
}

app::Remarks remarks_on_text(const std::string& text) {
  const Scratch scratch("careless_text");
  write(scratch.path() / "quake.csv", swings(201, 1.0));
  write(scratch.path() / "case.yaml", text);
  return app::remarks_on(coupler::read_case(scratch.path() / "case.yaml"), std::vector<std::string>{}, {});
}

bool says(const app::Remarks& remarks, const std::string& part) {
  return std::ranges::any_of(
      remarks, [&](const app::Remark& remark) { return remark.at.message.find(part) != std::string::npos; });
}

const std::string kQuietBase =
    replaced(replaced(kColumn, "{on: bottom, fix: [u1, u2]}", "{on: bottom, fix: [u1, u2], quiet: true}"),
             "monitors:\n", "monitors:\n  base: {on: bottom, displacement: u1}\n");

TEST(QuietBoundary, MovesThoughItIsFixedAtTheStart) {
  const app::Remarks remarks = remarks_on_text(
      replaced(kQuietBase, "[[0, 10 kPa], [0.1, 10 kPa], [0.11, 0]]", "[[0, 0], [0.1, 10 kPa], [0.2, 0]]"));
  EXPECT_TRUE(remarks.empty()) << app::text_of(remarks, true);
}

/// Forces that held the start stay: a load that goes leaves theirs, one that comes and stays leaves itself. 10 kPa on 1 m. Shear
/// waves of 87.7 m/s go through the column, 10 m high, 18 times in 2 s, and not even once in 0.1 s. A vibration drifts nowhere.
TEST(QuietBoundary, AloneHoldsNoLoadAlongItsAxis) {
  const std::string message =
      "loads along 1 stay 10 kN/m away from those of the start, and quiet boundaries alone hold the body along 1";
  const std::string lasting =
      replaced(kQuietBase, "[[0, 10 kPa], [0.1, 10 kPa], [0.11, 0]]", "[[0, 0], [0.1, 10 kPa]]");
  std::string vibration = "[[0, 0]";  // 10 Hz, up to a peak
  for (int k = 1; k <= 41; ++k)
    vibration += fmt::format(", [{}, {} kPa]", 0.05 * k - 0.025, k % 2 == 0 ? -10 : 10);
  vibration += "]";
  for (const std::string& text : {kQuietBase, lasting}) {
    const app::Remarks remarks = remarks_on_text(text);
    EXPECT_TRUE(is_told_of_features(remarks, message, Rank::doubtful)) << app::text_of(remarks, true);
  }
  for (const std::string& text :
       {replaced(lasting, "[[0, 0], [0.1, 10 kPa]]", vibration),
        replaced(lasting, "duration: 2 s, count: 200", "duration: 0.1 s, count: 10"),
        replaced(lasting, "fix: [u1, u2], quiet: true", "fix: [u1, u2]")}) {
    const app::Remarks remarks = remarks_on_text(text);
    EXPECT_FALSE(says(remarks, "drifts on")) << app::text_of(remarks, true);
  }
}

/// A quiet side beside a shaken base holds the ground back. Beside a wall that is pushed, a quiet bottom is right.
TEST(QuietBoundary, BesideAShakenBaseIsTold) {
  const std::string sides = "  - {on: [left, right], fix: [u2]}\n  - {on: left, tie: right}\n";
  const std::string load = "  - {on: top, traction: {u1: [[0, 10 kPa], [0.1, 10 kPa], [0.11, 0]]}}\n";
  const std::string bottom = "{on: bottom, fix: [u1, u2]}";
  for (const char* const motion :
       {"accelerate: {u1: quake.csv}", "move: {u1: [[0, 0], [1, 5 mm], [2, 0]]}"}) {
    const std::string shaken =
        replaced(replaced(kColumn, load, ""), bottom, fmt::format("{{on: bottom, fix: [u2], {}}}", motion));
    const app::Remarks tied = remarks_on_text(shaken);
    EXPECT_FALSE(says(tied, "quiet")) << app::text_of(tied, true);
    const app::Remarks remarks =
        remarks_on_text(replaced(shaken, sides, "  - {on: [left, right], fix: [u2], quiet: true}\n"));
    EXPECT_TRUE(is_told_of_features(remarks, "'left' is quiet beside 'bottom', which moves", Rank::wrong))
        << app::text_of(remarks, true);
    const app::Remarks pushed = remarks_on_text(
        replaced(replaced(replaced(kColumn, load, ""), bottom, "{on: bottom, fix: [u2], quiet: true}"), sides,
                 fmt::format("  - {{on: left, {}}}\n", motion)));
    EXPECT_FALSE(says(pushed, "is quiet beside")) << app::text_of(pushed, true);
  }
}

/// Ground on a shelf of rock above the middle of its height; its top, which is as high, may well be shaken.
TEST(QuietBoundary, BesideAHighBaseIsTold) {
  const std::string shelf = R"(title: Ground on a shelf of rock
continuum: cauchy
mesh:
  rectangle:
    {size: [20 m, 10 m], elements: [20, 10], regions: {void: [0, 0, 8 m, 6 m]}, lines: {shelf: [0, 6 m, 8 m, 6 m]}}
materials:
  soil: {model: elastic, E: 40 MPa, nu: 0.3, density: 2000 kg/m3}
regions: {rest: soil}
boundary:
  - {on: [bottom, shelf], fix: [u2], move: {u1: [[0, 0], [0.1, 1 mm], [0.2, 0]]}}
  - {on: left, fix: [u2], quiet: true}
  - {on: right, fix: [u2]}
steps: {method: explicit, time: real, duration: 1 s, count: 200, mass_damping: 3}
monitors:
  top: {on: top, displacement: u1}
output: {every: 50, table: [top]}
)";
  const app::Remarks remarks = remarks_on_text(shelf);
  EXPECT_TRUE(is_told_of_features(remarks, "'left' is quiet beside 'shelf', which moves", Rank::wrong))
      << app::text_of(remarks, true);
  const app::Remarks above = remarks_on_text(replaced(shelf, "on: [bottom, shelf]", "on: top"));
  EXPECT_FALSE(says(above, "is quiet beside")) << app::text_of(above, true);
}

/// A quiet boundary is let go once the start is balanced, and a movement given to it then would be dropped. A support is no
/// movement.
TEST(QuietBoundary, ThatIsMovedIsAFault) {
  const Scratch scratch("careless_quiet_moved");
  write(scratch.path() / "quake.csv", swings(201, 1.0));
  const std::string bottom = "{on: bottom, fix: [u1, u2]}";
  for (const char* const motion : {"accelerate: {u1: quake.csv}", "move: {u1: 5 mm}"}) {
    write(scratch.path() / "case.yaml",
          replaced(kColumn, bottom, fmt::format("{{on: bottom, fix: [u2], {}, quiet: true}}", motion)));
    try {
      (void)coupler::read_case(scratch.path() / "case.yaml");
      ADD_FAILURE() << motion;
    } catch (const InputError& error) {
      ASSERT_EQ(error.faults().size(), 1U);
      EXPECT_EQ(error.faults().front().line, 8);
      EXPECT_EQ(
          error.faults().front().message,
          "boundary item 1: 'bottom' is quiet, which lets it go once the start is balanced: its movement "
          "would be dropped; move another boundary, or leave quiet out");
    }
  }
  write(
      scratch.path() / "case.yaml",
      replaced(kColumn, bottom, "{on: bottom, fix: [u2], move: {u1: [[0, 5 mm], [1, 5 mm]]}, quiet: true}"));
  EXPECT_NO_THROW((void)coupler::read_case(scratch.path() / "case.yaml"));
}

TEST(Motions, OfSingleValuesThatEndBeforeTheRunAreTold) {
  const std::string bottom = "{on: bottom, fix: [u1, u2]}";
  const std::string message = "the movement of '-10 mm' is over at 1 s";
  const app::Remarks single =
      remarks_on_text(replaced(kColumn, bottom, "{on: bottom, fix: [u2], move: {u1: -10 mm}}"));
  EXPECT_TRUE(is_told_of_features(single, message, Rank::doubtful)) << app::text_of(single, true);
  const app::Remarks table = remarks_on_text(
      replaced(kColumn, bottom, "{on: bottom, fix: [u2], move: {u1: [[0, 0], [2, -10 mm]]}}"));
  EXPECT_FALSE(says(table, "is over at 1 s")) << app::text_of(table, true);
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

/// A sine of 0.3 that was recorded in g.
TEST(Motions, InPartsOfGravityAreToldWhereTheFileSaysSo) {
  const std::string units = "# Acceleration time series in units of G\n";
  struct Record {
    std::string file, comment;
    double amplitude;
    std::string message;
  };
  for (const Record& record :
       {Record{"quake_g.csv", "", 0.3,
               "reaches 0.3 m/s2, 0.031 times gravity, and the name of the file says 'g'"},
        Record{"quake.csv", units, 0.3, "and a comment of the file says 'g'"},
        Record{"quake.csv", "", 0.3, ""}, Record{"quake_g.csv", "", 3.0, ""},
        Record{"quake_0.1g.csv", "# peak 0.1 g, gusts\n", 0.98, ""}}) {
    const Scratch scratch("careless_gravity");
    write(scratch.path() / record.file, record.comment + swings(201, record.amplitude));
    const app::Remarks remarks = remarks_on_motion_of(scratch, record.file);
    EXPECT_EQ(remarks.size(), record.message.empty() ? 0U : 1U) << app::text_of(remarks, true);
    EXPECT_TRUE(record.message.empty() || is_told_of_features(remarks, record.message, Rank::wrong))
        << app::text_of(remarks, true);
  }
}

TEST(Motions, AreAmongTheSizes) {
  const Scratch scratch("careless_sizes");
  const std::filesystem::path file = scratch.path() / "case.yaml";
  write(scratch.path() / "quake.csv", "time,acceleration\n0,0\n0.5,0.4905\n1.5,-0.981\n2,0\n");
  static_cast<void>(remarks_on_motion_of(scratch));
  const coupler::Case the_case = coupler::read_case(file);
  const coupler::Entry document = coupler::load_document_of(coupler::DocumentKind::problem, file, {});
  const app::PackingsAtRest no_packings;
  const std::string sizes = app::sizes_text(app::Scene(the_case, document, no_packings));
  EXPECT_NE(sizes.find("motion of 'quake.csv' along u1: 2 s, at most 0.981 m/s2 (0.1 g)\n"),
            std::string::npos)
      << sizes;
}

TEST(Motions, AsLongAsTheRunAreRight) {
  const app::Remarks remarks = remarks_on_motion(201, 1.0);
  EXPECT_TRUE(remarks.empty()) << app::text_of(remarks, true);
}

/// A bar across which H20 is 0.3 m wide loses 43, 25 and 11 % of the peak under triangles of 6, 9 and 18 ms, H8 11 % of the first:
/// compression waves have 164 m/s. A front that stays has no peak, and ripples and slow tables hide no pulse.
TEST(Pulses, ShorterThanElementsAreTold) {
  const std::string bar = R"(title: A bar under a pulse
continuum: cauchy
mesh: {box: {size: [0.3 m, 0.3 m, 3 m], elements: [1, 1, 40]}, element: H20R}
materials: {m: {model: elastic, E: 40 MPa, nu: 0.3, density: 2000 kg/m3}}
regions: {all: m}
boundary:
  - {on: all, fix: [u1, u2]}
  - {on: bottom, fix: [u3], quiet: true}
  - {on: top, pressure: LOAD}
steps: {method: explicit, time: real, duration: 0.04 s, count: 100}
monitors:
  m: {at: [0.15, 0.15, 1.5], stress: s33}
)";
  const auto under = [&](const std::string& load, const std::string& element = "H20R") {
    return remarks_on_text(replaced(replaced(bar, "LOAD", load), "H20R", element));
  };
  const std::string message = "the pulse there takes";
  const std::string sharp = "[[0, 0], [0.003 s, 10 kPa], [0.006 s, 0]]";
  EXPECT_TRUE(is_told_of_features(under(sharp),
                                  "takes 6 ms, whose compression wave is 984 mm long in region 'all': 3.3 "
                                  "sides of H20R elements (at least 7)",
                                  Rank::doubtful))
      << app::text_of(under(sharp), true);
  for (const char* const load : {"[[0, 0], [0.0045 s, 10 kPa], [0.009 s, 0]]",
                                 "[[0, 0], [0.01 s, 9 kPa], [0.013 s, 0], [0.016 s, 10 kPa]]"})
    EXPECT_TRUE(says(under(load), message)) << load;
  for (const char* const load :
       {"[[0, 0], [0.009 s, 10 kPa], [0.018 s, 0]]", "[[0, 0], [0.003 s, 10 kPa]]",
        "[[0, 0], [0.003 s, 10 kPa], [0.03 s, 10 kPa], [0.033 s, 0]]",
        "[[0, 0], [0.01 s, 9 kPa], [0.011 s, 8 kPa], [0.02 s, 10 kPa], [0.04 s, 0]]"})
    EXPECT_FALSE(says(under(load), message)) << app::text_of(under(load), true);
  EXPECT_FALSE(says(under(sharp, "H8"), message)) << app::text_of(under(sharp, "H8"), true);
}

/// Waves are as long as pulses of the speed: there and back in 0.02 s moves at one speed for 10 ms each. The speed of a record whose
/// accelerations swing at 2.5 Hz begins at rest: its first half period counts from half of the peak, T/12, on.
TEST(Pulses, OfMovementsAreThoseOfTheirSpeed) {
  const auto shortest = [](const fem::TimeTable& table) {
    return app::shortest_pulse(app::speeds_until(table, 2.0));
  };
  EXPECT_NEAR(shortest(fem::TimeTable({{0.1, 0.0}, {0.11, 1e-3}, {0.12, 0.0}})), 0.02, 1e-12);
  EXPECT_EQ(shortest(fem::TimeTable::ramp(1e-3, 3.0)), 0.0);
  std::vector<fem::TimeTable::Point> swings;
  for (int k = 0; k <= 100; ++k) swings.push_back({0.02 * k, std::cos(2.0 * std::numbers::pi * k / 20.0)});
  EXPECT_NEAR(shortest(fem::TimeTable::of_accelerations(swings)), 0.4 * 5.0 / 6.0, 0.01);
}

}  // namespace
}  // namespace polargrain::testing
