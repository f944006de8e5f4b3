// SPDX-License-Identifier: GPL-2.0-or-later
// Packings of grains that fell: cut out of a bed without overlaps, with contacts along the fall, at rest without lateral
// strain, turned with their bedding planes; settled under the stresses they have.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "dem/pack/deposit.hpp"
#include "dem/pack/prepare.hpp"
#include "tests/support/packings_to_make.hpp"

namespace polargrain::dem {
namespace {

PackingSpecification fallen(int dimension, int grains) {
  PackingSpecification made = dimension == 3 ? rolling_spheres(grains, 0.5) : specification(grains, 0.5);
  made.deposition = Deposition{};
  made.seed = 1;
  return made;
}

/// Twelve rows of five equal discs on a square lattice, their lowest on the floor.
Packing lattice_bed() {
  Packing bed;
  bed.thickness = 1.0;
  bed.box << 5.0, 0.0, 0.0, 20.0;
  for (int row = 0; row < 12; ++row)
    for (int column = 0; column < 5; ++column) {
      Grain grain;
      grain.id = static_cast<std::int64_t>(bed.grains.size());
      grain.radius = 0.5;
      grain.mass = 1.0;
      grain.position << column + 0.1, row + 0.5;
      bed.grains.push_back(grain);
    }
  return bed;
}

TEST(PackDeposit, TheSeamOfABedIsCloseAndWithoutOverlaps) {
  const Packing cut = cut_from_bed(lattice_bed(), 15, 25);
  ASSERT_EQ(cut.grains.size(), 25u);
  // Rows that stand on each other are a diameter apart; at the seam they may lie in each other's gaps, sqrt(3) / 2. The best
  // of the shifts tried comes to within some hundredths.
  EXPECT_LT(cut.box(1, 1), 4.9);
  EXPECT_GE(cut.box(1, 1), 4.0 + std::sqrt(0.75) - 1e-12);
  double closest = 1e300;
  for (const Grain& one : cut.grains)
    for (const Grain& other : cut.grains)
      for (int image = 0; image < 9; ++image) {
        const Eigen::Vector2d shift = cut.box * Eigen::Vector2d(image % 3 - 1, image / 3 - 1);
        const double apart = (other.position + shift - one.position).norm();
        if (apart > 0.0) closest = std::min(closest, apart);
      }
  EXPECT_GE(closest, 1.0 - 1e-12);
}

TEST(PackDeposit, TheWidthKeptGivesTheStressesAtRest) {
  PackingSpecification asked = fallen(3, 200);
  asked.deposition->keeps_width = true;
  const PreparedPacking made = prepare_packing(asked, {});
  const Eigen::Matrix3d stress = tensor(made.reached.stress);
  const double at_rest = 0.5 * (stress(0, 0) + stress(2, 2)) / stress(1, 1);
  std::printf("[figure] 200 spheres that fell, friction 0.5, no lateral strain: K0 %.3f\n", at_rest);
  EXPECT_NEAR(stress(1, 1) / -asked.pressure, 1.0, asked.pressure_tolerance);
  // Jaky's 1 - sin(phi) is 0.4 to 0.6 for sands of 24 to 37 degrees.
  EXPECT_GT(at_rest, 0.35);
  EXPECT_LT(at_rest, 0.75);

  // Contacts lie along the fall. Isotropic: 1/3 each, with a scatter of 0.016 (some 350 contacts).
  const Eigen::Matrix3d fabric = tensor(made.reached.fabric);
  std::printf("[figure] its fabric %.3f %.3f %.3f\n", fabric(0, 0), fabric(1, 1), fabric(2, 2));
  EXPECT_NEAR(fabric.trace(), 1.0, 1e-12);
  EXPECT_GT(fabric(1, 1), 1.0 / 3.0 + 0.016);

  // Settled, it keeps them; told a pressure, it is brought to that.
  PackingSpecification again = asked;
  again.pressure = made.reached.pressure;
  again.keeps_stresses = true;
  const Eigen::Matrix3d settled = tensor(settle_packing(again, made, {}).reached.stress);
  EXPECT_LE((settled - stress).cwiseAbs().maxCoeff(), 2e-3 * asked.pressure);
  again.keeps_stresses = false;
  EXPECT_LE(settle_packing(again, made, {}).reached.anisotropy, again.pressure_tolerance);
}

TEST(PackDeposit, TheBeddingAngleTurnsAll) {
  constexpr double kAngle = 0.5;
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  turn.topLeftCorner<2, 2>() << std::cos(kAngle), -std::sin(kAngle), std::sin(kAngle), std::cos(kAngle);
  for (const int dimension : {2, 3}) {
    PackingSpecification asked = fallen(dimension, 60);
    asked.deposition->keeps_width = true;
    const PreparedPacking level = prepare_packing(asked, {});
    asked.deposition->bedding_angle = kAngle;
    const PreparedPacking turned = prepare_packing(asked, {});
    const Eigen::Matrix2d in_plane = turn.topLeftCorner<2, 2>();
    EXPECT_LE((turned.packing.box - in_plane * level.packing.box).norm(), 1e-14);
    for (std::size_t k = 0; k < level.packing.grains.size(); ++k)
      EXPECT_LE((turned.packing.grains[k].position - in_plane * level.packing.grains[k].position).norm(),
                1e-14);
    const Eigen::Matrix3d fabric = turn * tensor(level.reached.fabric) * turn.transpose();
    EXPECT_LE((tensor(turned.reached.fabric) - fabric).norm(), 1e-12);
    // The stress that cells find in them, tangential forces included: a right box against a leaning one.
    const Eigen::Matrix3d expected = turn * stress_in_a_cell(asked, level) * turn.transpose();
    EXPECT_LE((stress_in_a_cell(asked, turned) - expected).cwiseAbs().maxCoeff(), 1e-6 * asked.pressure)
        << dimension;
  }
}

}  // namespace
}  // namespace polargrain::dem
