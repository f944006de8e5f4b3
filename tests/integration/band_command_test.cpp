// SPDX-License-Identifier: GPL-2.0-or-later
// polargrain band on results whose band is known: grain dumps, fields of a run, fields of image correlation.
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

// ---- image correlation

/// A band whose displacement along it is slide / 2 tanh(s / kScale): its shear strain is slide / (2 kScale) sech^2(s /
/// kScale), 17.6 mm wide at half maximum.
constexpr double kScale = 0.01;
constexpr double kPlaceSpacing = 0.0025;

Eigen::Vector2d tanh_displacement(const Eigen::Vector2d& place, double slide) {
  const Eigen::Vector2d along(std::cos(kInclination), std::sin(kInclination));
  const double s = -along.y() * (place.x() - 0.05) + along.x() * (place.y() - 0.1);
  return 0.5 * slide * std::tanh(s / kScale) * along;
}

/// An irregular grid of 40 x 80 places, 2.5 mm apart, each off its place by up to a third of that; every seventeenth has no
/// displacement, in two spellings. Lengths in pixels of 0.1 mm, y downwards, where asked for.
std::string correlation(double slide, bool pixels, int first_missing = 3) {
  std::string text = "# a correlation\nx,y,u,v,correlation\n";
  const double unit = pixels ? 1e-4 : 1.0;
  const double up = pixels ? -1.0 : 1.0;
  for (int k = 0; k < 40 * 80; ++k) {
    const Eigen::Vector2d place(kPlaceSpacing * (k % 40 + 0.5 + 0.33 * std::sin(7.0 * k)),
                                kPlaceSpacing * (k / 40 + 0.5 + 0.33 * std::cos(11.0 * k)));
    const Eigen::Vector2d moved = tanh_displacement(place, slide);
    text += fmt::format("{:.12g},{:.12g},", place.x() / unit, up * place.y() / unit);
    if (k % 17 == first_missing)
      text += k % 2 == 0 ? ",,0\n" : "nan,NaN,0\n";
    else
      text += fmt::format("{:.12g},{:.12g},0.99\n", moved.x() / unit, up * moved.y() / unit);
  }
  return text;
}

double number_of(const std::string& json, const std::string& key) {
  return std::stod(json.substr(json.find("\"" + key + "\": ") + key.size() + 4));
}

/// Width at half maximum of the sech^2 band once it is smoothed: by a neighbourhood of strain, whose kernel (1 - r^2 /
/// radius^2)^3, seen across the band, is (1 - t^2 / radius^2)^3.5; and by the bell of the profile. By sums of 0.1 mm.
double smoothed_width(double radius, double resolution) {
  constexpr double kStep = 1e-4;
  constexpr int kReach = 600;
  const double deviation = resolution / 2.354820045;
  const auto smoothed = [](const std::vector<double>& values, const auto& kernel) {
    std::vector<double> result(values.size());
    for (int at = 0; at <= 2 * kReach; ++at) {
      double sum = 0.0;
      double weights = 0.0;
      for (int from = 0; from <= 2 * kReach; ++from) {
        const double weight = kernel(kStep * (at - from));
        sum += weight * values[static_cast<std::size_t>(from)];
        weights += weight;
      }
      result[static_cast<std::size_t>(at)] = sum / weights;
    }
    return result;
  };
  std::vector<double> values;
  for (int at = -kReach; at <= kReach; ++at) values.push_back(std::pow(std::cosh(kStep * at / kScale), -2.0));
  values = smoothed(values,
                    [&](double t) { return std::pow(std::max(0.0, 1.0 - t * t / (radius * radius)), 3.5); });
  values = smoothed(values, [&](double t) { return std::exp(-0.5 * t * t / (deviation * deviation)); });
  int at = kReach;
  while (values[static_cast<std::size_t>(at)] > 0.5 * values[kReach]) ++at;
  const double above = values[static_cast<std::size_t>(at) - 1] - 0.5 * values[kReach];
  const double below = 0.5 * values[kReach] - values[static_cast<std::size_t>(at)];
  return 2.0 * kStep * (at - 1 - kReach + above / (above + below));
}

