// SPDX-License-Identifier: GPL-2.0-or-later
// The packing of cases/biaxial along two strain paths, against the stresses an independent DEM code (YADE)
// gives for it (tests/data/paths400.csv). Same packing, same contact law, another engine, another integration
// of the box.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <sstream>

#include "tests/support/cell_fixture.hpp"
#include "tests/support/plane_cells.hpp"

namespace polargrain::dem {
namespace {

struct Row {
  std::string path;
  int increment = 0;
  Eigen::Matrix2d gradient;
  double stress_11 = 0.0;
  double stress_22 = 0.0;
};

std::vector<Row> reference_paths() {
  std::istringstream lines(test::file_text("tests/data/paths400.csv"));
  std::string line;
  std::getline(lines, line);
  std::vector<Row> rows;
  while (std::getline(lines, line)) {
    Row row;
    for (char& letter : line)
      if (letter == ',') letter = ' ';
    std::istringstream values(line);
    values >> row.path >> row.increment >> row.gradient(0, 0) >> row.gradient(0, 1) >> row.gradient(1, 0) >>
        row.gradient(1, 1) >> row.stress_11 >> row.stress_22;
    rows.push_back(row);
  }
  return rows;
}

class Paths : public ::testing::TestWithParam<std::string> {};

TEST_P(Paths, FollowTheIndependentCode) {
  const std::unique_ptr<PlaneCell> cell = make_plane_cell(test::demo_cell());
  StatePointer state;
  double worst_of_three = 0.0;
  double worst_of_ten = 0.0;
  std::int64_t steps = 0;
  for (const Row& row : reference_paths()) {
    if (row.path != GetParam() || row.increment > 10) continue;
    Response<2> response;
    if (row.increment == 0) {
      const PlaneReply reply = cell->initial();
      state = reply.state;
      response = reply.response;
      // Nothing has moved: only the reference's printed digits limit the comparison.
      EXPECT_NEAR(response.stress(k11) / row.stress_11, 1.0, 1e-5);
      EXPECT_NEAR(response.stress(k22) / row.stress_22, 1.0, 1e-5);
      continue;
    }
    PlaneRequest request;
    request.state = state;
    request.increment.displacement_gradient = row.gradient;
    const PlaneReply reply = cell->evaluate(request);
    ASSERT_EQ(reply.response.quality, Quality::good) << reply.response.message;
    EXPECT_LE(reply.diagnostics.unbalanced_force_ratio, test::demo_cell().control.unbalanced_force_ratio);
    state = reply.state;
    steps += reply.diagnostics.dem_steps;
    const double error = std::max(std::abs(reply.response.stress(k11) / row.stress_11 - 1.0),
                                  std::abs(reply.response.stress(k22) / row.stress_22 - 1.0));
    if (row.increment <= 3) worst_of_three = std::max(worst_of_three, error);
    worst_of_ten = std::max(worst_of_ten, error);
  }
  std::printf(
      "[figure] %s path: largest error of a normal stress %.2f %% in 3 increments, %.2f %% in 10; %lld DEM "
      "steps an increment\n",
      GetParam().c_str(), 100.0 * worst_of_three, 100.0 * worst_of_ten, static_cast<long long>(steps / 10));
  // The packing is the same, so the codes agree closely at first; later, small differences grow (grains are
  // chaotic).
  EXPECT_LE(worst_of_three, 0.03);
  EXPECT_LE(worst_of_ten, 0.06);
}

INSTANTIATE_TEST_SUITE_P(Reference, Paths, ::testing::Values("isochoric", "oedometric"),
                         [](const auto& instance) { return instance.param; });

}  // namespace
}  // namespace polargrain::dem
