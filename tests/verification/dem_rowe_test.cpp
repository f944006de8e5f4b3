// SPDX-License-Identifier: GPL-2.0-or-later
// Rowe's packing (docs/theory/grains.md, E.7 c): hexagonal rows of nearly rigid discs compressed across the
// rows, with open contacts within a row. sigma_22 / sigma_11 = tan(beta) tan(beta + phi_mu), sin(beta) =
// sin(60)(1 + eps_22).
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "tests/support/lattice_fixture.hpp"
#include "tests/support/plane_cells.hpp"

namespace polargrain::dem {
namespace {

constexpr int kColumnsOfRowe = 4;
constexpr int kRows = 4;

/// The box when contacts of branch length `branch` stand at the angle beta.
Eigen::Matrix2d box(double branch, double beta) {
  Eigen::Matrix2d base;
  base << kColumnsOfRowe * 2.0 * branch * std::cos(beta), 0.0, 0.0, kRows * branch * std::sin(beta);
  return base;
}

class Rowe : public ::testing::TestWithParam<double> {};

TEST_P(Rowe, StressRatioFollowsTheContactAngle) {
  const double friction = GetParam();
  const double angle_of_friction = std::atan(friction);
  // k_n over the pressure is 1e4: the discs are rigid for what is measured.
  const double branch = test::kDiameter * (1.0 - 1e-4);
  const auto contact_angle = [](double strain) {
    return std::asin(std::sin(std::numbers::pi / 3.0) * (1.0 + strain));
  };
  CellDefinition definition = test::lattice(kColumnsOfRowe, kRows, CellRotations::free);
  const std::string property = "coefficientFriction peratomtypepair 1 1e3";
  const auto place = definition.script.find(property);
  ASSERT_NE(place, std::string::npos);
  definition.script.replace(place, property.size(),
                            "coefficientFriction peratomtypepair 1 " + std::to_string(friction));
  // Compressed by 0.2 % already, so that the contacts within a row are open.
  double strain = -0.002;
  Eigen::Matrix2d now = box(branch, contact_angle(strain));
  const Eigen::Matrix2d scale = now * definition.packing.box.inverse();
  for (Grain& grain : definition.packing.grains) grain.position = scale * grain.position;
  definition.packing.box = now;
  definition.control = {};
  definition.control.inertial_number = 1.2e-2;
  const auto cell = make_plane_cell(definition);
  StatePointer state;
  double largest = 0.0;
  for (int step = 1; step <= 48; ++step) {
    strain -= 0.001;
    const Eigen::Matrix2d next = box(branch, contact_angle(strain));
    PlaneRequest request;
    request.state = state;
    // Keeps the oblique contacts at their length; the discs can only slide.
    request.increment.displacement_gradient = next * now.inverse() - Eigen::Matrix2d::Identity();
    const PlaneReply reply = cell->evaluate(request);
    ASSERT_EQ(reply.response.quality, Quality::good) << reply.response.message;
    state = reply.state;
    now = next;
    const double beta = contact_angle(strain);
    const double ratio = reply.response.stress(k22) / reply.response.stress(k11);
    if (strain > -0.0055) continue;  // until sliding has set in everywhere
    largest =
        std::max(largest, std::abs(ratio / (std::tan(beta) * std::tan(beta + angle_of_friction)) - 1.0));
    for (const double printed : {0.01, 0.02, 0.05})
      if (std::abs(strain + printed) < 1e-6)
        std::printf("[figure] Rowe, mu %.1f, eps_22 %.0f %%: stress ratio %.4f\n", friction, 100.0 * strain,
                    ratio);
  }
  std::printf("[figure] Rowe, mu %.1f: stress ratio within %.2e of the closed form\n", friction, largest);
  EXPECT_LT(largest, 0.02);
}

INSTANTIATE_TEST_SUITE_P(Friction, Rowe, ::testing::Values(0.2, 0.3));

}  // namespace
}  // namespace polargrain::dem