/// Inclination and thickness of band.json are those of the tanh band.
void expect_tanh_band(const std::string& json) {
  // Inclination: a tenth of a spacing over half the length of the band is 0.23 degrees. Thickness: the background of a body
  // of this size, its lowest quartile, is 0.3 % of the peak; places are a quarter of a spacing out of their kernels' middle: 1 %.
  EXPECT_NEAR(number_of(json, "inclination_degrees"), 55.0, 0.23);
  const double expected = smoothed_width(2.5 * kPlaceSpacing, number_of(json, "resolution"));
  std::cout << "[figure] thickness / exact " << number_of(json, "thickness") / expected << "\n";
  EXPECT_NEAR(number_of(json, "thickness"), expected, 0.015 * expected);
}

TEST(BandCommand, MeasuresOneFieldOfImageCorrelation) {
  const Scratch scratch("band_images");
  write(scratch.path() / "field.csv", correlation(0.004, false));
  write(scratch.path() / "notes.csv", "x,y,reading\n1,2,3\n");
  const Outcome refused =
      run_in(scratch.path(), std::string(POLARGRAIN) + " band field.csv --fields notes.csv");
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.errors.find("--fields notes.csv: this file is there and is no table of this command"),
            std::string::npos)
      << refused.errors;
  const Outcome outcome =
      run_in(scratch.path(), std::string(POLARGRAIN) + " band field.csv --fields samples.csv");
  ASSERT_EQ(outcome.status, 0) << outcome.errors;
  std::cout << outcome.out;
  EXPECT_NE(outcome.out.find("3011 places of the images; 189 without a displacement are left out"),
            std::string::npos);
  const std::string json = content(scratch.path() / "field.band.json");
  expect_tanh_band(json);
  EXPECT_EQ(number_of(json, "missing"), 189.0);
  // Pixels and y downwards are another way to write the same; a half shift of the field is the same increment.
  write(scratch.path() / "pixels1.csv", correlation(0.001, true));
  write(scratch.path() / "pixels2.csv", correlation(0.005, true, 5));
  const Outcome pixels =
      run_in(scratch.path(), std::string(POLARGRAIN) + " band pixels1.csv pixels2.csv --unit 0.1mm --y-down");
  ASSERT_EQ(pixels.status, 0) << pixels.errors;
  const std::string second = content(scratch.path() / "pixels2.band.json");
  expect_tanh_band(second);
  EXPECT_EQ(number_of(second, "missing"), 377.0);
  EXPECT_NEAR(number_of(second, "peak_shear"), number_of(json, "peak_shear"),
              0.005 * number_of(json, "peak_shear"));
  // A larger neighbourhood smears the band, as its own filter says.
  ASSERT_EQ(run_in(scratch.path(), std::string(POLARGRAIN) + " band field.csv --neighbourhood 12mm").status,
            0);
  const double wide = number_of(content(scratch.path() / "field.band.json"), "thickness");
  EXPECT_NEAR(wide, smoothed_width(0.012, number_of(json, "resolution")), 0.015 * wide);
}

TEST(BandCommand, FollowsImagesToTheirOnset) {
  const Scratch scratch("band_onset");
  std::filesystem::create_directories(scratch.path() / "run/displacements");
  std::string history = "step,axial_strain\n";
  for (int frame = 1; frame <= 6; ++frame) {
    write(scratch.path() / fmt::format("run/displacements/step-{}.csv", frame),
          correlation(0.002 * std::max(0, frame - 2), false));
    history += fmt::format("{},{}\n", frame, 0.01 * frame);
  }
  write(scratch.path() / "run/history.csv", history);
  const Outcome outcome =
      run_in(scratch.path(), std::string(POLARGRAIN) + " band run --from 0.03 --window 0.01");
  ASSERT_EQ(outcome.status, 0) << outcome.errors;
  const std::string json = content(scratch.path() / "run/band.json");
  expect_tanh_band(json);
  // As with grains: nothing moves until 0.02, the next increment is all band.
  EXPECT_NEAR(number_of(json, "onset_strain"), 0.0155, 5e-4);
}

