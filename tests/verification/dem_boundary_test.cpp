// SPDX-License-Identifier: GPL-2.0-or-later
// Why cells do not prescribe a boundary layer: on the hexagonal lattice, whose moduli are known, the Cosserat
// moduli of such a cell follow its size (docs/theory/grains.md, C.5), where those of mode 2 are exact
// (dem_lattice_test).
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "tests/support/boundary_cell.hpp"
#include "tests/support/lattice_fixture.hpp"
#include "tests/support/plane_cells.hpp"

namespace polargrain::dem {
namespace {

struct Moduli {
  double shear_without_rotation;  ///< s_12 per u_2,1 at w = 0, over kn
  double cosserat;                ///< Gc over the exact one
  double couple;                  ///< couple modulus over the exact one
};

Moduli moduli(int size) {
  const PlaneCell boundary(make_boundary_cell_service(test::lattice(size, size, CellRotations::free)));
  const PlaneCell* const cell = &boundary;
  const Vector7 start = cell->initial().response.stress;
  const auto change = [&](const Increment<2>& increment) {
    PlaneRequest request;
    request.increment = increment;
    const PlaneReply reply = cell->evaluate(request);
    EXPECT_EQ(reply.response.quality, Quality::good) << reply.response.message;
    return Vector7(reply.response.stress - start);
  };
  constexpr double kStrain = 1e-5;
  Increment<2> shear;
  shear.displacement_gradient(1, 0) = kStrain;
  Increment<2> bend;
  bend.curvature << 1e-4, 0.0;
  const double cosserat = std::sqrt(3.0) / 2.0 * test::kTangential / test::kThickness;
  const double couple = std::sqrt(3.0) * test::kRolling / test::kThickness;
  const Vector7 sheared = change(shear);
  return {sheared(k12) / kStrain * test::kThickness / test::kNormal,
          (sheared(k12) - sheared(k21)) / (2.0 * kStrain * cosserat),
          change(bend)(kCurvature1) / 1e-4 / couple};
}

TEST(BoundaryCell, CosseratModuliFollowItsSize) {
  // Gc and couple modulus over the exact ones and s_12 that C.5 tabulates for such lattices of N x N discs.
  struct Row {
    int size;
    Moduli published;
  };
  std::printf(
      "[figure] boundary layer, lattice of N x N: s_12 per u_2,1 at w = 0, Gc and couple modulus over the "
      "exact ones (published)\n");
  for (const auto& [size, published] : {Row{6, {0.768, 0.373, 56.0}}, Row{8, {0.721, 0.271, 80.0}},
                                        Row{12, {0.679, 0.175, 129.0}}, Row{16, {0.660, 0.129, 178.0}}}) {
    const Moduli found = moduli(size);
    std::printf("[figure] N = %2d: %.3f (%.3f), %.3f (%.3f), %.1f (%.0f)\n", size,
                found.shear_without_rotation, published.shear_without_rotation, found.cosserat,
                published.cosserat, found.couple, published.couple);
    // The published ones do not tell their volume; rows are half a diameter apart at the sides.
    constexpr double tolerance = 0.03;
    EXPECT_NEAR(found.shear_without_rotation / published.shear_without_rotation, 1.0, tolerance);
    EXPECT_NEAR(found.cosserat / published.cosserat, 1.0, tolerance);
    EXPECT_NEAR(found.couple / published.couple, 1.0, tolerance);
  }
}

}  // namespace
}  // namespace polargrain::dem
