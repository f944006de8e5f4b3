// SPDX-License-Identifier: GPL-2.0-or-later
// The membrane of grain specimens: which grains it rests on, and that its forces are those of a pressure.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <set>

#include "dem/specimen/membrane_chain.hpp"

namespace {

using namespace polargrain::dem;
using Eigen::Vector2d;

constexpr double kRadius = 0.005;

/// Rows of touching equal discs, each above the gaps of the one below; even rows have `columns`, odd ones one
/// less.
std::vector<Disc> hexagonal(int columns, int rows) {
  std::vector<Disc> discs;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns - row % 2; ++column)
      discs.push_back(
          {{kRadius * (2 * column + 1 + row % 2), kRadius * (1.0 + std::sqrt(3.0) * row)}, kRadius});
  return discs;
}

double height(int rows) {
  return kRadius * (2.0 + std::sqrt(3.0) * (rows - 1));
}

std::vector<Vector2d> centres(const std::vector<Disc>& discs, const std::vector<std::size_t>& chain) {
  std::vector<Vector2d> places;
  for (const std::size_t k : chain) places.push_back(discs[k].centre);
  return places;
}

/// Discs of two radii at random in a rectangle, no two overlapping, dense enough that the probe stays
/// outside.
std::vector<Disc> random_discs() {
  std::mt19937 random(10007);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<Disc> discs;
  for (int trial = 0; trial < 60000; ++trial) {
    const Disc disc{{0.1 * unit(random), 0.2 * unit(random)}, trial % 2 == 0 ? 0.003 : 0.005};
    const bool is_free = std::none_of(discs.begin(), discs.end(), [&](const Disc& other) {
      return (disc.centre - other.centre).norm() < disc.radius + other.radius;
    });
    if (is_free) discs.push_back(disc);
  }
  return discs;
}

TEST(Membrane, RestsOnTheOuterGrainsOfALattice) {
  const std::vector<Disc> discs = hexagonal(6, 7);
  // Discs of radius r, those of odd rows set back by r: a probe of radius R on two outer discs, 2 sqrt(3) r
  // apart, meets the disc between them when (r + R)^2 - 3 r^2 < R^2, that is R < r.
  const auto left = membrane_chain(discs, 0.99 * kRadius, 0.0, height(7), Side::left);
  ASSERT_EQ(left.size(), 7U);
  for (std::size_t row = 0; row < 7; ++row)
    EXPECT_NEAR(discs[left[row]].centre.x(), kRadius * (1.0 + static_cast<double>(row % 2)), 1e-15);
  const auto right = membrane_chain(discs, 0.99 * kRadius, 0.0, height(7), Side::right);
  ASSERT_EQ(right.size(), 7U);
  for (std::size_t row = 0; row < 7; ++row)
    EXPECT_NEAR(discs[right[row]].centre.x(), kRadius * (11.0 - static_cast<double>(row % 2)), 1e-15);
}

TEST(Membrane, AStiffOneBridgesTheGaps) {
  // R > r: the probe does not come to the discs that are set back.
  const std::vector<Disc> discs = hexagonal(6, 7);
  const auto left = membrane_chain(discs, 1.01 * kRadius, 0.0, height(7), Side::left);
  ASSERT_EQ(left.size(), 4U);
  for (const std::size_t k : left) EXPECT_NEAR(discs[k].centre.x(), kRadius, 1e-15);
}

