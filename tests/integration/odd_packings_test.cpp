// SPDX-License-Identifier: GPL-2.0-or-later
// Packings that are none: refused in words or answered, in time, under both controls of the rotations and in
// both loops over grains.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <numbers>
#include <string>
#include <tuple>
#include <vector>

#include "tests/integration/command.hpp"

namespace polargrain::testing {
namespace {

const std::string kSource = POLARGRAIN_SOURCE_DIRECTORY;
constexpr double kRadius = 0.005;  // m

struct Place {
  double x, y;
};

std::string digits(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.17g", value);
  return text.data();
}

/// A packing of equal discs.
std::string packing(double side_x, double side_y, const std::vector<Place>& places) {
  std::string text =
      "# cell xx=" + digits(side_x) + " xy=0 yx=0 yy=" + digits(side_y) + " z=0.1\nid,x,y,r,mass,Izz\n";
  const double mass = 2650.0 * std::numbers::pi * kRadius * kRadius * 0.1;
  for (std::size_t k = 0; k < places.size(); ++k)
    text += std::to_string(k) + "," + digits(places[k].x) + "," + digits(places[k].y) + "," +
            digits(kRadius) + "," + digits(mass) + "," + digits(0.5 * mass * kRadius * kRadius) + "\n";
  return text;
}

/// Rows and columns of discs, centre to centre at `spacing`.
std::string square(int side, double spacing) {
  std::vector<Place> places;
  for (int row = 0; row < side; ++row)
    for (int column = 0; column < side; ++column)
      places.push_back({(column + 0.5) * spacing, (row + 0.5) * spacing});
  return packing(side * spacing, side * spacing, places);
}

struct Odd {
  const char* name;
  std::string packing;
  const char* refusal;  ///< null: it is answered, or fails in words
};

std::vector<Odd> odd_packings() {
  return {
      {"SixtyFourAtOnePoint", packing(0.08, 0.08, std::vector<Place>(64, {0.04, 0.04})),
       "overlap by 200 % of the smaller radius, as if they were in one place"},
      {"TwoAtOnePoint", packing(0.05, 0.05, {{0.01, 0.01}, {0.01, 0.01}}), "as if they were in one place"},
      {"TouchingWithZeroOverlap", square(8, 2.0 * kRadius), "touch"},
      {"TouchingByALittle", square(8, 2.0 * kRadius * (1.0 - 1e-13)), "touch"},
      {"FarApart", square(8, 3.0 * kRadius), "its grains do not touch"},
      {"TwoGrains", packing(0.03, 0.03, {{0.01, 0.015}, {0.01 + 1.99 * kRadius, 0.015}}), nullptr},
      {"TwoGrainsInARow", packing(3.98 * kRadius, 0.03, {{kRadius, 0.015}, {2.99 * kRadius, 0.015}}),
       nullptr},
      {"OneGrain", packing(1.99 * kRadius, 1.99 * kRadius, {{kRadius, kRadius}}), nullptr},
  };
}

class OddPackings : public ::testing::TestWithParam<std::tuple<std::size_t, const char*, const char*>> {};

TEST_P(OddPackings, AreRefusedOrAnsweredInTime) {
  const Odd odd = odd_packings()[std::get<0>(GetParam())];
  const std::string rotations = std::get<1>(GetParam());
  const Scratch scratch("odd_" + std::string(odd.name) + rotations + std::get<2>(GetParam()));
  write(scratch.path() / "packing.csv", odd.packing);
  write(scratch.path() / "path.csv", "h11,h12,h21,h22,w,k1,k2\n0,0,0,-1e-4,0,0,0\n1e-5,0,0,-1e-4,0,0,0\n");
  write(scratch.path() / "case.yaml",
        "title: Odd\nmesh: {rectangle: {size: [0.1 m, 0.1 m], elements: [1, 1]}}\n"
        "materials:\n  sand: {model: cell, script: " +
            kSource + "/liggghts_inputs/cells/hooke_radii.in, packing: packing.csv, loop: " +
            std::get<2>(GetParam()) + ", " +
            (rotations == "controlled" ? "rotations: controlled" : "G: 16 MPa, Gc: 14 MPa, lc: 20 mm") +
            "}\nregions: {all: sand}\nboundary:\n  - {on: bottom, fix: [u1, u2]}\n"
            "  - {on: top, move: {u2: -1 mm}}\nsteps: {count: 1}\n");
  const Outcome outcome = run_in(scratch.path(), "timeout 1000 " POLARGRAIN " point case.yaml sand path.csv");
  // Status 2: the case is refused; 1: in words of the engine or of the cell; 124 is that of timeout.
  EXPECT_TRUE(outcome.status == 0 || outcome.status == 1 || outcome.status == 2) << outcome.status << '\n'
                                                                                 << outcome.errors;
  for (const char* end : {"killed by signal", "it hangs"})
    EXPECT_EQ(outcome.errors.find(end), std::string::npos) << outcome.errors;
  if (odd.refusal == nullptr) return;
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.errors.find(odd.refusal), std::string::npos) << outcome.errors;
}

INSTANTIATE_TEST_SUITE_P(All, OddPackings,
                         ::testing::Combine(::testing::Range(std::size_t{0}, odd_packings().size()),
                                            ::testing::Values("free", "controlled"),
                                            ::testing::Values("automatic", "engine")),
                         [](const auto& each) {
                           return odd_packings()[std::get<0>(each.param)].name + std::string("_") +
                                  std::get<1>(each.param) + "_" + std::get<2>(each.param);
                         });

}  // namespace
}  // namespace polargrain::testing
