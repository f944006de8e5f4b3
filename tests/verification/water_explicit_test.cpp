// SPDX-License-Identifier: GPL-2.0-or-later
// Pore water in explicit steps: shut in, flowing, in waves.
#include <cmath>
#include <tuple>

#include "common/memory_archive.hpp"
#include "fem/mesh/box.hpp"
#include "fem/mesh/rectangle.hpp"
#include "tests/verification/water_scenes.hpp"

using namespace polargrain;
using namespace polargrain::fem;

namespace {

constexpr double kOedometerModulus = 12e6;     // of E = 10 MPa, nu = 0.25, Pa
constexpr double kModulusOfWater = 120e6;      // M, Pa
constexpr double kLoadOfWaterExplicit = 10e3;  // Pa
const TimeTable kZeroOfWaterExplicit = TimeTable::constant(0.0);

/// e = 1, so n = 1/2 and Kw = M/2.
WaterOfRegion stiff_water(bool undrained) {
  return {Permeability::constant(1e-8), 1.0, 0.5 * kModulusOfWater, undrained};
}

/// A column between smooth sides, loaded on top.
template <int dim>
Problem<dim> column_of_waves(Mesh<dim> mesh, const TimeTable& load, bool undrained, Continuum continuum) {
  Problem<dim> problem;
  problem.mesh = std::move(mesh);
  problem.continuum = continuum;
  problem.materials["all"] = elastic<dim>(1e7, 0.25);
  problem.densities["all"] = 2000.0;
  problem.prescribed = {{"left", Dof::u1, kZeroOfWaterExplicit, {}},
                        {"right", Dof::u1, kZeroOfWaterExplicit, {}}};
  if constexpr (dim == 3) {
    problem.prescribed.push_back({"front", Dof::u2, kZeroOfWaterExplicit, {}});
    problem.prescribed.push_back({"back", Dof::u2, kZeroOfWaterExplicit, {}});
  }
  problem.prescribed.push_back({"bottom", dim == 2 ? Dof::u2 : Dof::u3, kZeroOfWaterExplicit, {}});
  problem.boundary_loads.push_back({"top", load});
  PoreWaterOptions options;
  options.unit_weight = 1e4;
  add_pore_water<dim>(problem, {{"all", stiff_water(undrained)}}, options);
  return problem;
}

// One-dimensional: p = q M / (Eoed + M), whatever the element.
TEST(water_explicit, shut_in_water_takes_its_share) {
  const double share = kModulusOfWater / (kModulusOfWater + kOedometerModulus);
  const auto look = [&]<int dim>(Mesh<dim> mesh, Continuum continuum) {
    Solver<dim> solver(
        column_of_waves<dim>(std::move(mesh), TimeTable::ramp(kLoadOfWaterExplicit), true, continuum), {});
    ASSERT_TRUE(solver.begin_explicit().converged);
    const StepReport report = solver.advance_explicit(1.0, 2000, {.rest = 1e-6});
    ASSERT_TRUE(report.converged) << report.message;
    for (const int node : solver.problem().fields[0].nodes)
      EXPECT_NEAR(
          solver.state().displacement(solver.problem().places().entry(0, node)) / kLoadOfWaterExplicit, share,
          1e-4)
          << solver.problem().mesh.elements[0].type->name;
  };
  for (const Continuum continuum : {Continuum::cauchy, Continuum::cosserat}) {
    look(rectangle({{0.25, 1.0}, {1, 4}}), continuum);
    look(rectangle({{0.25, 1.0}, {1, 4}}, "T6"), continuum);
  }
  look(box({{0.25, 0.25, 1.0}, {1, 1, 2}}), Continuum::cauchy);
}

// The same problem by Newton's method, whose steps are as many.
TEST(water_explicit, consolidates_as_in_balanced_steps) {
  const auto make = [] {
    Problem<2> problem =
        column_of_waves<2>(rectangle({{0.25, 2.0}, {1, 16}}), TimeTable::ramp(kLoadOfWaterExplicit, 4e4),
                           false, Continuum::cauchy);
    problem.prescribed_fields = {{kPorePressure, "top", kZeroOfWaterExplicit}};
    return std::make_unique<Solver<2>>(std::move(problem), SolverOptions{});
  };
  auto explicit_steps = make();
  const auto balanced = make();
  ASSERT_TRUE(explicit_steps->begin_explicit().converged);
  expect_balance<2>(balanced->equilibrate());
  for (int row = 1; row <= 10; ++row) {
    const double time = 2e4 * row;
    const StepReport report = explicit_steps->advance_explicit(time, 4000, {});
    ASSERT_TRUE(report.converged) << report.message;
    go(*balanced, time, 100);
    if (row == 5) {  // the states of both go through an archive
      MemoryArchive saved;
      explicit_steps->save(saved);
      explicit_steps = make();
      explicit_steps->restore(saved);
    }
    const double settled = balanced->mean_displacement("top")(1);
    EXPECT_NEAR(explicit_steps->mean_displacement("top")(1) / settled, 1.0, 5e-3) << row;
    EXPECT_NEAR(pressure_at<2>(*explicit_steps, {0.0, 0.0}), pressure_at<2>(*balanced, {0.0, 0.0}),
                5e-3 * kLoadOfWaterExplicit)
        << row;
  }
}

// Sudden load on a closed column: until 2 H / c its top moves evenly, to twice where it would rest, with c^2 = (Eoed + M) / density. There and back
// at 4 H / c it is where it began.
TEST(water_explicit, waves_know_the_water) {
  for (const Deformation deformation : {Deformation::small, Deformation::large}) {
    Problem<2> problem =
        column_of_waves<2>(rectangle({{0.02, 1.0}, {1, 50}}),
                           TimeTable({{0.0, 0.0}, {1e-6, kLoadOfWaterExplicit}}), true, Continuum::cauchy);
    problem.deformation = deformation;
    Solver<2> solver(std::move(problem), {});
    ASSERT_TRUE(solver.begin_real_time({}).converged);
    const double speed = std::sqrt((kOedometerModulus + kModulusOfWater) / 2000.0);
    const double at_rest = -kLoadOfWaterExplicit / (kOedometerModulus + kModulusOfWater);
    // The corners of the motion, where it turns, are rounded by elements of 1/50.
    for (const auto& [times, share, tolerance] :
         {std::tuple{1.0, 1.0, 0.015}, {2.0, 2.0, 0.06}, {3.0, 1.0, 0.015}, {4.0, 0.0, 0.06}}) {
      const StepReport report = solver.advance_real_time(times / speed, {});
      ASSERT_TRUE(report.converged) << report.message;
      EXPECT_NEAR(solver.mean_displacement("top")(1) / at_rest, share, tolerance) << times;
      EXPECT_LT(report.energies.error(), 2e-3) << times;
    }
  }
}

}  // namespace
