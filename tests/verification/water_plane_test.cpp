// SPDX-License-Identifier: GPL-2.0-or-later
// Pore water in the plane: Mandel's problem (series), a strip load (independent code, extrapolated).
#include <cmath>

#include "fem/mesh/rectangle.hpp"
#include "tests/verification/water_scenes.hpp"

using namespace polargrain;
using namespace polargrain::fem;

namespace {

/// Moves all nodes; middle nodes stay in the middle of their sides.
void map_nodes(Mesh<2>& mesh, const std::function<Eigen::Vector2d(const Eigen::Vector2d&)>& map) {
  for (Eigen::Vector2d& node : mesh.nodes) node = map(node);
  for (const Element<2>& element : mesh.elements)
    for (const ElementSide<2>& side : element.type->sides)
      if (side.nodes.size() == 3) {
        const auto at = [&](std::size_t k) -> Eigen::Vector2d& {
          return mesh.nodes[static_cast<std::size_t>(element.nodes[static_cast<std::size_t>(side.nodes[k])])];
        };
        at(2) = 0.5 * (at(0) + at(1));
      }
}

const TimeTable kZeroOfWaterPlane = TimeTable::constant(0.0);

/// A quarter of Mandel's block of 2 m by 1 m between stiff smooth plates, 100 kN/m on it; drained at x = 1 m.
std::unique_ptr<Solver<2>> mandel(double storage, Continuum continuum) {
  Problem<2> problem;
  problem.mesh = rectangle({{1.0, 0.5}, {16, 2}});
  map_nodes(problem.mesh,
            [](const Eigen::Vector2d& x) { return Eigen::Vector2d(1.0 - std::pow(1.0 - x(0), 1.5), x(1)); });
  problem.continuum = continuum;
  problem.materials["all"] = elastic<2>(1e7, 0.2);
  problem.prescribed = {{"left", Dof::u1, kZeroOfWaterPlane, {}}, {"bottom", Dof::u2, kZeroOfWaterPlane, {}}};
  problem.equal_dofs = {{"top", Dof::u2}};
  problem.node_loads = {{"top_left", Dof::u2, TimeTable::constant(-1e5)}};
  PoreWaterOptions options;
  options.unit_weight = 1e4;
  // n = 1/2.
  add_pore_water<2>(problem, {{"all", {Permeability::constant(1e-8), 1.0, 0.5 / storage}}}, options);
  problem.prescribed_fields = {{kPorePressure, "right", kZeroOfWaterPlane}};
  auto solver = std::make_unique<Solver<2>>(std::move(problem), SolverOptions{});
  const StepReport report = solver->equilibrate();
  EXPECT_TRUE(report.converged) << report.message;
  return solver;
}

struct MandelRow {
  double time_factor;
  double centre, half;          ///< p / p0
  double widening, settlement;  ///< 1e-3 m
};

// The pressure in the middle rises before it falls; rotations of the grains play no part in it.
TEST(water_plane, mandel_incompressible) {
  constexpr double kP0 = 50000.0;
  constexpr double kC = 1.111111e-5;
  for (const Continuum continuum : {Continuum::cauchy, Continuum::cosserat}) {
    const auto solver = mandel(0.0, continuum);
    // At once, but for the elements at the side that is drained at once too.
    EXPECT_NEAR(pressure_at<2>(*solver, {0.0, 0.0}), kP0, 3e-3 * kP0);
    for (const MandelRow& row : {MandelRow{0.01, 1.043761, 1.043349, 5.737433, 3.131283},
                                 MandelRow{0.05, 1.098883, 0.982236, 5.387290, 3.306355},
                                 MandelRow{0.1, 1.095414, 0.860903, 5.104607, 3.447696},
                                 MandelRow{0.2, 0.968114, 0.707444, 4.673288, 3.663356},
                                 MandelRow{0.5, 0.592785, 0.428127, 3.780957, 4.109522},
                                 MandelRow{1.0, 0.258844, 0.186939, 3.002992, 4.498504}}) {
      go(*solver, row.time_factor / kC, 40);
      // th = 1 in 40 steps; an independent code has up to 3e-3 of p0 and 2e-3 of the displacements.
      EXPECT_NEAR(pressure_at<2>(*solver, {0.0, 0.0}) / kP0, row.centre, 4e-3) << row.time_factor;
      EXPECT_NEAR(1e3 * value_at<2>(*solver, {1.0, 0.0}, Dof::u1), row.widening, 3e-3 * row.widening);
      EXPECT_NEAR(-1e3 * value_at<2>(*solver, {0.0, 0.5}, Dof::u2), row.settlement, 3e-3 * row.settlement);
    }
  }
}

TEST(water_plane, mandel_with_water_that_yields) {
  constexpr double kP0 = 37113.4;
  constexpr double kC = 7.142857e-6;
  const auto solver = mandel(1.0 / 20e6, Continuum::cauchy);
  EXPECT_NEAR(pressure_at<2>(*solver, {0.0, 0.0}), kP0, 3e-3 * kP0);
  const std::vector<std::pair<double, double>> rows{{0.01, 1.032200}, {0.05, 1.071087}, {0.1, 1.054634},
                                                    {0.2, 0.911357},  {0.5, 0.522251},  {1.0, 0.204212}};
  for (const auto& [time_factor, centre] : rows) {
    go(*solver, time_factor / kC, 40);
    EXPECT_NEAR(pressure_at<2>(*solver, {0.0, 0.0}) / kP0, centre, 4e-3) << time_factor;
  }
}

/// Half of a layer of 4 m on rough rock under a flexible strip of 100 kPa and half width 1 m, drained on top.
/// @param elements over the depth
std::unique_ptr<Solver<2>> strip_load(int elements) {
  Problem<2> problem;
  problem.mesh = rectangle({{12.0, 4.0}, {3 * elements, elements}, {0.0, -4.0}});
  for (const BoundarySide& side : problem.mesh.boundaries["top"]) {
    double middle = 0.0;
    for (const int node : problem.mesh.side_nodes(side))
      middle += problem.mesh.nodes[static_cast<std::size_t>(node)](0) / 3;
    if (middle < 1.0) problem.mesh.boundaries["strip"].push_back(side);
  }
  problem.continuum = Continuum::cauchy;
  problem.materials["all"] = elastic<2>(1e7, 0.25);
  problem.prescribed = {{"left", Dof::u1, kZeroOfWaterPlane, {}},
                        {"right", Dof::u1, kZeroOfWaterPlane, {}},
                        {"bottom", Dof::u1, kZeroOfWaterPlane, {}},
                        {"bottom", Dof::u2, kZeroOfWaterPlane, {}}};
  problem.boundary_loads.push_back({"strip", TimeTable::constant(1e5)});
  PoreWaterOptions options;
  options.unit_weight = 1e4;
  add_pore_water<2>(problem, {{"all", {Permeability::constant(1e-8), 0.7, kIncompressible}}}, options);
  problem.prescribed_fields = {{kPorePressure, "top", kZeroOfWaterPlane}};
  auto solver = std::make_unique<Solver<2>>(std::move(problem), SolverOptions{});
  const StepReport report = solver->equilibrate();
  EXPECT_TRUE(report.converged) << report.message;
  return solver;
}

// Zero flow at first: neighbours of a checkerboard would be off by far more than half a percent. There the step from drained ground to
// the sudden pressure is as wide as an element, so the error falls like it, and two meshes are drawn on.
TEST(water_plane, strip_load_at_once_and_while_it_consolidates) {
  const auto coarse = strip_load(16);
  const auto solver = strip_load(32);
  const auto settlement = [](const auto& of) { return -1e3 * value_at<2>(*of, {0.0, 0.0}, Dof::u2); };
  const auto pressure = [](const auto& of, double x, double y) { return pressure_at<2>(*of, {x, y}) / 1e5; };
  const auto drawn_on = [&](double x, double y) {
    return 2.0 * pressure(solver, x, y) - pressure(coarse, x, y);
  };
  EXPECT_NEAR(2.0 * settlement(solver) - settlement(coarse), 11.30695, 0.005 * 11.3);
  EXPECT_NEAR(drawn_on(0, -1), 0.474691, 0.005);
  EXPECT_NEAR(drawn_on(0, -2), 0.334909, 0.005);
  EXPECT_NEAR(drawn_on(2, -1), 0.130571, 0.005);
  go(*solver, 0.1 / 1.2e-5, 20);
  EXPECT_NEAR(settlement(solver), 13.656, 0.005 * 13.656);
  EXPECT_NEAR(pressure(solver, 0, -1), 0.5093, 0.005);
  EXPECT_NEAR(pressure(solver, 0, -2), 0.3590, 0.005);
  EXPECT_NEAR(pressure(solver, 2, -1), 0.1170, 0.005);
  go(*solver, 1.0 / 1.2e-5, 20);
  EXPECT_NEAR(settlement(solver), 17.054, 0.005 * 17.054);
  EXPECT_NEAR(pressure(solver, 0, -1), 0.18553, 0.005);
  EXPECT_NEAR(pressure(solver, 0, -2), 0.2744, 0.005);
  EXPECT_NEAR(pressure(solver, 2, -1), 0.10814, 0.005);
}

// Strains of small deformation are shares of the first volume: e = e0 + (1 + e0) strain, however many steps lead there.
TEST(water_plane, void_ratio_does_not_know_the_number_of_steps) {
  constexpr double kStrain = 0.2;
  for (const int steps : {2, 8, 200}) {
    Problem<2> problem;
    problem.mesh = rectangle({{1.0, 1.0}, {1, 1}});
    problem.continuum = Continuum::cauchy;
    problem.materials["all"] = elastic<2>(1e7, 0.2);
    const Permeability as_void_ratio = Permeability::table(PiecewiseLinear({{0.1, 0.1}, {2.0, 2.0}}));
    const auto water = add_pore_water<2>(problem, {{"all", {as_void_ratio, 0.8, 2.2e9}}}, {});
    water->allocate();
    const Eigen::Index size = problem.places().size();
    const auto squeezed_by = [&](double strain) {
      Eigen::VectorXd nodal = Eigen::VectorXd::Zero(size);
      for (std::size_t node = 0; node < problem.mesh.nodes.size(); ++node)
        nodal(entry_of<2>(static_cast<Eigen::Index>(node), Dof::u2)) = -strain * problem.mesh.nodes[node](1);
      return nodal;
    };
    for (int step = 0; step < steps; ++step) {
      const Eigen::VectorXd start = squeezed_by(kStrain * step / steps);
      const Eigen::VectorXd increment = squeezed_by(kStrain * (step + 1) / steps) - start;
      NodalForces forces{Eigen::VectorXd::Zero(size), Eigen::VectorXd::Zero(size)};
      EXPECT_EQ(water->evaluate({1.0 * step, 1.0 * (step + 1), start, increment}, forces), "");
      water->commit();
    }
    EXPECT_NEAR(water->permeability(0), 0.8 - 1.8 * kStrain, 1e-12) << steps << " steps";
  }
}

}  // namespace
