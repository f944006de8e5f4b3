// SPDX-License-Identifier: GPL-2.0-or-later
// A slab one element thick, held in plane strain, gives the plane's answers: elastic and elastoplastic, small and large.
#include <gtest/gtest.h>

#include "fem/material/cone_matching.hpp"
#include "fem/material/elastoplastic.hpp"
#include "fem/material/local_material.hpp"
#include "fem/material/slip_driven_cone.hpp"
#include "fem/mesh/box.hpp"
#include "fem/mesh/rectangle.hpp"
#include "fem/solver/solver.hpp"
#include "fem/spread/spread_slip.hpp"

using namespace polargrain;
using namespace polargrain::fem;

namespace {

constexpr double kWidth = 0.04;
constexpr double kHeight = 0.08;
constexpr double kThick = 0.01;
constexpr double kPressure = 100e3;

template <int dim>
std::shared_ptr<Material<dim>> slab_sand(double weaker, double transpose, bool spreads) {
  ElastoplasticParameters<dim> made;
  made.elastic.young_modulus = 40e6;
  made.elastic.poisson_ratio = 0.3;
  made.elastic.cosserat_shear_modulus = 10e6;
  made.elastic.internal_length = 3e-3;
  made.elastic.couple_transpose_ratio = transpose;
  for (int i = 0; i < dim; ++i) made.elastic.initial_stress(Cosserat<dim>::stress_place(i, i)) = -kPressure;
  if constexpr (dim == 2) made.elastic.initial_stress(k33) = -kPressure;
  made.cone = hardening_cone({PiecewiseLinear::ramp(weaker * 40.0, weaker * 35.0, 0.1),
                              PiecewiseLinear::ramp(10.0, 5.0, 0.1), PiecewiseLinear(100.0)},
                             ConeMatch::plane_strain);
  if (spreads) return std::make_shared<SlipDrivenCone<dim>>(made);
  return std::make_shared<LocalMaterial<ElastoplasticLaw<dim>>>(ElastoplasticLaw<dim>(made));
}

/// The force of the upper plate by steps, per metre of thickness, and the iterations.
struct History {
  std::vector<double> forces;
  std::vector<int> iterations;
};

template <int dim>
History biaxial(const std::array<std::string, 2>& element, Deformation deformation, double transpose,
                double spread) {
  Problem<dim> problem;
  if (spread > 0.0) problem.continuum = Continuum::cauchy;
  problem.deformation = deformation;
  if constexpr (dim == 2) {
    problem.mesh = rectangle({{kWidth, kHeight}, {2, 4}}, element[0]);
  } else {
    problem.mesh = box({{kWidth, kHeight, kThick}, {2, 4, 1}}, element[1]);
  }
  // The weak corner: the first element; the sides by the place of their nodes, in the plane's words.
  problem.mesh.regions["weak"] = {0};
  problem.mesh.regions["rest"].clear();
  for (int e = 1; e < static_cast<int>(problem.mesh.elements.size()); ++e)
    problem.mesh.regions["rest"].push_back(e);
  problem.materials["weak"] = slab_sand<dim>(0.95, transpose, spread > 0.0);
  problem.materials["rest"] = slab_sand<dim>(1.0, transpose, spread > 0.0);
  const std::string low = dim == 2 ? "bottom" : "front";
  const std::string high = dim == 2 ? "top" : "back";
  const TimeTable zero = TimeTable::constant(0.0);
  problem.prescribed = {{low, Dof::u2, zero, {}}, {high, Dof::u2, TimeTable::ramp(-1.5e-3), {}}};
  problem.prescribed.push_back({dim == 2 ? "bottom_left" : "front_left", Dof::u1, zero, {}});
  if (dim == 3)
    for (const char* const face : {"bottom", "top"})
      for (const Dof dof : {Dof::u3, Dof::w1, Dof::w2})
        if (dof == Dof::u3 || problem.continuum == Continuum::cosserat)
          problem.prescribed.push_back({face, dof, zero, {}});
  for (const char* const side : {"left", "right"}) {
    BoundaryLoad<dim> load;
    load.on = side;
    load.pressure = TimeTable::constant(kPressure);
    problem.boundary_loads.push_back(load);
  }
  if (spread > 0.0) add_spread_slip(problem, {spread});
  SolverOptions options;
  options.force_tolerance = options.moment_tolerance = 1e-11;
  Solver<dim> solver(std::move(problem), options);
  EXPECT_TRUE(solver.equilibrate().converged);
  History history;
  const int steps = spread > 0.0 ? 24 : 8;  // none is cut: the overstress of spread slips depends on the step
  for (int step = 1; step <= steps; ++step) {
    const StepReport report = solver.advance(static_cast<double>(step) / steps);
    EXPECT_TRUE(report.converged) << report.message;
    history.forces.push_back(solver.reaction(high)(1) / (dim == 2 ? 1.0 : kThick));
    history.iterations.push_back(report.iterations);
  }
  return history;
}

void expect_alike(const std::array<std::string, 2>& element, Deformation deformation, double transpose,
                  double spread = 0.0) {
  const History plane = biaxial<2>(element, deformation, 0.0, spread);
  const History slab = biaxial<3>(element, deformation, transpose, spread);
  ASSERT_EQ(plane.forces.size(), slab.forces.size());
  for (std::size_t step = 0; step < plane.forces.size(); ++step)
    EXPECT_NEAR(slab.forces[step] / plane.forces[step], 1.0, 1e-9) << step;
  // Residuals are sums over other nodes: an iteration may end one sooner or later.
  for (std::size_t step = 0; step < plane.iterations.size(); ++step) {
    EXPECT_NEAR(slab.iterations[step], plane.iterations[step], 1) << step;
    EXPECT_LE(plane.iterations[step], 8) << step;
  }
}

TEST(Slab, OfAnElastoplasticSpecimenIsThePlane) {
  expect_alike({"Q8R", "H20R"}, Deformation::small, 0.0);
  expect_alike({"Q8R", "H20R"}, Deformation::small, 0.5);
}

TEST(Slab, InLargeDeformationIsThePlane) {
  expect_alike({"Q8R", "H20R"}, Deformation::large, 0.0);
}

TEST(Slab, OfSpreadSlipsIsThePlane) {
  for (const Deformation deformation : {Deformation::small, Deformation::large})
    expect_alike({"Q8R", "H20R"}, deformation, 0.0, 0.5 * kWidth);
}

}  // namespace
