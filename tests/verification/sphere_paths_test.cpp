// SPDX-License-Identifier: GPL-2.0-or-later
// Packings of spheres along strain paths, against the stresses an independent DEM code (YADE 2023.02a) gives for them.
// Same packings, same contact laws, another engine, another integration of box and springs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "common/csv_table.hpp"
#include "dem/cell/averages.hpp"
#include "dem/cell/cell_service.hpp"
#include "tests/support/sphere_cells.hpp"

namespace polargrain::dem {
namespace {

struct PathsOfSpherePaths {
  std::string name;
  std::function<CellDefinition()> cell;
  std::string file;
  std::string path;
  int rows = 0;           ///< followed
  double parts = 4000.0;  ///< the box of the reference goes by (I + L / parts)^parts a row
  double inertial_number = 0.0;
  double tolerance = 0.0;  ///< of the stress, over its largest component
};
void PrintTo(const PathsOfSpherePaths& paths, std::ostream* out) {
  *out << paths.name;
}

/// (I + L / parts)^parts - I
Eigen::Matrix3d row_gradient(const Eigen::Matrix3d& l, double parts) {
  const Eigen::Matrix3d part = Eigen::Matrix3d::Identity() + l / parts;
  Eigen::Matrix3d whole = Eigen::Matrix3d::Identity();
  for (int k = 0; k < static_cast<int>(parts); ++k) whole = part * whole;
  return whole - Eigen::Matrix3d::Identity();
}

class SpherePaths : public ::testing::TestWithParam<PathsOfSpherePaths> {};

TEST_P(SpherePaths, FollowTheIndependentCode) {
  const PathsOfSpherePaths& asked = GetParam();
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

/// A contact of the independent code: the force on the second sphere by the first, N.
struct ForeignContact {
  std::int64_t first = 0;
  std::int64_t second = 0;
  Eigen::Vector3d force;
};

std::vector<ForeignContact> foreign_contacts(const std::string& file) {
  const CsvTable table(file);
  std::vector<ForeignContact> contacts;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const auto number = [&](const char* name) { return table.number(row, table.column(name)); };
    contacts.push_back({static_cast<std::int64_t>(number("id1")),
                        static_cast<std::int64_t>(number("id2")),
                        {number("Fx"), number("Fy"), number("Fz")}});
  }
  return contacts;
}

TEST(SphereContacts, CarryTheForcesOfTheIndependentCode) {
  // Not averages alone: every contact at the end of the fine triaxial path, 4e-4 of strain with sliding contacts.
  CellDefinition definition = test::linear_spheres();
  definition.control.tangent = CellTangent::none;
  definition.control.inertial_number = 5e-5;
  definition.control.unbalanced_force_ratio = definition.control.unbalanced_moment_ratio = 2e-3;
  const std::unique_ptr<CellOfGrains> cell = make_cell_service(definition);
  CellRequest request;
  for (const test::SpacePathRow& row : test::space_paths("tests/data/fine1000.csv")) {
    if (row.path != "triax_iso" || row.row == 0 || row.row > 20) continue;
    request.increment.displacement_gradient = row_gradient(row.gradient, 4000.0);
    const CellReply reply = cell->evaluate(request);
    ASSERT_EQ(reply.response.quality, Quality::good) << reply.response.message;
    request.state = reply.state;
  }
  // Of two spheres there is one contact at most in a box as large as this.
  std::map<std::pair<std::int64_t, std::int64_t>, Eigen::Vector3d> found;
  for (const Contact& contact : cell->contacts()) {
    const std::int64_t first = definition.packing.grains[static_cast<std::size_t>(contact.first)].id;
    const std::int64_t second = definition.packing.grains[static_cast<std::size_t>(contact.second)].id;
    const Eigen::Vector3d on_larger = first < second ? -contact.force : contact.force;
    found[std::minmax(first, second)] = on_larger;
  }
  double sum = 0.0;
  double off = 0.0;
  double missing = 0.0;
  double worst = 0.0;
  const std::vector<ForeignContact> expected = foreign_contacts("tests/data/contacts1000.csv");
  const std::size_t here = found.size();
  for (const ForeignContact& contact : expected) {
    const Eigen::Vector3d force =
        contact.first < contact.second ? contact.force : Eigen::Vector3d(-contact.force);
    const double size = force.norm();
    sum += size;
    const auto one = found.find(std::minmax(contact.first, contact.second));
    if (one == found.end()) {
      missing += size;
      continue;
    }
    const double difference = (one->second - force).norm();
    off += difference;
    worst = std::max(worst, difference);
    found.erase(one);
  }
  double more = 0.0;
  for (const auto& [grains, force] : found) more += force.norm();
  const auto count = static_cast<double>(expected.size());
  std::printf(
      "[figure] %zu contacts, the independent code has %zu: forces %.3f %% of their sum off, largest difference %.3f "
      "of the mean force; %.2e of the sum in contacts that only one of the two has\n",
      here, expected.size(), 100.0 * off / sum, worst / (sum / count), (missing + more) / sum);
  // Two runs of that code differ by 0.05 % in the stress; forces of single contacts are the first to part.
  EXPECT_LT(off / sum, 0.01);
  EXPECT_LT(worst, 0.5 * sum / count);
  EXPECT_LT((missing + more) / sum, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(
    Reference, SpherePaths,
    ::testing::Values(PathsOfSpherePaths{"linear_fine_triaxial", test::linear_spheres,
                                         "tests/data/fine1000.csv", "triax_iso", 20, 4000.0, 5e-5, 2e-3},
                      PathsOfSpherePaths{"linear_fine_shear", test::linear_spheres, "tests/data/fine1000.csv",
                                         "shear13", 20, 4000.0, 5e-5, 2e-3},
                      PathsOfSpherePaths{"hertz_fine_triaxial", test::hertz_spheres,
                                         "tests/data/fine500_hertz.csv", "triax_iso", 20, 4000.0, 5e-5, 5e-3},
                      // Two runs of the independent code itself differ by 0.2 % here.
                      PathsOfSpherePaths{"linear_triaxial", test::linear_spheres, "tests/data/paths1000.csv",
                                         "triax_iso", 2, 4000.0, 5e-5, 5e-3},
                      PathsOfSpherePaths{"linear_shear", test::linear_spheres, "tests/data/paths1000.csv",
                                         "shear13", 2, 4000.0, 5e-5, 5e-3},
                      PathsOfSpherePaths{"hertz_triaxial", test::hertz_spheres,
                                         "tests/data/paths500_hertz.csv", "triax_iso", 2, 4000.0, 5e-5, 5e-3},
                      // Chaos by now: two runs of the independent code itself differ by 2 %.
                      PathsOfSpherePaths{"linear_far", test::linear_spheres, "tests/data/paths1000.csv",
                                         "triax_iso", 20, 4000.0, 2e-4, 3e-2},
                      PathsOfSpherePaths{"linear_spin", test::linear_spheres, "tests/data/paths1000.csv",
                                         "triax_rot", 20, 4000.0, 2e-4, 3e-2},
                      PathsOfSpherePaths{"hertz_far", test::hertz_spheres, "tests/data/paths500_hertz.csv",
                                         "triax_iso", 20, 4000.0, 2e-4, 3e-2}),
    [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace polargrain::dem
