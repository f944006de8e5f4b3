// SPDX-License-Identifier: GPL-2.0-or-later
#include <gtest/gtest.h>

#include <iostream>

#include "common/error.hpp"
#include "fem/material/cone_matching.hpp"
#include "fem/material/elastoplastic.hpp"
#include "fem/material/local_material.hpp"
#include "fem/mesh/rectangle.hpp"
#include "fem/solver/geostatic.hpp"
#include "fem/solver/solver.hpp"

using namespace polargrain;
using namespace polargrain::fem;

namespace {

constexpr double kWeightOfGeostatic = 18e3;

/// A block of ground 4 m wide and 3 m deep between smooth walls.
Problem<2> ground(const std::string& element) {
  ElastoplasticParameters<2> parameters;
  parameters.elastic = {40e6, 0.3, 10e6, 0.01, Vector7::Zero()};
  const FrozenCone cone = cone_from_plane_strain({35, 5, 1e3});
  parameters.cone = {cone.friction, cone.dilatancy, cone.cohesion};
  Problem<2> problem;
  problem.mesh = rectangle({{4.0, 3.0}, {4, 3}}, element);
  problem.materials["all"] =
      std::make_shared<LocalMaterial<ElastoplasticLaw<2>>>(ElastoplasticLaw<2>(parameters));
  const TimeTable zero = TimeTable::constant(0.0);
  problem.prescribed = {
      {"left", Dof::u1, zero, {}}, {"right", Dof::u1, zero, {}}, {"bottom", Dof::u2, zero, {}}};
  return problem;
}

class GeostaticElement : public ::testing::TestWithParam<std::string> {};

TEST_P(GeostaticElement, ground_at_rest_stays_at_rest) {
  Problem<2> problem = ground(GetParam());
  problem.body_loads = {gravity(kWeightOfGeostatic)};
  problem.initial_stresses = {geostatic_stress({3.0, kWeightOfGeostatic, 0.5, 10e3})};
  problem.boundary_loads = {{.on = "top", .pressure = TimeTable::constant(10e3)}};
  Solver<2> solver(std::move(problem), {});
  const StepReport report = solver.equilibrate();
  EXPECT_TRUE(report.converged) << report.message;
  EXPECT_EQ(report.iterations, 0);
  std::cout << "[figure] ground at rest, " << GetParam() << ": residual " << report.force_residual << '\n';
  EXPECT_LT(report.force_residual, 1e-14);  // a linear stress: the quadrature is exact
  EXPECT_NEAR(solver.reaction("bottom")(1) / (4 * (3 * kWeightOfGeostatic + 10e3)), 1.0, 1e-12);
  EXPECT_NEAR(solver.reaction("left")(0) / (0.5 * (3 * 3 / 2.0 * kWeightOfGeostatic + 3 * 10e3)), 1.0, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Elements, GeostaticElement, ::testing::ValuesIn(element_names<2>()));

TEST(gravity, switched_on_slowly_gives_the_elastic_pressure_at_rest) {
  // Confined elastic compression: K0 = nu / (1 - nu); it stays inside the cone.
  Problem<2> problem = ground("Q8R");
  problem.body_loads = {gravity(kWeightOfGeostatic, TimeTable::ramp(1.0))};
  Solver<2> solver(std::move(problem), {});
  ASSERT_TRUE(solver.equilibrate().converged);
  for (const double time : {0.5, 1.0}) ASSERT_TRUE(solver.advance(time).converged);
  for (std::size_t point = 0; point < solver.points(); ++point) {
    const Vector7& stress = solver.state().responses[point].stress;
    const double vertical = -kWeightOfGeostatic * (3.0 - solver.position_of_point(point)(1));
    EXPECT_NEAR(stress(k22), vertical, 1e-6 * 3 * kWeightOfGeostatic);
    EXPECT_NEAR(stress(k11), 0.3 / 0.7 * vertical, 1e-6 * 3 * kWeightOfGeostatic);
  }
}

TEST(loads, come_in_stages) {
  // Gravity first, then a surcharge, each while the other rests: time tables make the stages.
  Problem<2> problem = ground("Q8R");
  problem.body_loads = {gravity(kWeightOfGeostatic, TimeTable({{0, 0}, {1, 1}}))};
  problem.boundary_loads = {{.on = "top", .pressure = TimeTable({{1, 0}, {2, 30e3}})}};
  Solver<2> solver(std::move(problem), {});
  ASSERT_TRUE(solver.equilibrate().converged);
  ASSERT_TRUE(solver.advance(1.0).converged);
  EXPECT_NEAR(solver.reaction("bottom")(1), 4 * 3 * kWeightOfGeostatic, 1e-3);
  ASSERT_TRUE(solver.advance(2.0).converged);
  EXPECT_NEAR(solver.reaction("bottom")(1), 4 * (3 * kWeightOfGeostatic + 30e3), 1e-3);
}

TEST(initial_stress, is_refused_by_materials_that_bring_their_own) {
  struct OwnStressLaw {
    struct State {};
    State initial_state() const { return {}; }
    Response<2> integrate(const State&, const Increment<2>&, State&) const { return {}; }
  };
  Problem<2> problem = ground("Q8R");
  problem.materials["all"] = std::make_shared<LocalMaterial<OwnStressLaw>>(OwnStressLaw{});
  problem.initial_stresses = {geostatic_stress({3.0, kWeightOfGeostatic, 0.5, 0.0})};
  EXPECT_THROW(Solver<2>(std::move(problem), {}), RunError);
}

}  // namespace
