// SPDX-License-Identifier: GPL-2.0-or-later
// Pore water in large deformation: turns, tangents, settlements that are no small share of the height.
#include <cmath>
#include <optional>
#include <random>

#include "fem/mesh/box.hpp"
#include "fem/mesh/rectangle.hpp"
#include "fem/solver/geostatic.hpp"
#include "tests/verification/water_scenes.hpp"

using namespace polargrain;
using namespace polargrain::fem;

namespace {

template <int dim>
Mesh<dim> block() {
  if constexpr (dim == 2) return rectangle({{1.0, 2.0}, {2, 2}});
  if constexpr (dim == 3) return box({{1.0, 1.0, 2.0}, {1, 1, 2}});
}

template <int dim>
Problem<dim> wet_block(Mesh<dim> mesh, double pressure, double permeability,
                       std::optional<double> level = {}) {
  Problem<dim> problem;
  problem.mesh = std::move(mesh);
  problem.continuum = Continuum::cauchy;
  problem.deformation = Deformation::large;
  problem.materials["all"] = elastic<dim>(1e6, 0.25);
  PoreWaterOptions options;
  options.unit_weight = 1e4;
  options.table = level;
  add_pore_water<dim>(problem, {{"all", {Permeability::constant(permeability), 0.7, 2.2e9}}}, options);
  problem.fields[0].initial.assign(problem.fields[0].nodes.size(), pressure);
  return problem;
}

// A body full of water that turns by 40 degrees in one step: no flow, and forces turn with it.
TEST(water_large, a_turn_moves_no_water) {
  Problem<2> problem = wet_block<2>(block<2>(), 1e5, 1e-4);
  const double angle = 40.0 * M_PI / 180.0;
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  const TimeTable ramp({{0.0, 0.0}, {1.0, 1.0}});
  problem.prescribed = {
      {"all", Dof::u1, ramp, [=](const Eigen::Vector2d& x) { return (c - 1.0) * x.x() - s * x.y(); }},
      {"all", Dof::u2, ramp, [=](const Eigen::Vector2d& x) { return s * x.x() + (c - 1.0) * x.y(); }}};
  Solver<2> solver(std::move(problem), {});
  expect_balance<2>(solver.equilibrate());
  const Eigen::VectorXd before = solver.state().contributed;
  expect_balance<2>(solver.advance(1.0));
  for (const Eigen::Vector2d& place :
       {Eigen::Vector2d(0.0, 0.0), Eigen::Vector2d(0.5, 1.0), Eigen::Vector2d(1.0, 2.0)})
    EXPECT_NEAR(pressure_at<2>(solver, place), 1e5, 1e-4);
  const Eigen::VectorXd after = solver.state().contributed;
  Eigen::Matrix2d turn;
  turn << c, -s, s, c;
  for (Eigen::Index node = 0; node < static_cast<Eigen::Index>(solver.problem().mesh.nodes.size()); ++node) {
    const Eigen::Vector2d expected = turn * before.segment<2>(3 * node);
    EXPECT_LT((after.segment<2>(3 * node) - expected).norm(), 1e-9 * 1e5) << node;
  }
}

/// Of one element that is distorted and moved far, against differences.
/// @param level whether gravity acts on the water
template <int dim>
double error_of_tangent(std::optional<double> level = {}) {
  Problem<dim> problem = wet_block<dim>(block<dim>(), 1e5, 1e-4, level);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  PoreWater<dim>& water = dynamic_cast<PoreWater<dim>&>(*problem.contributions[0]);
  water.allocate();
  Eigen::VectorXd start = Eigen::VectorXd::Zero(problem.places().size());
  for (double& value : start) value = 0.02 * uniform(random);
  start.tail(start.size() - problem.places().mechanics()).array() += 5.0;
  Eigen::VectorXd increment = Eigen::VectorXd::Zero(start.size());
  for (double& value : increment) value = 0.02 * uniform(random);
  const auto forces_at = [&](const Eigen::VectorXd& at) {
    NodalForces forces{Eigen::VectorXd::Zero(start.size()), Eigen::VectorXd::Zero(start.size())};
    EXPECT_EQ(water.evaluate({0.0, 10.0, start, at}, forces), "");
    return forces.internal;
  };
  double error = 0.0;
  double largest = 0.0;
  for (Eigen::Index entry = 0; entry < start.size(); ++entry) {
    constexpr double kStep = 1e-6;
    const Eigen::VectorXd difference =
        (forces_at(increment + kStep * Eigen::VectorXd::Unit(start.size(), entry)) -
         forces_at(increment - kStep * Eigen::VectorXd::Unit(start.size(), entry))) /
        (2.0 * kStep);
    forces_at(increment);
    Eigen::VectorXd linear = Eigen::VectorXd::Zero(start.size());
    for (std::size_t e = 0; e < water.elements(); ++e) {
      const Eigen::VectorXd unit = Eigen::VectorXd::Unit(start.size(), entry)(water.entries(e));
      linear(water.entries(e)) += water.tangent(e) * unit;
    }
    error = std::max(error, (difference - linear).cwiseAbs().maxCoeff());
    largest = std::max(largest, linear.cwiseAbs().maxCoeff());
  }
  return error / largest;
}

TEST(water_large, tangents_are_those_of_differences) {
  EXPECT_LT(error_of_tangent<2>(), 1e-8);
  EXPECT_LT(error_of_tangent<3>(), 1e-8);
  EXPECT_LT(error_of_tangent<2>(2.0), 1e-8);
  EXPECT_LT(error_of_tangent<3>(2.0), 1e-8);
}

/// All sides but the top slide along themselves.
template <int dim>
void stand_on_rollers(Problem<dim>& problem) {
  const TimeTable zero = TimeTable::constant(0.0);
  problem.prescribed = {{"left", Dof::u1, zero, {}}, {"right", Dof::u1, zero, {}}};
  if constexpr (dim == 2) problem.prescribed.push_back({"bottom", Dof::u2, zero, {}});
  if constexpr (dim == 3)
    for (const auto& [side, dof] :
         {std::pair{"front", Dof::u2}, std::pair{"back", Dof::u2}, std::pair{"bottom", Dof::u3}})
      problem.prescribed.push_back({side, dof, zero, {}});
}

// A column that loses a fifth of its height: all that leaves made room, at any time; at the end the skeleton bears all.
template <int dim>
void consolidate() {
  Problem<dim> problem = wet_block<dim>(block<dim>(), 0.0, 1e-6);
  stand_on_rollers(problem);
  problem.boundary_loads.push_back({"top", TimeTable({{0.0, 0.0}, {1.0, 250e3}})});
  problem.prescribed_fields = {{kPorePressure, "top", TimeTable::constant(0.0)}};
  SolverOptions options;
  options.force_tolerance = 1e-10;
  Solver<dim> solver(std::move(problem), options);
  expect_balance<dim>(solver.equilibrate());
  const auto* const water = pore_water_of(solver.problem());
  for (const double time : {1.0, 1e3, 1e5, 1e7, 1e9}) {
    const StepReport report = solver.advance(time);
    expect_balance<dim>(report);
    EXPECT_EQ(report.substeps, 1) << time;
    EXPECT_LE(report.iterations, 7) << time;
    double out = 0.0;
    for (const int node : solver.problem().mesh.nodes_on("top"))
      if (const int entry = solver.problem().places().entry(0, node); entry >= 0)
        out += water->outflow(entry);
    const double settled = -solver.mean_displacement("top")(dim - 1);
    double stored = 0.0;  // n / Kw of 250 kPa at most
    stored = 0.42 / 2.2e9 * 250e3 * 2.0;
    EXPECT_NEAR(out, settled, stored) << time;
  }
  EXPECT_GT(-solver.mean_displacement("top")(dim - 1), 0.35);
  EXPECT_NEAR(solver.mean_field(0, {"bottom"}), 0.0, 1.0);
}

TEST(water_large, a_column_settles_by_the_water_it_loses) {
  consolidate<2>();
  consolidate<3>();
}

// A column of 10 m that loses a seventh of its height. Submerged weight is that of the grains alone, which stay: with saturated weights
// and a level the base bears what it bears with submerged weights and excess pressures.
struct WeightOnABase {
  double effective, settled;
};

template <int dim>
WeightOnABase settle_under_water(bool is_total) {
  constexpr double kHeight = 10.0;
  constexpr double kSaturated = 16e3;
  constexpr double kWater = 1e4;
  Mesh<dim> mesh;
  if constexpr (dim == 2) mesh = rectangle({{1.0, kHeight}, {1, 10}});
  if constexpr (dim == 3) mesh = box({{1.0, 1.0, kHeight}, {1, 1, 5}});
  Problem<dim> problem;
  problem.mesh = std::move(mesh);
  problem.continuum = Continuum::cauchy;
  problem.deformation = Deformation::large;
  problem.materials["all"] = elastic<dim>(0.5e6, 0.25);
  PoreWaterOptions water;
  water.unit_weight = kWater;
  if (is_total) water.table = kHeight;
  add_pore_water<dim>(problem, {{"all", {Permeability::constant(1e-6), 0.7, 2.2e9}}}, water);
  stand_on_rollers(problem);
  problem.boundary_loads.push_back({"top", TimeTable({{0.0, 0.0}, {1.0, 100e3}})});
  problem.prescribed_fields = {{kPorePressure, "top", TimeTable::constant(0.0)}};
  const double weight = is_total ? kSaturated : kSaturated - kWater;
  Ground ground{kHeight, weight, 1.0 / 3.0, 0.0, {}, kWater};
  if (is_total) ground.water_level = kHeight;
  problem.initial_stresses.push_back(geostatic_stress<dim>(ground));
  problem.body_loads.push_back(gravity<dim>(weight));
  SolverOptions options;
  options.force_tolerance = 1e-10;
  Solver<dim> solver(std::move(problem), options);
  expect_balance<dim>(solver.equilibrate());
  double time = 1.0;
  expect_balance<dim>(solver.advance(time));
  for (int step = 0; step < 40; ++step) expect_balance<dim>(solver.advance(time *= 2.0));
  const double total = solver.reaction("bottom")(dim - 1);
  return {total - solver.mean_field(0, {"bottom"}), -solver.mean_displacement("top")(dim - 1)};
}

template <int dim>
void expect_submerged_weight_and_load() {
  const WeightOnABase total = settle_under_water<dim>(true);
  const WeightOnABase excess = settle_under_water<dim>(false);
  const double expected = 100e3 + (16e3 - 1e4) * 10.0;
  EXPECT_NEAR(total.effective, expected, 1e-4 * expected)
      << "16 kPa more with the weight of the water that left";
  EXPECT_NEAR(excess.effective, expected, 1e-4 * expected);
  EXPECT_GT(total.settled, 1.4);
  EXPECT_NEAR(total.settled, excess.settled, 1e-4 * excess.settled);
}

TEST(water_large, ground_loses_the_weight_of_the_water_that_leaves) {
  expect_submerged_weight_and_load<2>();
  expect_submerged_weight_and_load<3>();
}

}  // namespace
