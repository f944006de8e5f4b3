// SPDX-License-Identifier: GPL-2.0-or-later
// Biaxial compression where it hurts: each case runs to its end or stops and says why, and never calls
// balanced what is not. Perfectly plastic homogeneous blocks end at the Mohr-Coulomb stress, which is the
// reference here.
#include "tests/verification/fem_block.hpp"

using namespace polargrain;
using namespace polargrain::fem;

namespace {

class HardCase : public ::testing::TestWithParam<Block> {};

TEST_P(HardCase, ends_or_says_why) {
  check_block(GetParam());
}

std::vector<Block> blocks() {
  return {
      {.name = "reference"},
      {.name = "strongly distorted mesh", .distortion = 0.35},
      {.name = "strongly distorted mesh, rough platens",
       .rough = true,
       .distortion = 0.35,
       .has_reference = false},
      {.name = "Poisson's ratio 0.499", .poisson_ratio = 0.499},
      {.name = "Poisson's ratio 0.499, rough platens, Q4",
       .element = "Q4",
       .poisson_ratio = 0.499,
       .rough = true,
       .has_reference = false},
      {.name = "no cohesion", .cohesion = 0},
      {.name = "no confinement", .confining = 0},
      {.name = "neither confinement nor cohesion", .confining = 0, .cohesion = 0, .has_reference = false},
      {.name = "extension", .strains = {0.03}},
      {.name = "tension without confinement", .confining = 0, .strains = {0.01}, .has_reference = false},
      {.name = "contraction", .dilatancy = -10},
      {.name = "softening too steep for the mesh",
       .softened_friction = 25,
       .softening_range = 2e-3,
       .rough = true,
       .has_reference = false},
      {.name = "Gc = 1e-6 G", .cosserat_modulus = 15},
      {.name = "Gc = 1e4 G", .cosserat_modulus = 1.5e11},
      {.name = "Gc = 1e4 G, rough platens",
       .cosserat_modulus = 1.5e11,
       .rough = true,
       .has_reference = false},
      {.name = "lc = 0", .internal_length = 0},
      {.name = "lc of 1 m, rough platens", .internal_length = 1, .rough = true, .has_reference = false},
      {.name = "load reversals", .strains = {-0.02, 0.0, -0.03, 0.04}},
      {.name = "one element", .elements = {1, 1}},
      {.name = "one triangle pair", .element = "T6", .elements = {1, 1}},
      {.name = "1,152 elements", .elements = {24, 48}},
  };
}

INSTANTIATE_TEST_SUITE_P(Blocks, HardCase, ::testing::ValuesIn(blocks()));

TEST(hard_cases, dilatancy_above_friction_is_refused) {
  Block block;
  block.friction = 30;
  block.dilatancy = 40;
  try {
    (void)problem_of(block);
    FAIL();
  } catch (const RunError& error) {
    std::cout << "[figure] dilatancy above friction: refused, " << error.what() << '\n';
    EXPECT_NE(std::string(error.what()).find("lower the dilatancy"), std::string::npos);
  }
}

TEST(hard_cases, a_rotation_without_any_stiffness_is_refused) {
  // Gc = 0: nothing holds a uniform micro-rotation.
  Block block{.name = "Gc = 0"};
  block.cosserat_modulus = 0;
  Solver<2> solver(problem_of(block), {});
  const StepReport report = solver.equilibrate();
  std::cout << "[figure] Gc = 0: refused, " << report.message << '\n';
  EXPECT_FALSE(report.converged);
  EXPECT_NE(report.message.find("nothing resists the micro-rotation"), std::string::npos);
}

TEST(hard_cases, no_cosserat_modulus_with_one_rotation_held_is_the_classical_block) {
  Block block{.name = "Gc = 0, one micro-rotation held"};
  block.cosserat_modulus = 0;
  Problem<2> problem = problem_of(block);
  problem.prescribed.push_back({"bottom_left", Dof::w, TimeTable::constant(0.0), {}});
  Solver<2> solver(std::move(problem), {});
  ASSERT_TRUE(solver.equilibrate().converged);
  int iterations = 0;
  for (int step = 1; step <= 10; ++step) {
    const StepReport report = solver.advance(step / 10.0);
    ASSERT_TRUE(report.converged) << report.message;
    iterations += report.iterations;
  }
  const double error = solver.reaction("top")(1) / 0.04 / mohr_coulomb(block) - 1;
  std::cout << "[figure] " << block.name << ": relative error of the stress " << error << ", iterations "
            << iterations << '\n';
  EXPECT_LT(std::abs(error), 1e-3);
}

TEST(hard_cases, a_block_held_at_one_node_only_by_its_micro_rotation) {
  Block block;
  Problem<2> problem = problem_of(block);
  const TimeTable zero = TimeTable::constant(0.0);
  problem.prescribed = {{"bottom_left", Dof::u1, zero, {}},
                        {"bottom_left", Dof::u2, zero, {}},
                        {"bottom_left", Dof::w, zero, {}}};
  for (const char* side : {"bottom", "top"}) {
    problem.boundary_loads.push_back({.on = side, .pressure = TimeTable({{0.0, 100e3}, {1.0, 250e3}})});
  }
  Solver<2> solver(std::move(problem), {});
  ASSERT_TRUE(solver.equilibrate().converged);
  const StepReport report = solver.advance(1.0);
  ASSERT_TRUE(report.converged) << report.message;
  double error = 0.0;
  for (const Response<2>& response : solver.state().responses) {
    error = std::max(error, std::abs(response.stress(k22) / -250e3 - 1));
  }
  std::cout << "[figure] held at one node: relative error of the stress " << error << ", iterations "
            << report.iterations << '\n';
  EXPECT_LT(error, 1e-6);
}

}  // namespace
