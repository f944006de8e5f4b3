// SPDX-License-Identifier: GPL-2.0-or-later
// docs/theory.md, E.2: circular hole in a micropolar plate under uniaxial tension (Kaloni and Ariman 1967).
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <iostream>

#include "fem/material/elastic.hpp"
#include "fem/material/local_material.hpp"
#include "fem/mesh/rectangle.hpp"
#include "fem/solver/solver.hpp"

using namespace polargrain;
using namespace polargrain::fem;

namespace {

struct Hole {
  double poisson_ratio;
  double radius_over_length;  ///< a / b
  double coupling_number;     ///< N
  double concentration;       ///< largest stress over the far stress, table of E.2 (numeric)
};

/// Radius 1; distances of the element corners from the hole grow by a constant factor up to the plate's edge.
double distance(int half_steps, int elements, double last) {
  constexpr double kGrowth = 1.2;
  const auto corner = [&](int i) {
    return last * (std::pow(kGrowth, i) - 1) / (std::pow(kGrowth, elements) - 1);
  };
  // Middle nodes half way between corners keep the elements regular.
  return 0.5 * (corner(half_steps / 2) + corner((half_steps + 1) / 2));
}

Mesh<2> quarter_plate() {
  constexpr int kRadial = 36;
  constexpr int kAround = 40;
  constexpr double kHalfWidth = 50.0;  // the hole's effect on the far edges falls as its square
  Mesh<2> mesh = rectangle({{1.0, 1.0}, {kRadial, kAround}});
  for (Eigen::Vector2d& node : mesh.nodes) {
    const double share = distance(static_cast<int>(std::lround(2 * kRadial * node(0))), kRadial, 1.0);
    const double angle = node(1) * M_PI / 2;
    const Eigen::Vector2d hole(std::cos(angle), std::sin(angle));
    const Eigen::Vector2d edge = kHalfWidth * hole / hole.lpNorm<Eigen::Infinity>();
    node = (1 - share) * hole + share * edge;
  }
  for (const BoundarySide& edge : mesh.boundaries.at("right")) {
    const Eigen::Vector2d& middle = mesh.nodes[mesh.side_nodes(edge)[2]];
    if (middle(0) > middle(1)) mesh.boundaries["pulled"].push_back(edge);
  }
  return mesh;
}

/// Stress 11 at the node where the hole meets the axis across the tension, from the four points of its
/// element.
double stress_at_the_hole(const Solver<2>& solver) {
  const Mesh<2>& mesh = solver.problem().mesh;
  const int node = mesh.node_sets.at("top_left").front();
  for (std::size_t point = 0; point < solver.points(); point += 4) {
    const Element<2>& element = mesh.elements[static_cast<std::size_t>(solver.element_of_point(point))];
    if (element.nodes[3] != node) continue;
    // The points of an element span a bilinear field in its reference coordinates; the node is at (-1, 1).
    Eigen::Matrix4d terms;
    Eigen::Vector4d values;
    for (int i = 0; i < 4; ++i) {
      const Eigen::Vector2d& x = element.type->quadrature[i].position;
      terms.row(i) << 1.0, x(0), x(1), x(0) * x(1);
      values(i) = solver.state().responses[point + i].stress(k11);
    }
    return (terms.inverse() * values).dot(Eigen::Vector4d(1, -1, 1, -1));
  }
  return 0.0;
}

class HoleTest : public ::testing::TestWithParam<Hole> {};

TEST_P(HoleTest, concentrates_stress_as_the_closed_form_says) {
  const Hole& hole = GetParam();
  const double n2 = hole.coupling_number * hole.coupling_number;
  const ElasticParameters<2> parameters{2 * (1 + hole.poisson_ratio), hole.poisson_ratio, n2 / (1 - n2),
                                        std::sqrt(2.0) / hole.radius_over_length, Vector7::Zero()};
  const TimeTable zero = TimeTable::constant(0.0);
  Problem<2> problem;
  problem.mesh = quarter_plate();
  problem.materials["all"] = std::make_shared<LocalMaterial<ElasticLaw<2>>>(ElasticLaw<2>(parameters));
  problem.prescribed = {{"top", Dof::u1, zero, {}},
                        {"top", Dof::w, zero, {}},
                        {"bottom", Dof::u2, zero, {}},
                        {"bottom", Dof::w, zero, {}}};
  problem.boundary_loads.push_back({.on = "pulled"});
  problem.boundary_loads.back().traction[0] = TimeTable::ramp(1.0);
  Solver<2> solver(std::move(problem), {});
  ASSERT_TRUE(solver.equilibrate().converged);
  ASSERT_TRUE(solver.advance(1.0).converged);
  const double error = stress_at_the_hole(solver) / hole.concentration - 1;
  std::cout << "[figure] E.2 nu " << hole.poisson_ratio << ", a/b " << hole.radius_over_length << ", N "
            << hole.coupling_number << ": K " << stress_at_the_hole(solver) << ", exact "
            << hole.concentration << ", relative error " << error << '\n';
  EXPECT_LT(std::abs(error), 2e-3);  // what docs/theory.md expects of a graded mesh
}

INSTANTIATE_TEST_SUITE_P(Table, HoleTest,
                         ::testing::Values(Hole{0.3, 1.063, 0.25, 2.84937}, Hole{0.3, 1.063, 0.50, 2.55485},
                                           Hole{0.3, 1.063, 0.75, 2.28659}, Hole{0.3, 1.063, 0.90, 2.15796},
                                           Hole{0.3, 10.63, 0.50, 2.93553}, Hole{0.3, 10.63, 0.90, 2.92334},
                                           Hole{0.25, 1.0, 0.50, 2.52445}, Hole{0.0, 3.0, 0.70, 2.50315},
                                           Hole{0.49, 2.0, 0.30, 2.86513}));

}  // namespace
