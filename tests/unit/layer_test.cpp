// SPDX-License-Identifier: GPL-2.0-or-later
// The ruler of `polargrain layer`, its figures, its search for lengths, and the script and case that it makes.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <random>

#include "app/layer/column.hpp"
#include "app/layer/descriptions.hpp"
#include "app/layer/grain_layer.hpp"
#include "app/layer/lengths.hpp"
#include "app/layer/ruler.hpp"
#include "app/layer/shearing.hpp"
#include "common/error.hpp"
#include "common/mean_and_interval.hpp"

namespace polargrain::app {
namespace {

const double kWidth = 2.0 * std::acosh(std::sqrt(2.0));  // of a tanh of length 1, at half of its rate

Eigen::VectorXd profile(const Eigen::VectorXd& y, double slope, double half, double place, double length) {
  return 0.3 + slope * y.array() + half * ((y.array() - place) / length).tanh();
}

TEST(LayerRuler, FindsTheBandOfALineAndATanh) {
  const Eigen::VectorXd y = Eigen::VectorXd::LinSpaced(81, 0.1, 0.5);
  for (const double length : {0.004, 0.02, 0.05}) {
    const Band band = band_of(y, profile(y, 0.02, 0.005, 0.27, length));
    // An exact profile, and an optimiser that ends at 1e-9 of the height.
    EXPECT_NEAR(band.thickness, kWidth * length, 1e-6 * length) << length;
    EXPECT_NEAR(band.place, 0.27, 1e-7) << length;
    EXPECT_NEAR(band.share, 1.0, 1e-9) << length;
  }
}

TEST(LayerRuler, ScatteredGrainsGiveTheBandWithinTheirScatter) {
  std::mt19937 random(3);
  const int count = 1600;
  Eigen::VectorXd y(count);
  Eigen::VectorXd u(count);
  for (int k = 0; k < count; ++k) y[k] = 0.4 * static_cast<double>(random()) / 4294967296.0;
  u = profile(y, 0.01, 0.005, 0.2, 0.03);
  for (int k = 0; k < count; ++k) u[k] += 1e-3 * (static_cast<double>(random()) / 4294967296.0 - 0.5);
  const Band band = band_of(y, u);
  std::cout << "[figure] thickness of a band with a tenth of noise: " << band.thickness / (kWidth * 0.03)
            << '\n';
  // Noise of 0.29 mm rms on either side of 5 mm, on some 210 places in the band: 0.4 %, three times that as the line may take part
  // of the tanh; three of these.
  EXPECT_NEAR(band.thickness, kWidth * 0.03, 0.035 * kWidth * 0.03);
}

TEST(LayerRuler, SaysWhereThereIsNothingToFit) {
  const Eigen::VectorXd few = Eigen::VectorXd::LinSpaced(4, 0.0, 1.0);
  EXPECT_THROW(band_of(few, few), RunError);
  const Eigen::VectorXd flat = Eigen::VectorXd::Ones(9);
  EXPECT_THROW(band_of(flat, flat), RunError);
}

/// A layer of a diameter of 10 mm whose ratio rises to 0.7 at one diameter and falls to 0.4 over three, with a band that
/// grows from 4 to 5 diameters and turns with the continuum.
Shearing known_layer() {
  Shearing shearing;
  constexpr double kDiameter = 0.01;
  const Eigen::VectorXd y = Eigen::VectorXd::LinSpaced(161, 0.0, 0.4);
  Eigen::VectorXd along = Eigen::VectorXd::Zero(161);
  Eigen::VectorXd turned = Eigen::VectorXd::Zero(161);
  for (int k = 0; k <= 600; ++k) {
    const double way = 0.01 * k;  // diameters
    shearing.displacements.push_back(way * kDiameter);
    shearing.ratios.push_back(way < 1.0 ? 0.7 * way : std::max(0.4, 0.7 - 0.1 * (way - 1.0)));
    const double width = 4.0 + (way > 3.5 ? 1.0 : 0.0);
    const double length = width * kDiameter / kWidth;
    if (k > 0) {
      along += profile(y, 0.0, 0.5 * 0.01 * kDiameter, 0.2, length);
      turned.array() -= 0.5 * 0.01 * kDiameter / (width * kDiameter);
    }
    shearing.frames.push_back({way * kDiameter, y, along, turned});
  }
  return shearing;
}

TEST(LayerFiguresOf, AKnownLayer) {
  const LayerFigures figures = figures_of(known_layer(), 0.01, 4.0);
  EXPECT_TRUE(figures.complete);
  // The mean over half a diameter takes the tip off: on the side that rises 0.7 a diameter and that which falls 0.1.
  EXPECT_NEAR(figures.peak, 0.68, 0.02);
  EXPECT_NEAR(figures.peak_at, 1.2, 0.1);
  EXPECT_NEAR(figures.halfway * figures.peak, 0.7 - 0.1 * (figures.peak_at + 1.0), 1e-3);
  EXPECT_NEAR(figures.end * figures.peak, 0.4, 1e-12);
  EXPECT_GT(figures.thickness, 4.0);
  EXPECT_LT(figures.thickness, 5.0);
  EXPECT_NEAR(figures.growth, 1.25, 0.1);
  EXPECT_NEAR(figures.turning, -0.5, 0.02);
  EXPECT_FALSE(figures_of(known_layer(), 0.01, 8.0).complete);
  EXPECT_THROW(figures_of(Shearing{}, 0.01, 4.0), RunError);
}

TEST(LayerFiguresOf, AJumpThatPassesAPlaceHasTheRatioBetweenItsEnds) {
  const LayerFigures whole = figures_of(known_layer(), 0.01, 4.0);
  Shearing jumping = known_layer();
  std::size_t kept = 0;
  for (std::size_t k = 0; k < jumping.ratios.size(); ++k) {
    const double way = jumping.displacements[k] / 0.01;
    if (way > 2.4 && way < 3.9) continue;  // the curve is straight there
    jumping.displacements[kept] = jumping.displacements[k];
    jumping.ratios[kept++] = jumping.ratios[k];
  }
  jumping.displacements.resize(kept);
  jumping.ratios.resize(kept);
  EXPECT_NEAR(figures_of(jumping, 0.01, 4.0).halfway, whole.halfway, 1e-3);
}

TEST(LayerFiguresOf, ALayerThatBrokeOffBehindAJumpHasTheBandOfTheJump) {
  const Shearing whole = known_layer();
  Shearing broken;
  for (const std::size_t k : {0U, 20U, 40U, 60U, 260U}) {  // in hundredths of a diameter
    broken.displacements.push_back(whole.displacements[k]);
    broken.ratios.push_back(1e-3 * static_cast<double>(k));
    broken.frames.push_back(whole.frames[k]);
  }
  const LayerFigures figures = figures_of(broken, 0.01, 4.0);
  EXPECT_FALSE(figures.complete);
  EXPECT_NEAR(figures.thickness, 4.0, 0.05);
}

TEST(LayerFiguresOf, ALayerThatHasItsPeakAtItsEndIsNotCompleteAndStillHasABand) {
  Shearing rising = known_layer();
  for (std::size_t k = 0; k < rising.ratios.size(); ++k) rising.ratios[k] = 1e-3 * static_cast<double>(k);
  const LayerFigures figures = figures_of(rising, 0.01, 4.0);
  EXPECT_FALSE(figures.complete);
  EXPECT_NEAR(figures.thickness, 5.0, 0.05);  // its last width; half a per cent of it a fit may be off
}

LayerFigures like(double thickness, double halfway, double end) {
  LayerFigures figures;
  figures.peak = 0.7;
  figures.thickness = thickness;
  figures.halfway = halfway;
  figures.end = end;
  return figures;
}

/// A continuum whose band is 10 times the geometric mean of both lengths, and whose strength they raise.
LayerFigures continuum(double lc, double lp) {
  return like(10.0 * std::sqrt(lc * lp), 0.7 + 0.02 * std::log(lc), 0.6 + 0.05 * std::log(lp));
}

Candidates candidates(const std::vector<double>& internal, const std::vector<double>& plastic) {
  Candidates made{internal, plastic, {}};
  for (const double lc : internal) {
    made.figures.emplace_back();
    for (const double lp : plastic) made.figures.back().push_back(continuum(lc, lp));
  }
  return made;
}

TEST(LayerLengths, AreFoundBetweenTheCandidates) {
  const std::vector<LayerFigures> layers{continuum(0.3, 0.5), continuum(0.3, 0.5)};
  const FoundLengths found = lengths_like(layers, candidates({0.2, 0.4, 0.8}, {0.25, 1.0}));
  // The continuum is linear in the logarithms: a hundredth of the way between candidates is 0.7 % and 1.4 %.
  EXPECT_NEAR(found.first, 0.3, 0.01 * 0.3);
  EXPECT_NEAR(*found.second, 0.5, 0.02 * 0.5);
  EXPECT_FALSE(found.at_edge);
  EXPECT_LT(found.misfit, 0.2);
  EXPECT_NEAR(found.figures.thickness, 10.0 * std::sqrt(0.15), 0.05);
}

TEST(LayerLengths, BeyondTheCandidatesAreSaidToBe) {
  const std::vector<LayerFigures> layers{continuum(2.0, 0.5), continuum(2.0, 0.5)};
  const FoundLengths found = lengths_like(layers, candidates({0.2, 0.8}, {0.25, 1.0}));
  EXPECT_TRUE(found.at_edge);
  EXPECT_DOUBLE_EQ(found.first, 0.8);
}

TEST(LayerLengths, OneLengthAloneCanBeSought) {
  Candidates elastic{{0.2, 0.8}, {}, {{like(2.0, 0.7, 0.6)}, {like(8.0, 0.7, 0.6)}}};
  const FoundLengths found = lengths_like({like(4.0, 0.7, 0.6), like(4.0, 0.7, 0.6)}, elastic);
  EXPECT_NEAR(found.first, 0.4, 1e-12);
  EXPECT_FALSE(found.second.has_value());
}

Description with_misfits(const std::string& name, const std::vector<double>& misfits) {
  Description made{name, {1.0}, {}};
  for (const double misfit : misfits) {
    made.found.emplace_back();
    made.found.back().misfit = misfit;
  }
  return made;
}

TEST(LayerDescriptions, OneIsPreferredBeyondTheScatterOfTheCellsAlone) {
  // Differences 1, 2, 3: 2 +- 2.48; packing by packing 1.0, 1.1, 0.9: 1.0 +- 0.25, however the misfits scatter.
  const Description least = with_misfits("spread", {1.0, 2.0, 3.0});
  EXPECT_EQ(preferred({with_misfits("lc", {2.0, 4.0, 6.0}), least}), "undecided");
  EXPECT_EQ(preferred({with_misfits("lc", {2.0, 3.1, 3.9}), least}), "spread");
  EXPECT_EQ(
      preferred({with_misfits("lc", {2.0, 3.1, 3.9}), with_misfits("lc and lp", {2.0, 4.0, 6.0}), least}),
      "undecided");
  // One packing of cells has no scatter to be told from.
  EXPECT_EQ(preferred({with_misfits("lc", {9.0}), with_misfits("spread", {0.1})}), "undecided");
  EXPECT_NE(comparison_of({with_misfits("lc", {2.0, 3.1, 3.9}), least})
                .find("the layers prefer this description: spread\n"),
            std::string::npos);
}

TEST(LayerLengths, TheIntervalIsStudents) {
  // Values 1, 2, 3: deviation 1, 4.303 / sqrt(3).
  const auto [mean, half] = mean_and_interval({1.0, 2.0, 3.0});
  EXPECT_DOUBLE_EQ(mean, 2.0);
  EXPECT_NEAR(half, 4.303 / std::sqrt(3.0), 1e-3);
  EXPECT_TRUE(std::isnan(mean_and_interval({1.0}).second));
}

constexpr const char* kScript = R"(units si
dimension 2
boundary p p p   # of a cell
read_data ${packing}
fix contact_modulus all property/global contactModulus peratomtypepair 1 6e8
pair_style gran model hooke/radii tangential history
pair_coeff * *
fix integrate all nve/sphere
fix plane all enforce2d
)";

TEST(LayerScript, IsThatOfTheCellOpenedAndDamped) {
  const LayerScript script = layer_script(kScript, "cell.in");
  EXPECT_EQ(script.modulus, 6e8);
  EXPECT_NE(script.text.find("boundary p f p \n"), std::string::npos);
  EXPECT_EQ(script.text.find("boundary p p p"), std::string::npos);
  EXPECT_NE(script.text.find("tangential history damping on"), std::string::npos);
  EXPECT_EQ(script.text.find("nve/sphere"), std::string::npos);
  EXPECT_NE(script.text.find("layer_shear.in"), std::string::npos);
  EXPECT_NE(script.text.find("suffix fast"), std::string::npos);
  EXPECT_NE(script.text.find("enforce2d"), std::string::npos);
  EXPECT_FALSE(script.spheres);
}

TEST(LayerScript, OfSpheresStaysInSpace) {
  std::string spheres = kScript;
  spheres.replace(spheres.find("dimension"),
                  spheres.find('\n', spheres.find("dimension")) - spheres.find("dimension"), "dimension 3");
  const LayerScript script = layer_script(spheres, "cell.in");
  EXPECT_TRUE(script.spheres);
  EXPECT_EQ(script.text.find("enforce2d"), std::string::npos);
}

std::string error_of(const std::string& script) {
  try {
    layer_script(script, "cell.in");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(LayerScript, RefusesWhatCannotBeALayer) {
  EXPECT_NE(error_of("dimension 2\n").find("gives no number for contactModulus or youngsModulus"),
            std::string::npos);
}

TEST(LayerColumn, OfStiffGrainsDrivesItsPlateAllTheWayInExplicitSteps) {
  ColumnSpecification column;
  column.diameter = 0.01;
  column.height = 0.2;
  column.spread = 0.05;
  column.way = 4.0;
  EXPECT_NE(column_case(column).find("measure"), std::string::npos);
  EXPECT_EQ(column_case(column).find("explicit"), std::string::npos);
  column.explicit_steps = true;
  const std::string text = column_case(column);
  EXPECT_EQ(text.find("measure"), std::string::npos);
  EXPECT_NE(text.find("method: explicit"), std::string::npos);
  // As many rows of nodes as those of larger elements have, whose points part from each other.
  EXPECT_NE(text.find("element: Q4R"), std::string::npos);
  EXPECT_NE(text.find("size: [0.01, 0.2"), std::string::npos) << text;
  EXPECT_NE(text.find("elements: [1, 20]"), std::string::npos) << text;
  // The plate goes the height by time 10, and 5.5 diameters of 10 mm are 2.75 of that; twelve rows a diameter.
  EXPECT_NE(text.find("{until: 2.75, count: 66}"), std::string::npos) << text;
  column.height = 0.04;  // 5.5 diameters are more than the height, which the plate goes by time 10
  EXPECT_NE(column_case(column).find("[13.75, 0.055]"), std::string::npos) << column_case(column);
}

}  // namespace
}  // namespace polargrain::app
