// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
// Biaxial compression of a block of elastoplastic material, in its many hard variants.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <iostream>

#include "common/error.hpp"
#include "fem/material/cone_matching.hpp"
#include "fem/material/elastoplastic.hpp"
#include "fem/material/local_material.hpp"
#include "fem/mesh/rectangle.hpp"
#include "fem/solver/solver.hpp"

namespace polargrain::fem {

struct Block {
  std::string name;
  std::string element = "Q8R";
  std::array<int, 2> elements{4, 8};
  double poisson_ratio = 0.3;
  double cosserat_modulus = 10e6;
  double internal_length = 1e-3;
  double confining = 100e3;
  double friction = 35, dilatancy = 5, cohesion = 1e3;
  double softened_friction = 35, softening_range = 0.0;  ///< no softening when the range is zero
  bool rough = false;
  double distortion = 0.0;             ///< shift of inner nodes over the element size
  std::vector<double> strains{-0.10};  ///< axial, visited in turn, 10 steps each
  bool has_reference = true;           ///< ends at the Mohr-Coulomb stress
};

inline void distort(Mesh<2>& mesh, double share, const std::array<int, 2>& elements) {
  for (Eigen::Vector2d& node : mesh.nodes) {
    const double i = node(0) / 0.04 * elements[0];
    const double j = node(1) / 0.08 * elements[1];
    const double inside = std::sin(M_PI * i / elements[0]) * std::sin(M_PI * j / elements[1]);
    node(0) += share * 0.04 / elements[0] * inside * std::sin(2.3 * j + i);
    node(1) += share * 0.08 / elements[1] * inside * std::cos(1.7 * i - j);
  }
}

inline Problem<2> problem_of(const Block& block) {
  ElastoplasticParameters<2> parameters;
  parameters.elastic = {40e6, block.poisson_ratio, block.cosserat_modulus, block.internal_length,
                        Vector7::Zero()};
  for (const int i : {k11, k22, k33}) parameters.elastic.initial_stress(i) = -block.confining;
  PiecewiseLinear friction(block.friction);
  if (block.softening_range > 0) {
    friction = PiecewiseLinear::ramp(block.friction, block.softened_friction, block.softening_range);
  }
  parameters.cone = hardening_cone_from_plane_strain({friction, block.dilatancy, block.cohesion});
  Problem<2> problem;
  problem.mesh = rectangle({{0.04, 0.08}, block.elements}, block.element);
  if (block.distortion > 0) distort(problem.mesh, block.distortion, block.elements);
  problem.materials["all"] =
      std::make_shared<LocalMaterial<ElastoplasticLaw<2>>>(ElastoplasticLaw<2>(parameters));
  std::vector<TimeTable::Point> top{{0.0, 0.0}};
  for (const double strain : block.strains) top.push_back({static_cast<double>(top.size()), strain * 0.08});
  const TimeTable zero = TimeTable::constant(0.0);
  problem.prescribed = {{"bottom", Dof::u2, zero, {}},
                        {"bottom_left", Dof::u1, zero, {}},
                        {"top", Dof::u2, TimeTable(top), {}}};
  if (block.rough) {
    problem.prescribed.push_back({"bottom", Dof::u1, zero, {}});
    problem.prescribed.push_back({"top", Dof::u1, zero, {}});
  }
  if (block.confining > 0) {
    for (const char* side : {"left", "right"}) {
      problem.boundary_loads.push_back({.on = side, .pressure = TimeTable::constant(block.confining)});
    }
  }
  return problem;
}

inline void PrintTo(const Block& block, std::ostream* stream) {
  *stream << block.name;
}

/// Axial stress at the limit, tension positive; loading in compression or extension by the last strain.
inline double mohr_coulomb(const Block& block) {
  const double sine = std::sin(block.friction * M_PI / 180);
  const double ratio = (1 + sine) / (1 - sine);
  const double from = block.strains.size() > 1 ? block.strains[block.strains.size() - 2] : 0.0;
  if (block.strains.back() < from) {
    return -(block.confining * ratio + 2 * block.cohesion * std::sqrt(ratio));
  }
  return -(block.confining / ratio - 2 * block.cohesion / std::sqrt(ratio));
}

/// Runs to the end or stops with a reason, prints the outcome and checks it.
inline void check_block(const Block& block) {
  SolverOptions options;
  options.reference_force = 40e6 * 1e-3 * 0.04;  // the same for all, also where nothing presses
  Solver<2> solver(problem_of(block), options);
  ASSERT_TRUE(solver.equilibrate().converged);
  int iterations = 0;
  int cuts = 0;
  std::string message;
  const int steps = 10 * static_cast<int>(block.strains.size());
  for (int step = 1; step <= steps && message.empty(); ++step) {
    const StepReport report = solver.advance(step / 10.0);
    EXPECT_EQ(report.converged, report.message.empty());
    if (report.converged) {
      EXPECT_LE(report.force_residual, options.force_tolerance);
    }
    iterations += report.iterations;
    cuts += report.cuts;
    message = report.message;
  }
  const double stress = solver.reaction("top")(1) / 0.04;
  const SolverState<2>& state = solver.state();
  // Work of unbalanced forces within the tolerance over the way of the top is no error of the balance.
  const double work_tolerance = 1e-5 * std::abs(state.internal_work) + 1e-8 * options.reference_force * 0.008;
  const double work_error = std::abs(state.external_work - state.internal_work);
  std::cout << "[figure] " << block.name << ": " << (message.empty() ? "to the end" : "stopped, " + message)
            << "; time " << state.time << " of " << steps / 10 << ", iterations " << iterations << ", cuts "
            << cuts << ", axial stress " << stress / 1e3 << " kPa";
  if (block.has_reference) {
    // The plane-strain limit is approached as elastic strain rates die out; 1e-3 is the rest after 10 % of
    // strain.
    const double error = stress / mohr_coulomb(block) - 1;
    std::cout << ", relative error " << error;
    EXPECT_TRUE(message.empty()) << message;
    EXPECT_LT(std::abs(error), 1e-3);
  }
  std::cout << ", work " << state.internal_work << " J/m, unbalanced " << work_error << " J/m\n";
  EXPECT_TRUE(state.displacement.allFinite());
  EXPECT_LE(work_error, work_tolerance);
}

}  // namespace polargrain::fem
