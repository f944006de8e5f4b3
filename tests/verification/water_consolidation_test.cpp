// SPDX-License-Identifier: GPL-2.0-or-later
// Consolidation in one dimension (Terzaghi) and in two (Mandel, strip load) against series and an independent code.
#include <cmath>

#include "fem/mesh/box.hpp"
#include "fem/mesh/rectangle.hpp"
#include "tests/verification/water_scenes.hpp"

using namespace polargrain;
using namespace polargrain::fem;

namespace {

constexpr double kLoadOfWaterConsolidation = 1e5;    // Pa
constexpr double kHeightOfWaterConsolidation = 2.0;  // m, drained at both ends
constexpr double kConsolidation =
    1.2e-5;  // cv = k Eoed / gw of E = 10 MPa, nu = 0.25, k = 1e-8 m/s, gw = 10 kN/m3, m2/s
constexpr double kUnitTime =
    0.25 * kHeightOfWaterConsolidation * kHeightOfWaterConsolidation / kConsolidation;  // Tv = 1, s

/// A column along the last axis, loaded at time 0 at its top, drained at top and bottom, its sides smooth and closed.
template <int dim>
Problem<dim> column(Mesh<dim> mesh, double theta = 1.0) {
  Problem<dim> problem;
  problem.mesh = std::move(mesh);
  problem.continuum = Continuum::cauchy;
  problem.materials["all"] = elastic<dim>(1e7, 0.25);
  const TimeTable zero = TimeTable::constant(0.0);
  problem.prescribed = {{"left", Dof::u1, zero, {}}, {"right", Dof::u1, zero, {}}};
  if constexpr (dim == 2) {
    problem.prescribed.push_back({"bottom", Dof::u2, zero, {}});
  } else {
    problem.prescribed.push_back({"front", Dof::u2, zero, {}});
    problem.prescribed.push_back({"back", Dof::u2, zero, {}});
    problem.prescribed.push_back({"bottom", Dof::u3, zero, {}});
  }
  problem.boundary_loads.push_back({"top", TimeTable::constant(kLoadOfWaterConsolidation)});
  PoreWaterOptions options;
  options.unit_weight = 1e4;
  options.theta = theta;
  add_pore_water<dim>(problem, {{"all", {Permeability::constant(1e-8), 0.7, kIncompressible}}}, options);
  problem.prescribed_fields = {{kPorePressure, "top", zero}, {kPorePressure, "bottom", zero}};
  return problem;
}

/// Terzaghi's series. @param z from the drained top over half the height
double exact_pressure(double time_factor, double z) {
  double sum = 0.0;
  for (int m = 0; m < 400; ++m) {
    const double root = (2 * m + 1) * M_PI / 2.0;
    sum += 2.0 / root * std::sin(root * z) * std::exp(-root * root * time_factor);
  }
  return sum;
}

double exact_consolidation(double time_factor) {
  double sum = 1.0;
  for (int m = 0; m < 400; ++m) {
    const double root = (2 * m + 1) * M_PI / 2.0;
    sum -= 2.0 / (root * root) * std::exp(-root * root * time_factor);
  }
  return sum;
}

/// Largest error of a nodal pressure over the load.
template <int dim>
double pressure_error(const Solver<dim>& solver, double time_factor) {
  const Problem<dim>& problem = solver.problem();
  double error = 0.0;
  for (const int node : problem.fields[0].nodes) {
    const double depth =
        kHeightOfWaterConsolidation - problem.mesh.nodes[static_cast<std::size_t>(node)](dim - 1);
    error = std::max(
        error,
        std::abs(solver.state().displacement(problem.places().entry(0, node)) / kLoadOfWaterConsolidation -
                 exact_pressure(time_factor, depth / (0.5 * kHeightOfWaterConsolidation))));
  }
  return error;
}

/// Settlement over its final value.
template <int dim>
double consolidation(const Solver<dim>& solver) {
  const double final_settlement = kLoadOfWaterConsolidation * kHeightOfWaterConsolidation / 1.2e7;
  return -solver.mean_displacement("top")(dim - 1) / final_settlement;
}

template <int dim>
std::unique_ptr<Solver<dim>> started(Problem<dim> problem) {
  auto solver = std::make_unique<Solver<dim>>(std::move(problem), SolverOptions{});
  const StepReport report = solver->equilibrate();
  EXPECT_TRUE(report.converged) << report.message;
  return solver;
}

std::unique_ptr<Solver<2>> plane_column(int elements, double theta = 1.0) {
  return started(column<2>(rectangle({{0.25, kHeightOfWaterConsolidation}, {1, elements}}), theta));
}

// Six times on one path; half a percent of the load, as engineers need it.
TEST(water_consolidation, terzaghi_at_six_times) {
  const auto solver = plane_column(64);
  EXPECT_NEAR(pressure_at<2>(*solver, {0.0, 1.0}), kLoadOfWaterConsolidation,
              1e-4 * kLoadOfWaterConsolidation);  // at once, undrained
  // The sudden load is sharp in time before Tv = 0.05: th = 1 needs more steps there.
  for (const auto& [time_factor, steps] :
       {std::pair{0.01, 160}, {0.05, 80}, {0.1, 80}, {0.2, 80}, {0.5, 80}, {1.0, 80}}) {
    go(*solver, time_factor * kUnitTime, steps);
    EXPECT_LT(pressure_error(*solver, time_factor), 5e-3) << time_factor;
    EXPECT_NEAR(consolidation(*solver), exact_consolidation(time_factor), 5e-3) << time_factor;
  }
  const double out = solver->field_reaction(0, {"top", "bottom"});
  EXPECT_GT(out, 0.0);
}

// The figures of an independent code with the same elements and steps.
TEST(water_consolidation, terzaghi_is_of_first_order_in_time) {
  const auto error = [](int steps) {
    const auto solver = plane_column(16);
    go(*solver, 0.5 * kUnitTime, steps);
    return pressure_error(*solver, 0.5);
  };
  EXPECT_NEAR(error(20), 1.36e-2, 0.01e-2);
  EXPECT_NEAR(error(40), 6.7e-3, 0.1e-3);
}

TEST(water_consolidation, terzaghi_is_of_second_order_in_space) {
  const auto error = [](int elements) {
    const auto solver = plane_column(elements, 0.5);
    go(*solver, 0.5 * kUnitTime, 2000);
    return pressure_error(*solver, 0.5);
  };
  EXPECT_NEAR(error(4), 5.6e-3, 0.1e-3);
  EXPECT_NEAR(error(8), 1.2e-3, 0.1e-3);
}

// The neighbours: every pair of elements, the same column in space.
TEST(water_consolidation, every_pair_of_elements_consolidates_alike) {
  for (const char* type : {"Q8R", "Q8", "T6"}) {
    const auto solver = started(column<2>(rectangle({{0.25, kHeightOfWaterConsolidation}, {1, 16}}, type)));
    go(*solver, 0.5 * kUnitTime, 40);
    EXPECT_NEAR(pressure_error(*solver, 0.5), 6.7e-3, 0.5e-3) << type;
    EXPECT_NEAR(consolidation(*solver), exact_consolidation(0.5), 6e-3) << type;
  }
  for (const char* type : {"H20R", "H20", "T10", "W15"}) {
    const auto solver =
        started(column<3>(box({{0.25, 0.25, kHeightOfWaterConsolidation}, {1, 1, 16}}, type)));
    go(*solver, 0.5 * kUnitTime, 40);
    EXPECT_NEAR(pressure_error(*solver, 0.5), 6.7e-3, 0.5e-3) << type;
    EXPECT_NEAR(consolidation(*solver), exact_consolidation(0.5), 6e-3) << type;
  }
}

}  // namespace
