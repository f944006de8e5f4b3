// SPDX-License-Identifier: GPL-2.0-or-later
// Boxes of grains on rough walls: the row of the wall's grains, and the figures of a box.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "app/layer/wall_row.hpp"
#include "app/layer/wall_shearing.hpp"
#include "common/error.hpp"

namespace polargrain::app {
namespace {

/// Discs in rows, shifted at random: 20 wide and 20 high, radius from 3 to 7 mm.
Packing scattered() {
  std::mt19937 random(5);
  const auto share = [&random] { return static_cast<double>(random()) / 4294967296.0; };
  Packing packing;
  packing.box = Eigen::Vector2d(0.2, 0.2).asDiagonal();
  packing.thickness = 0.1;
  for (int k = 0; k < 400; ++k) {
    const double radius = 3e-3 + 4e-3 * share();
    const double mass = 2650.0 * 0.1 * 3.14 * radius * radius;
    packing.grains.push_back(
        {.id = k,
         .position = {0.01 * (k % 20) + 0.003 * share(), 0.01 * (k / 20) + 0.003 * share()},
         .radius = radius,
         .mass = mass,
         .moment_of_inertia = 0.5 * mass * radius * radius});
  }
  return packing;
}

TEST(WallRow, TouchesTheGrainsFromBelowAndFillsTheWidth) {
  const Packing packing = scattered();
  for (const double diameter : {0.0025, 0.005, 0.01, 0.031}) {
    const OnWall box = on_wall(packing, diameter, 0.1);
    double nearest = 1.0;
    double between = 1.0;
    int wall = 0;
    for (const Grain& one : box.grains.grains) {
      if (one.id < 400) {
        EXPECT_LE(one.position.y(), 0.1);
        EXPECT_GT(one.position.y(), box.wall);
        continue;
      }
      ++wall;
      EXPECT_EQ(one.position.y(), box.wall);
      EXPECT_GE(one.mass, box.grains.grains.front().mass * 0.2);
      for (const Grain& other : box.grains.grains) {
        if (other.id == one.id) continue;
        Eigen::Vector2d apart = other.position - one.position;
        apart.x() -= 0.2 * std::round(apart.x() / 0.2);
        double& least = other.id < 400 ? nearest : between;
        least = std::min(least, apart.norm() - one.radius - other.radius);
      }
    }
    EXPECT_EQ(wall, std::lround(0.2 / diameter));
    EXPECT_NEAR(box.radius, 0.1 / wall, 1e-15);
    // The row touches a grain and overlaps none, to rounding; so do its own.
    EXPECT_NEAR(nearest, 0.0, 1e-15) << diameter;
    EXPECT_NEAR(between, 0.0, 1e-15) << diameter;
    EXPECT_NEAR(box.top, 0.1, 1e-15);
  }
  EXPECT_NEAR(on_wall(packing, 0.01, 1.0).top, 0.2, 1e-15) << "no higher than the packing";
  EXPECT_THROW(on_wall(packing, 0.1, 0.1), RunError);
}

/// Friction that rises to 0.5 over one diameter of 10 mm and falls to 0.3 over two; the lowest grains roll by 0.2 rad a diameter, and
/// those five diameters above the wall move by half as much as the plate.
WallShearing known_box(double way) {
  WallShearing box;
  box.wall = 0.004;
  const Eigen::VectorXd heights = Eigen::VectorXd::LinSpaced(100, 0.0045, 0.1035);
  for (int k = 0; k <= 100; ++k) {
    for (int row = 1; row <= 10 && k > 0; ++row) {
      const double slip = way * (k - 1 + 0.1 * row) / 100.0;
      box.layer.displacements.push_back(0.01 * slip);
      box.layer.ratios.push_back(slip < 1.0 ? 0.5 * slip : std::max(0.3, 0.5 - 0.1 * (slip - 1.0)));
      box.rises.push_back(0.001 * slip);
      box.unbalanced.push_back(slip < 2.5 ? 0.1 : 0.3);
    }
    const double slip = way * k / 100.0;
    Shearing::Frame frame{0.01 * slip, heights, heights, Eigen::VectorXd::Zero(100)};
    for (Eigen::Index i = 0; i < 100; ++i) {
      const double above = heights[i] - box.wall;
      frame.along[i] = 0.01 * slip * std::min(1.0, above / 0.1);
      if (above < 0.01) frame.rotations[i] = -0.2 * slip;
    }
    box.layer.frames.push_back(frame);
  }
  return box;
}

TEST(WallFiguresOf, AKnownBox) {
  const WallFigures figures = wall_figures(known_box(5.5), 0.01, 5.0);
  // The mean over half a diameter takes the tip off.
  EXPECT_NEAR(figures.peak, 0.475, 0.015);
  EXPECT_NEAR(figures.peak_at, 1.15, 0.11);
  EXPECT_NEAR(figures.end, 0.3, 1e-12);
  EXPECT_NEAR(figures.rise, 0.4875, 1e-3) << "a mean of the last quarter of a diameter";
  EXPECT_NEAR(figures.unbalanced, 0.2, 1e-3) << "half of the slip each, in rows of 0.0055";
  EXPECT_NEAR(figures.turning, 0.2, 1e-12);
  EXPECT_NEAR(figures.share, 0.5, 0.005) << "heights in steps of a tenth of a diameter";
  ASSERT_EQ(figures.curve.size(), slips_of_curve(5.0).size());
  EXPECT_EQ(figures.curve.front().slip, 0.0);
  EXPECT_EQ(figures.curve.front().opening, 0.0);
  EXPECT_NEAR(figures.curve.back().slip, 0.05, 1e-15);
  for (std::size_t k = 1; k < figures.curve.size(); ++k) {
    const double slip = figures.curve[k].slip / 0.01;
    const double friction = slip < 1.0 ? 0.5 * slip : std::max(0.3, 0.5 - 0.1 * (slip - 1.0));
    // Means over windows that lie lopsided about their slip, by an eighth of a diameter at most.
    EXPECT_NEAR(figures.curve[k].friction, friction, 0.04) << slip;
    EXPECT_NEAR(figures.curve[k].opening, 1e-3 * slip, 1.5e-4) << slip;
  }
  EXPECT_THROW(wall_figures(known_box(4.0), 0.01, 5.0), RunError);
  const auto mean = mean_curve({figures, figures});
  EXPECT_NEAR(mean[3].friction, figures.curve[3].friction, 1e-15);
}

TEST(WallFiguresOf, SlipsOfTheCurveRise) {
  for (const double way : {2.0, 3.3, 5.0, 20.0}) {
    const std::vector<double> slips = slips_of_curve(way);
    EXPECT_EQ(slips.front(), 0.0);
    EXPECT_EQ(slips.back(), way);
    for (std::size_t k = 1; k < slips.size(); ++k) EXPECT_GT(slips[k], slips[k - 1]) << way;
  }
}

}  // namespace
}  // namespace polargrain::app
