// SPDX-License-Identifier: GPL-2.0-or-later
// Pore water that does not flow, water at rest, steady flow: exact states.
#include <cmath>

#include "common/memory_archive.hpp"
#include "fem/material/cone_matching.hpp"
#include "fem/material/elastoplastic.hpp"
#include "fem/mesh/rectangle.hpp"
#include "fem/solver/geostatic.hpp"
#include "tests/verification/water_scenes.hpp"

using namespace polargrain;
using namespace polargrain::fem;

namespace {

const TimeTable kZeroOfWaterUndrained = TimeTable::constant(0.0);

/// A block of 1 m with its inner corners off their places, sides straight.
Mesh<2> distorted_block(const char* type) {
  Mesh<2> mesh = rectangle({{1.0, 1.0}, {3, 3}}, type);
  for (Eigen::Vector2d& x : mesh.nodes) {
    const double inside = std::sin(M_PI * x(0)) * std::sin(M_PI * x(1));
    x += 0.08 * inside * Eigen::Vector2d(std::cos(7 * x(0) + 3 * x(1)), std::sin(5 * x(1) + x(0)));
  }
  for (const Element<2>& element : mesh.elements)
    for (const ElementSide<2>& side : element.type->sides) {
      const auto at = [&](std::size_t k) -> Eigen::Vector2d& {
        return mesh.nodes[static_cast<std::size_t>(element.nodes[static_cast<std::size_t>(side.nodes[k])])];
      };
      at(2) = 0.5 * (at(0) + at(1));
    }
  return mesh;
}

PoreWaterOptions water_of_10_kN() {
  PoreWaterOptions options;
  options.unit_weight = 1e4;
  return options;
}

/// e = 1 and 1/M = n/Kw = `storage`, 1/Pa; closed.
WaterOfRegion closed_water(double storage) {
  return {Permeability::constant(1.0), 1.0, 0.5 / storage, true};
}

// A constant strain gives one pressure, whatever the mesh.
TEST(water_undrained, patch) {
  for (const Continuum continuum : {Continuum::cauchy, Continuum::cosserat})
    for (const char* type : {"Q8R", "Q8", "T6"}) {
      Problem<2> problem;
      problem.mesh = distorted_block(type);
      problem.continuum = continuum;
      problem.materials["all"] = elastic<2>(1e7, 0.25);
      for (const char* side : {"left", "right", "bottom", "top"}) {
        problem.prescribed.push_back({side, Dof::u1, TimeTable::ramp(1.0),
                                      [](const Eigen::Vector2d& x) { return 1e-3 * (x(0) + 0.5 * x(1)); }});
        problem.prescribed.push_back({side, Dof::u2, TimeTable::ramp(1.0),
                                      [](const Eigen::Vector2d& x) { return 1e-3 * (x(0) + x(1)); }});
      }
      add_pore_water<2>(problem, {{"all", closed_water(1e-9)}}, water_of_10_kN());
      Solver<2> solver(std::move(problem), {});
      expect_balance<2>(solver.equilibrate());
      expect_balance<2>(solver.advance(1.0));
      for (const int node : solver.problem().fields[0].nodes) {
        const double p = solver.state().displacement(solver.problem().places().entry(0, node));
        EXPECT_NEAR(p, -2e-3 * 1e9, 1e-10 * 2e6) << type;
      }
    }
}

// q = 100 kPa on top, one side free: p and u2 by hand (E = 10 MPa, nu = 0.25).
TEST(water_undrained, biaxial_compression_of_elastic_ground) {
  struct Row {
    double storage, pressure, settlement;
  };
  for (const Row& row : {Row{0.0, 50000.0, 6.25e-3}, Row{1e-9, 49603.174603, 6.27480159e-3},
                         Row{1e-7, 27777.7778, 7.63888889e-3}}) {
    Problem<2> problem;
    problem.mesh = rectangle({{1.0, 1.0}, {3, 3}});
    problem.continuum = Continuum::cauchy;
    problem.materials["all"] = elastic<2>(1e7, 0.25);
    problem.prescribed = {{"left", Dof::u1, kZeroOfWaterUndrained, {}},
                          {"bottom", Dof::u2, kZeroOfWaterUndrained, {}}};
    problem.boundary_loads.push_back({"top", TimeTable::constant(1e5)});
    add_pore_water<2>(problem, {{"all", closed_water(row.storage)}}, water_of_10_kN());
    Solver<2> solver(std::move(problem), {});
    expect_balance<2>(solver.equilibrate());
    EXPECT_NEAR(solver.mean_field(0, {"all"}), row.pressure, 1e-8 * row.pressure);
    EXPECT_NEAR(-solver.mean_displacement("top")(1), row.settlement, 1e-8 * row.settlement);
  }
}

/// A closed specimen under 100 kPa from all sides whose top comes down, of a cone of the plane.
struct Specimen {
  explicit Specimen(const MohrCoulomb& strength, double young = 2e7) {
    ElastoplasticParameters<2> parameters;
    parameters.elastic = {young, 0.25, 0.4 * young, 0.1};
    parameters.elastic.initial_stress.head<3>().setConstant(-1e5);
    const FrozenCone cone = cone_from_plane_strain(strength);
    parameters.cone = {cone.friction, cone.dilatancy, cone.cohesion};
    Problem<2> problem;
    problem.mesh = rectangle({{1.0, 1.0}, {2, 2}});
    problem.continuum = Continuum::cauchy;
    problem.materials["all"] =
        std::make_shared<LocalMaterial<ElastoplasticLaw<2>>>(ElastoplasticLaw<2>(parameters));
    problem.prescribed = {{"left", Dof::u1, kZeroOfWaterUndrained, {}},
                          {"bottom", Dof::u2, kZeroOfWaterUndrained, {}},
                          {"top", Dof::u2, TimeTable::ramp(-1.0), {}}};
    problem.boundary_loads.push_back({"right", TimeTable::constant(1e5)});
    add_pore_water<2>(problem, {{"all", closed_water(0.0)}}, water_of_10_kN());
    solver = std::make_unique<Solver<2>>(std::move(problem), SolverOptions{});
    expect_balance<2>(solver->equilibrate());
  }
  void compress(double strain) { expect_balance<2>(solver->advance(strain)); }
  [[nodiscard]] double deviator() const { return -solver->reaction("top")(1) - 1e5; }
  [[nodiscard]] double pressure() const { return solver->mean_field(0, {"all"}); }
  std::unique_ptr<Solver<2>> solver;
};

// 2 s_u = 2 (|p0| sin phi + c cos phi) without dilatancy.
TEST(water_undrained, strength_of_a_cone_without_dilatancy) {
  for (const auto& [cohesion, deviator] : {std::pair{0.0, 100000.0}, std::pair{5e3, 108660.254}}) {
    Specimen specimen({30.0, 0.0, cohesion});
    for (const double strain : {0.002, 0.005, 0.01, 0.02, 0.03}) specimen.compress(strain);
    EXPECT_NEAR(specimen.deviator(), deviator, 1e-5 * deviator);
    EXPECT_NEAR(specimen.pressure(), 0.5 * deviator, 1e-5 * deviator);
  }
}

// Contraction raises the pressure of the water, which takes the strength away.
TEST(water_undrained, a_contracting_cone_liquefies) {
  Specimen specimen({30.0, -5.0, 0.0});
  for (const double strain : {0.0005, 0.001, 0.0015, 0.002}) specimen.compress(strain);
  struct Row {
    double strain, deviator, pressure;
  };
  for (const Row& row : {Row{0.003, 96000.0, 48000.0}, Row{0.005, 96956.031, 53051.100},
                         Row{0.01, 84225.748, 59215.469}, Row{0.02, 58765.182, 71544.208}}) {
    specimen.compress(row.strain);
    EXPECT_NEAR(specimen.deviator(), row.deviator, 1e-6 * row.deviator) << row.strain;
    EXPECT_NEAR(specimen.pressure(), row.pressure, 1e-6 * row.pressure) << row.strain;
  }
}

/// Saturated ground of 20 kN/m3, 5 m deep, under water of 2 m on it.
Problem<2> ground_under_water() {
  Problem<2> problem;
  problem.mesh = rectangle({{4.0, 5.0}, {4, 5}});
  problem.continuum = Continuum::cauchy;
  problem.materials["all"] = elastic<2>(1e7, 0.25);
  problem.prescribed = {{"left", Dof::u1, kZeroOfWaterUndrained, {}},
                        {"right", Dof::u1, kZeroOfWaterUndrained, {}},
                        {"bottom", Dof::u2, kZeroOfWaterUndrained, {}}};
  problem.body_loads = {gravity<2>(2e4)};
  problem.boundary_loads.push_back({"top", TimeTable::constant(2e4)});
  problem.initial_stresses = {
      geostatic_stress<2>({.surface_height = 5.0, .unit_weight = 1e4, .earth_pressure_ratio = 0.5})};
  PoreWaterOptions options = water_of_10_kN();
  options.table = 7.0;
  add_pore_water<2>(problem, {{"all", {Permeability::constant(1e-5), 0.7, 2.2e9}}}, options);
  problem.prescribed_fields = {{kPorePressure, "top", TimeTable::constant(2e4)}};
  return problem;
}

TEST(water_at_rest, stays_at_rest) {
  Solver<2> solver(ground_under_water(), {});
  const StepReport start = solver.equilibrate();
  expect_balance<2>(start);
  EXPECT_EQ(start.iterations, 0);
  EXPECT_LT(start.force_residual, 1e-13);
  EXPECT_DOUBLE_EQ(pressure_at<2>(solver, {4.0, 0.0}), 7e4);
  expect_balance<2>(solver.advance(1e6));
  EXPECT_NEAR(pressure_at<2>(solver, {4.0, 0.0}), 7e4, 1e-9 * 7e4);
  EXPECT_LT(solver.state().displacement.head(solver.problem().places().mechanics()).cwiseAbs().maxCoeff(),
            1e-12);
}

// The water that is brought in on top goes out at the bottom: dp/dy = q gw / k - gw.
TEST(water_flow, a_flux_brings_its_steady_gradient) {
  Problem<2> problem = ground_under_water();
  PoreWaterOptions options = water_of_10_kN();
  options.table = 0.0;
  options.fluxes = {{"top", TimeTable::constant(4e-6)}};
  problem.fields.clear(), problem.contributions.clear();
  add_pore_water<2>(problem, {{"all", {Permeability::constant(1e-5), 0.7, kIncompressible}}}, options);
  problem.prescribed_fields = {{kPorePressure, "bottom", kZeroOfWaterUndrained}};
  Solver<2> solver(std::move(problem), {});
  expect_balance<2>(solver.equilibrate());
  expect_balance<2>(solver.advance(1e9));
  expect_balance<2>(solver.advance(2e9));
  EXPECT_NEAR(pressure_at<2>(solver, {2.0, 5.0}), 5.0 * (4e-6 / 1e-5 - 1.0) * 1e4, 1e-3);
  EXPECT_NEAR(solver.field_reaction(0, {"bottom"}), 4e-6 * 4.0 * 1e9, 1e-6 * 1.6e4);
  const auto& water = dynamic_cast<const PoreWater<2>&>(*solver.problem().contributions[0]);
  const auto out = [&](const char* side) {
    double sum = 0.0;
    for (const int node : solver.problem().mesh.nodes_on(side))
      if (const int entry = solver.problem().places().entry(0, node); entry >= 0) sum += water.outflow(entry);
    return sum;
  };
  // And the water that the ground held at first.
  EXPECT_GT(out("bottom"), 4e-6 * 4.0 * 2e9);
  EXPECT_NEAR(out("top"), -4e-6 * 4.0 * 2e9, 1e-6 * 3.2e4);
}

TEST(water_flow, goes_on_from_an_archive_to_the_same_bits) {
  const auto make = [] {
    Problem<2> problem = ground_under_water();
    problem.fields.clear(), problem.contributions.clear();
    add_pore_water<2>(problem, {{"all", {Permeability::kozeny_carman({.diameter = 2e-5}, 1e4), 0.7, 2.2e9}}},
                      water_of_10_kN());
    problem.boundary_loads.push_back({"top", TimeTable::ramp(1e6, 10.0)});
    problem.prescribed_fields = {{kPorePressure, "top", kZeroOfWaterUndrained}};
    return problem;
  };
  Solver<2> through(make(), {});
  expect_balance<2>(through.equilibrate());
  expect_balance<2>(through.advance(10.0));
  MemoryArchive archive;
  through.save(archive);
  Solver<2> restored(make(), {});
  restored.restore(archive);
  for (Solver<2>* solver : {&through, &restored}) expect_balance<2>(solver->advance(20.0));
  EXPECT_EQ(through.state().displacement, restored.state().displacement);
}

TEST(water, permeability_by_the_void_ratio) {
  const Permeability grains = Permeability::kozeny_carman({.diameter = 2e-4}, 1e4);
  EXPECT_NEAR(grains.at(0.7), 4.4837e-4, 1e-8);
  EXPECT_TRUE(grains.varies());
  EXPECT_DOUBLE_EQ(Permeability::table(PiecewiseLinear({{0.5, 1e-5}, {0.7, 3e-5}})).at(0.6), 2e-5);
}

TEST(water, elements_without_middle_nodes_are_refused) {
  Problem<2> problem = ground_under_water();
  problem.mesh = rectangle({{4.0, 5.0}, {4, 5}}, "Q4");
  problem.fields.clear(), problem.contributions.clear();
  add_pore_water<2>(problem, {{"all", {Permeability::constant(1e-5)}}, {"soil", {}}}, water_of_10_kN());
  const std::vector<std::string> messages = faults(problem);
  ASSERT_EQ(messages.size(), 2U);
  EXPECT_NE(messages[0].find("no region 'soil'"), std::string::npos);
  EXPECT_NE(messages[1].find("elements Q4 have displacements and pressures of one degree"),
            std::string::npos);
}

}  // namespace
