// SPDX-License-Identifier: GPL-2.0-or-later
// docs/theory.md, E.6: strip footing on cohesive ground, N_c = 2 + pi (Prandtl).
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "fem/material/elastoplastic.hpp"
#include "fem/material/local_material.hpp"
#include "fem/mesh/rectangle.hpp"
#include "fem/solver/solver.hpp"

using namespace polargrain;
using namespace polargrain::fem;

namespace {

/// Half the footing has width b = 1, cohesion is 1. @param division elements over b.
/// @return bearing pressure over cohesion after a settlement of 0.06 b.
double bearing_capacity_factor(int division, double internal_length, const std::string& element) {
  ElastoplasticParameters<2> parameters;
  parameters.elastic = {1000.0, 0.3, 1000.0 / 2.6, internal_length, Vector7::Zero()};
  parameters.cone = {0.0, 0.0, std::sqrt(3.0)};
  Problem<2> problem;
  problem.mesh = rectangle({{5.0, 3.0}, {5 * division, 3 * division}}, element);
  for (const int node : problem.mesh.nodes_on("top")) {
    if (problem.mesh.nodes[static_cast<std::size_t>(node)](0) < 1 + 1e-9) {
      problem.mesh.node_sets["footing"].push_back(node);
    }
  }
  problem.materials["all"] =
      std::make_shared<LocalMaterial<ElastoplasticLaw<2>>>(ElastoplasticLaw<2>(parameters));
  const TimeTable zero = TimeTable::constant(0.0);
  problem.prescribed = {{"left", Dof::u1, zero, {}},   {"left", Dof::w, zero, {}},
                        {"bottom", Dof::u1, zero, {}}, {"bottom", Dof::u2, zero, {}},
                        {"right", Dof::u1, zero, {}},  {"footing", Dof::u2, TimeTable::ramp(-0.06), {}}};
  Solver<2> solver(std::move(problem), {});
  EXPECT_TRUE(solver.equilibrate().converged);
  for (int step = 1; step <= 20; ++step) {
    const StepReport report = solver.advance(step / 20.0);
    EXPECT_TRUE(report.converged) << report.message;
  }
  return -solver.reaction("footing")(1);
}

TEST(footing, tends_to_the_classical_capacity_from_above) {
  constexpr double kPrandtl = 2 + M_PI;
  const std::vector<double> references{5.601, 5.428, 5.310};
  double before = 0.0;
  int division = 2;
  for (const double reference : references) {
    const double factor = bearing_capacity_factor(division, 0.001, "Q8R");
    const double error = factor / kPrandtl - 1;
    std::cout << "[figure] E.6 h = b/" << division << ": N_c " << factor << ", reference " << reference
              << ", above Prandtl by " << error << '\n';
    EXPECT_NEAR(factor, reference, 1e-3) << division;  // the reference has 4 digits
    if (before > 0) {
      EXPECT_LT(error / before, 0.65);
    }
    before = error;
    division *= 2;
  }
  EXPECT_LT(before, 0.035);
}

TEST(footing, an_internal_length_strengthens_the_ground) {
  const double factor = bearing_capacity_factor(4, 0.05, "Q8R");
  std::cout << "[figure] E.6 h = b/4, lc = 0.05 b: N_c " << factor << ", reference 5.608\n";
  EXPECT_NEAR(factor, 5.608, 1e-3);
}

}  // namespace