TEST(BandCommand, NamesWhatIsWrongWithFieldsOfImages) {
  const Scratch scratch("band_bad_images");
  const auto refused = [&](const std::string& text, const std::string& message,
                           const std::string& options = "") {
    write(scratch.path() / "f.csv", text);
    const Outcome outcome = run_in(scratch.path(), std::string(POLARGRAIN) + " band f.csv " + options);
    EXPECT_EQ(outcome.status, 2) << text;
    EXPECT_NE(outcome.errors.find(message), std::string::npos) << outcome.errors;
    EXPECT_FALSE(std::filesystem::exists(scratch.path() / "f.band.json"));
  };
  refused("x,y,u\n0,0,1\n", "f.csv:1: there is no column 'v'; there are x, y, u");
  refused("x,y,u,v\n0,0,1,1\n1,0,ja,1\n", "f.csv:3: 'ja' in column 'u' is not a number");
  refused("x,y,u,v\n0,,1,1\n", "f.csv:2: '' in column 'y' is not a number");
  refused("x,y,u,v\n0,0,1,1\n1,0,inf,1\n", "f.csv:3: 'inf' in column 'u' is not a number");
  refused("x,y,u,v\n0,0,1,1\n1,0,1\n", "f.csv:3: a value for each of 4 columns");
  refused("x,y,u,v\n0,0,1,1\n\n0.0,0,1,2\n", "f.csv:4: the place x = 0, y = 0 stands already in line 2");
  refused("x,y,u,v\n0,0,nan,1\n", "no place has a displacement");
  refused("x,y,u,v\n0,0,0,1\n1,0,0,1\n", "the places fill no area");
  refused(correlation(0.001, false), "--unit 3kPa: a length in m", "--unit 3kPa");
  refused(correlation(0.001, false), "--neighbourhood -1mm: a length in m", "--neighbourhood -1mm");
  write(scratch.path() / "other.csv", "x,y,u,v\n7,7,0,0\n");
  const Outcome apart = run_in(scratch.path(), std::string(POLARGRAIN) + " band other.csv f.csv");
  EXPECT_EQ(apart.status, 2);
  EXPECT_NE(apart.errors.find("f.csv: no place has a displacement here and in the other field"),
            std::string::npos)
      << apart.errors;
}

TEST(BandCommand, RefusesFieldsThatAreExchanged) {
  const Scratch scratch("band_exchanged");
  write(scratch.path() / "step-9.csv", correlation(0.001, false));
  write(scratch.path() / "step-10.csv", correlation(0.005, false));
  const std::string band = std::string(POLARGRAIN) + " band ";
  const Outcome exchanged = run_in(scratch.path(), band + "step-10.csv step-9.csv");
  EXPECT_EQ(exchanged.status, 2);
  EXPECT_NE(exchanged.errors.find("step-10.csv: by its number this field is later than step-9.csv"),
            std::string::npos)
      << exchanged.errors;
  EXPECT_EQ(run_in(scratch.path(), band + "step-9.csv step-10.csv").status, 0);
  const Outcome over = run_in(scratch.path(), band + "step-9.csv --fields step-9.csv");
  EXPECT_EQ(over.status, 2);
  EXPECT_EQ(content(scratch.path() / "step-9.csv"), correlation(0.001, false));
}

TEST(BandCommand, TellsOfFieldsWithoutAUnit) {
  const Scratch scratch("band_unit");
  write(scratch.path() / "pixels.csv", correlation(0.004, true));
  const std::string band = std::string(POLARGRAIN) + " band pixels.csv --y-down ";
  EXPECT_NE(run_in(scratch.path(), band).errors.find("give the length of 1 with --unit"), std::string::npos);
  EXPECT_EQ(run_in(scratch.path(), band + "--unit 0.1mm").errors, "");
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
  EXPECT_NE(errors("run --from 0.05 --to 0.02").find("--from 0.05 lies behind --to 0.02"), std::string::npos);
  EXPECT_NE(errors("run --fields run/history.csv").find("the place of a result"), std::string::npos);
  write(scratch.path() / "run/grains/step-0000600.dump", "ITEM: ATOMS id x y f_turned\n1 2 x 4\n");
  EXPECT_NE(errors("run").find("step-0000600.dump:2: 'x' is no number"), std::string::npos) << errors("run");
  write(scratch.path() / "run/history.csv", "step,axial_strain\n100,0.01\n");
  EXPECT_NE(errors("run").find("there is no row of step 200"), std::string::npos);
}

}  // namespace
