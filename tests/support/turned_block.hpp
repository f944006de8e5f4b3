// SPDX-License-Identifier: GPL-2.0-or-later
// A block of elements that is strained while it is turned, its boundary given: its end must be that of the
// straight one, turned.
#pragma once
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "fem/mesh/rectangle.hpp"
#include "fem/solver/solver.hpp"
#include "tests/support/turning_sand.hpp"

namespace polargrain::testing {

/// The path of a body: x = Q(angle) (X + strained(X)), all in proportion to the time, while its lower edge
/// gives the grains a rotation of their own.
struct Path {
  Eigen::Matrix2d gradient;        ///< of the strain, at the end
  double bulge = 0.0;              ///< of a motion that is not uniform, 1/m
  double relative_rotation = 0.0;  ///< of the grains along the lower edge, rad
};

inline Eigen::Vector2d place(const Path& path, const Eigen::Vector2d& x, double time, double angle) {
  const Eigen::Vector2d bulged(path.bulge * x(1) * x(1), path.bulge * x(0) * x(1));
  return Eigen::Rotation2Dd(time * angle) * (x + time * (path.gradient * x + bulged));
}

struct Block {
  std::string element = "Q8R";
  int elements = 2;  ///< along each side
  double tolerance = 1e-10;
  bool free_rotations = false;  ///< no rotation of the grains is given
};

/// @returns the stresses at the end; empty where the run does not get there
inline std::vector<Response<2>> turned_block(std::shared_ptr<fem::Material<2>> material, const Block& block,
                                             const Path& path, double angle, int steps) {
  using namespace fem;
  Problem<2> problem;
  problem.deformation = Deformation::large;
  problem.mesh = rectangle({{0.2, 0.2}, {block.elements, block.elements}}, block.element);
  problem.materials["all"] = std::move(material);
  std::vector<int> around;
  for (const char* side : {"left", "right", "bottom", "top"})
    for (const int node : problem.mesh.nodes_on(side)) around.push_back(node);
  std::sort(around.begin(), around.end());
  around.erase(std::unique(around.begin(), around.end()), around.end());
  std::vector<TimeTable::Point> rotation;
  for (int step = 0; step <= steps; ++step) {
    const double time = static_cast<double>(step) / steps;
    rotation.push_back({time, time * (angle + path.relative_rotation)});
  }
  if (!block.free_rotations) problem.prescribed.push_back({"bottom", Dof::w, TimeTable(rotation), {}});
  for (const int node : around) {
    const std::string name = "node" + std::to_string(node);
    problem.mesh.node_sets[name] = {node};
    const Eigen::Vector2d x = problem.mesh.nodes[static_cast<std::size_t>(node)];
    for (const int axis : {0, 1}) {
      std::vector<TimeTable::Point> table;
      for (int step = 0; step <= steps; ++step) {
        const double time = static_cast<double>(step) / steps;
        table.push_back({time, place(path, x, time, angle)(axis) - x(axis)});
      }
      problem.prescribed.push_back({name, axis == 0 ? Dof::u1 : Dof::u2, TimeTable(table), {}});
    }
  }
  SolverOptions options;
  options.force_tolerance = options.moment_tolerance = block.tolerance;
  options.most_cuts = 0;
  Solver<2> solver(std::move(problem), options);
  EXPECT_TRUE(solver.equilibrate().converged) << block.element;
  for (int step = 1; step <= steps; ++step) {
    const StepReport report = solver.advance(static_cast<double>(step) / steps);
    EXPECT_TRUE(report.converged) << block.element << ", step " << step << " of " << steps << ": "
                                  << report.message;
    if (!report.converged) return {};
  }
  return solver.state().responses;
}

/// Largest difference of the stress of a point, over the largest stress of the straight run. Infinite where one has not
/// come to its end.
inline double error_of_turning(const std::vector<Response<2>>& straight,
                               const std::vector<Response<2>>& turned, double angle) {
  if (straight.empty() || turned.empty()) return HUGE_VAL;
  const Eigen::Matrix2d r = Eigen::Rotation2Dd(angle).toRotationMatrix();
  double size = 0.0;
  double error = 0.0;
  for (std::size_t p = 0; p < turned.size(); ++p) {
    size = std::max(size, straight[p].stress.norm());
    error = std::max(error, (turned[p].stress - turned_by(r, straight[p].stress)).norm());
  }
  return error / size;
}

}  // namespace polargrain::testing