TEST(Membrane, LeavesNoGrainOutside) {
  const std::vector<Disc> discs = random_discs();
  const double probe = 0.01;
  for (const Side side : {Side::left, Side::right}) {
    const auto chain = membrane_chain(discs, probe, 0.0, 0.2, side);
    EXPECT_EQ(std::set<std::size_t>(chain.begin(), chain.end()).size(), chain.size());
    const std::vector<Vector2d> line = centres(discs, chain);
    const double outwards = side == Side::left ? -1.0 : 1.0;
    // Where the line passes at a grain's height, no grain is farther out than the line by a grain's radius.
    for (const Disc& disc : discs)
      for (std::size_t k = 1; k < line.size(); ++k) {
        const double low = line[k - 1].y();
        const double high = line[k].y();
        if (disc.centre.y() < low || disc.centre.y() > high) continue;
        const double share = (disc.centre.y() - low) / (high - low);
        const double x = line[k - 1].x() + share * (line[k].x() - line[k - 1].x());
        EXPECT_LE(outwards * (disc.centre.x() - x), 1e-12);
      }
  }
}

TEST(Membrane, ForcesAddUpToThePressureOnTheHeight) {
  const std::vector<Disc> discs = random_discs();
  const double line_pressure = 1e4;
  for (const Side side : {Side::left, Side::right}) {
    const auto line = centres(discs, membrane_chain(discs, 0.01, 0.0, 0.2, side));
    Vector2d sum = Vector2d::Zero();
    double moment = 0.0;
    const auto forces = membrane_forces(line, line_pressure, 0.0, 0.2, side);
    for (std::size_t k = 0; k < line.size(); ++k) {
      sum += forces[k];
      moment += line[k].x() * forces[k].y() - line[k].y() * forces[k].x();
    }
    const double inwards = side == Side::left ? 1.0 : -1.0;
    // Exact but for round-off of sums of forces of some tens of newtons.
    EXPECT_NEAR(sum.x(), inwards * line_pressure * 0.2, 1e-9);
    EXPECT_NEAR(sum.y(), -inwards * line_pressure * (line.back().x() - line.front().x()), 1e-9);
    // Pressure on a curve between (x0, y0) and (x1, y1): moment -p (x1^2 - x0^2 + y1^2 - y0^2) / 2 about the
    // origin. The straight ends go from the platens to the outer centres and push at these.
    const Vector2d first = line.front();
    const Vector2d last = line.back();
    const double ends = -first.y() * first.y() - last.y() * (0.2 - last.y());
    const double middle = -0.5 * (last.squaredNorm() - first.squaredNorm());
    EXPECT_NEAR(moment, inwards * line_pressure * (middle + ends), 1e-9);
  }
}

TEST(Membrane, ItsWorkIsThePressureTimesTheChangeOfArea) {
  // The area's derivative by a chain grain is the force on it over the pressure, with the opposite sign.
  const std::vector<Disc> discs = random_discs();
  const auto left = centres(discs, membrane_chain(discs, 0.01, 0.0, 0.2, Side::left));
  auto right = centres(discs, membrane_chain(discs, 0.01, 0.0, 0.2, Side::right));
  const auto forces = membrane_forces(right, 1.0, 0.0, 0.2, Side::right);
  const double area = enclosed_area(left, right, 0.0, 0.2);
  EXPECT_GT(area, 0.9 * 0.1 * 0.2);
  EXPECT_LT(area, 0.1 * 0.2);
  for (std::size_t k = 0; k < right.size(); ++k)
    for (int axis = 0; axis < 2; ++axis) {
      if (axis == 1 && (k == 0 || k + 1 == right.size())) continue;  // there the straight ends are held level
      const Vector2d kept = right[k];
      right[k](axis) += 1e-3;
      // The area is linear in each coordinate.
      EXPECT_NEAR((enclosed_area(left, right, 0.0, 0.2) - area) / 1e-3, -forces[k](axis), 1e-12);
      right[k] = kept;
    }
}

TEST(Membrane, SaysWhyThereIsNoChain) {
  EXPECT_THROW(membrane_chain({{{0.0, 1.0}, 0.1}}, 0.1, 0.0, 2.0, Side::left), std::runtime_error)
      << "no grain at the bottom platen";
  EXPECT_THROW(membrane_chain({{{0.0, 0.1}, 0.1}}, 0.1, 0.0, 2.0, Side::left), std::runtime_error)
      << "one grain does not reach the top platen";
}

}  // namespace
