// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// What the tests of pore water share.
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "fem/material/elastic.hpp"
#include "fem/material/local_material.hpp"
#include "fem/solver/solver.hpp"
#include "fem/water/pore_water.hpp"

namespace polargrain::fem {

inline const double kIncompressible = std::numeric_limits<double>::infinity();

template <int dim>
std::shared_ptr<Material<dim>> elastic(double young, double poisson) {
  return std::make_shared<LocalMaterial<ElasticLaw<dim>>>(
      ElasticLaw<dim>(ElasticParameters<dim>{young, poisson, 0.4 * young, 0.1}));
}

/// p at the node nearest to a place, Pa.
template <int dim>
double pressure_at(const Solver<dim>& solver, const typename Cosserat<dim>::Place& place) {
  const Problem<dim>& problem = solver.problem();
  const NodalField& field = problem.fields.at(0);
  const auto distance = [&](int node) {
    return (problem.mesh.nodes[static_cast<std::size_t>(node)] - place).norm();
  };
  const int nearest = *std::ranges::min_element(field.nodes, {}, distance);
  EXPECT_LT(distance(nearest), 1e-9);
  return solver.state().displacement(problem.places().entry(0, nearest));
}

/// A displacement or rotation at the node at a place.
template <int dim>
double value_at(const Solver<dim>& solver, const typename Cosserat<dim>::Place& place, Dof dof) {
  const Mesh<dim>& mesh = solver.problem().mesh;
  for (std::size_t node = 0; node < mesh.nodes.size(); ++node)
    if ((mesh.nodes[node] - place).norm() < 1e-9)
      return solver.state().displacement(entry_of<dim>(static_cast<Eigen::Index>(node), dof));
  ADD_FAILURE() << "no node there";
  return NAN;
}

template <int dim>
void expect_balance(const StepReport& report) {
  EXPECT_TRUE(report.converged) << report.message;
}

/// Goes on to `end` in equal steps.
template <int dim>
void go(Solver<dim>& solver, double end, int steps) {
  const double start = solver.state().time;
  for (int step = 1; step <= steps; ++step) {
    const StepReport report = solver.advance(step == steps ? end : start + (end - start) * step / steps);
    ASSERT_TRUE(report.converged) << report.message;
    ASSERT_EQ(report.substeps, 1);
  }
}

}  // namespace polargrain::fem
