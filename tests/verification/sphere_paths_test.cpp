// SPDX-License-Identifier: GPL-2.0-or-later
// Packings of spheres along strain paths, against the stresses an independent DEM code (YADE 2023.02a) gives for them.
// Same packings, same contact laws, another engine, another integration of box and springs.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>

#include "dem/cell/cell_service.hpp"
#include "tests/support/sphere_cells.hpp"

namespace polargrain::dem {
namespace {

struct Paths {
  std::string name;
  std::function<CellDefinition()> cell;
  std::string file;
  std::string path;
  int rows = 0;           ///< followed
  double parts = 4000.0;  ///< the box of the reference goes by (I + L / parts)^parts a row
  double inertial_number = 0.0;
  double tolerance = 0.0;  ///< of the stress, over its largest component
};
void PrintTo(const Paths& paths, std::ostream* out) {
  *out << paths.name;
}

/// (I + L / parts)^parts - I
Eigen::Matrix3d row_gradient(const Eigen::Matrix3d& l, double parts) {
  const Eigen::Matrix3d part = Eigen::Matrix3d::Identity() + l / parts;
  Eigen::Matrix3d whole = Eigen::Matrix3d::Identity();
  for (int k = 0; k < static_cast<int>(parts); ++k) whole = part * whole;
  return whole - Eigen::Matrix3d::Identity();
}

class SpherePaths : public testing::TestWithParam<Paths> {};

TEST_P(SpherePaths, FollowTheIndependentCode) {
  const Paths& asked = GetParam();
  CellDefinition definition = asked.cell();
  definition.control.tangent = CellTangent::none;
  definition.control.inertial_number = asked.inertial_number;
  definition.control.unbalanced_force_ratio = definition.control.unbalanced_moment_ratio = 2e-3;
  const std::unique_ptr<CellOfGrains> cell = make_cell_service(definition);
  StatePointer state;
  double worst = 0.0;
  std::int64_t steps = 0;
  for (const test::SpacePathRow& row : test::space_paths(asked.file)) {
    if (row.path != asked.path || row.row > asked.rows) continue;
    CellReply reply;
    if (row.row == 0) {
      reply = cell->initial();
      // Nothing has moved: only the reference's printed digits limit the comparison.
      EXPECT_LT((reply.response.stress - row.stress).cwiseAbs().maxCoeff(), 1.0);
    } else {
      CellRequest request;
      request.state = state;
      request.increment.displacement_gradient = row_gradient(row.gradient, asked.parts);
      reply = cell->evaluate(request);
    }
    ASSERT_EQ(reply.response.quality, Quality::good) << reply.response.message;
    state = reply.state;
    steps += reply.diagnostics.dem_steps;
    const double error =
        (reply.response.stress - row.stress).cwiseAbs().maxCoeff() / row.stress.cwiseAbs().maxCoeff();
    worst = std::max(worst, error);
  }
  std::printf("[figure] %s: largest error of a component %.3f %% of the largest one; %lld DEM steps\n",
              asked.name.c_str(), 100.0 * worst, static_cast<long long>(steps));
  EXPECT_LT(worst, asked.tolerance);
}

INSTANTIATE_TEST_SUITE_P(
    Reference, SpherePaths,
    testing::Values(Paths{"linear_fine_triaxial", test::linear_spheres, "tests/data/fine1000.csv",
                          "triax_iso", 20, 4000.0, 5e-5, 2e-3},
                    Paths{"linear_fine_shear", test::linear_spheres, "tests/data/fine1000.csv", "shear13", 20,
                          4000.0, 5e-5, 2e-3},
                    Paths{"hertz_fine_triaxial", test::hertz_spheres, "tests/data/fine500_hertz.csv",
                          "triax_iso", 20, 4000.0, 5e-5, 5e-3},
                    // Two runs of the independent code itself differ by 0.2 % here.
                    Paths{"linear_triaxial", test::linear_spheres, "tests/data/paths1000.csv", "triax_iso", 2,
                          4000.0, 5e-5, 5e-3},
                    Paths{"linear_shear", test::linear_spheres, "tests/data/paths1000.csv", "shear13", 2,
                          4000.0, 5e-5, 5e-3},
                    Paths{"hertz_triaxial", test::hertz_spheres, "tests/data/paths500_hertz.csv", "triax_iso",
                          2, 4000.0, 5e-5, 5e-3},
                    // Chaos by now: two runs of the independent code itself differ by 2 %.
                    Paths{"linear_far", test::linear_spheres, "tests/data/paths1000.csv", "triax_iso", 20,
                          4000.0, 2e-4, 3e-2},
                    Paths{"linear_spin", test::linear_spheres, "tests/data/paths1000.csv", "triax_rot", 20,
                          4000.0, 2e-4, 3e-2},
                    Paths{"hertz_far", test::hertz_spheres, "tests/data/paths500_hertz.csv", "triax_iso", 20,
                          4000.0, 2e-4, 3e-2}),
    [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace polargrain::dem
