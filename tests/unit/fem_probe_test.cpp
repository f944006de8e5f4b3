// SPDX-License-Identifier: GPL-2.0-or-later
// Values at places inside of the body, against fields that are known everywhere.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "fem/material/elastic.hpp"
#include "fem/material/local_material.hpp"
#include "fem/mesh/box.hpp"
#include "fem/mesh/rectangle.hpp"
#include "fem/mesh/split.hpp"
#include "fem/output/probe.hpp"
#include "fem/solver/geostatic.hpp"

using namespace polargrain;
using namespace polargrain::fem;

namespace {

const TimeTable kZeroOfProbe = TimeTable::constant(0.0);
constexpr double kWeight = 18e3;

template <int dim>
std::shared_ptr<Material<dim>> elastic_probed() {
  return std::make_shared<LocalMaterial<ElasticLaw<dim>>>(
      ElasticLaw<dim>(ElasticParameters<dim>{20e6, 0.25, 8e6, 0.2}));
}

class ProbedElement : public ::testing::TestWithParam<std::string> {};

TEST_P(ProbedElement, ground_at_rest_has_the_stress_of_its_depth_at_any_place) {
  Problem<2> problem;
  problem.mesh = rectangle({{4.0, 3.0}, {4, 3}}, GetParam());
  // Columns of unequal width, with straight sides: a linear stress is then linear in the reference element too.
  const std::array<double, 5> columns{0.0, 0.7, 2.1, 3.0, 4.0};
  for (Eigen::Vector2d& node : problem.mesh.nodes) {
    const auto column = std::min(static_cast<std::size_t>(node.x()), std::size_t{3});
    node.x() =
        columns[column] + (node.x() - static_cast<double>(column)) * (columns[column + 1] - columns[column]);
  }
  problem.materials["all"] = elastic_probed<2>();
  problem.prescribed = {
      {"left", Dof::u1, kZeroOfProbe}, {"right", Dof::u1, kZeroOfProbe}, {"bottom", Dof::u2, kZeroOfProbe}};
  problem.body_loads = {gravity(kWeight)};
  problem.initial_stresses = {geostatic_stress({3.0, kWeight, 0.5, 10e3})};
  problem.boundary_loads = {{.on = "top", .pressure = TimeTable::constant(10e3)}};
  Solver<2> solver(std::move(problem), {});
  ASSERT_TRUE(solver.equilibrate().converged);
  for (const Eigen::Vector2d& place :
       std::vector<Eigen::Vector2d>{{0.3, 0.2}, {2.0, 1.0}, {0.0, 0.0}, {3.9, 2.95}, {1.7, 2.0}}) {
    const Vector7 stress = stress_at(solver, find_place(solver.problem().mesh, place));
    // An element with one point has the stress of its middle everywhere.
    const double height = GetParam() == "Q4R" ? std::floor(place.y()) + 0.5 : place.y();
    if (GetParam() == "Q4R" && place.y() == std::floor(place.y())) continue;  // between two of them
    const double vertical = -(10e3 + kWeight * (3.0 - height));
    EXPECT_NEAR(stress(k22), vertical, 1e-6) << place.transpose();
    EXPECT_NEAR(stress(k11), 0.5 * vertical, 1e-6);
  }
}

INSTANTIATE_TEST_SUITE_P(Elements, ProbedElement, ::testing::ValuesIn(element_names<2>()));

TEST(displacement_at, a_place_of_stretched_ground_is_that_of_the_stretch) {
  Problem<3> problem;
  problem.mesh = box({{2.0, 1.0, 3.0}, {2, 1, 3}}, "H20R");
  problem.materials["all"] = elastic_probed<3>();
  problem.prescribed = {{"left", Dof::u1, kZeroOfProbe},   {"front", Dof::u2, kZeroOfProbe},
                        {"bottom", Dof::u3, kZeroOfProbe}, {"right", Dof::u1, kZeroOfProbe},
                        {"back", Dof::u2, kZeroOfProbe},   {"top", Dof::u3, TimeTable::constant(-3e-3)}};
  Solver<3> solver(std::move(problem), {});
  ASSERT_TRUE(solver.equilibrate().converged);
  const Probe<3> probe = find_place<3>(solver.problem().mesh, {1.0, 0.4, 1.3});
  EXPECT_EQ(probe.elements.size(), 2U);  // on the face between two elements
  EXPECT_NEAR(displacement_at(solver, probe)(2), -1.3e-3, 1e-15);
  const double oedometric = 20e6 * (1 - 0.25) / ((1 + 0.25) * (1 - 2 * 0.25));
  EXPECT_NEAR(stress_at(solver, probe)(8), -1e-3 * oedometric, 1e-6);
}

// A place inside belongs to one element, and its reference coordinates lead back to it; wedges and tetrahedra too.
TEST(find_place, every_place_of_a_cube_is_found_once) {
  for (const std::string& element : element_names<3>()) {
    const Mesh<3> mesh = box({{2.0, 1.0, 3.0}, {2, 1, 2}}, element);
    for (const Eigen::Vector3d& place : std::vector<Eigen::Vector3d>{{0.31, 0.17, 0.4}, {1.9, 0.83, 2.71}}) {
      const Probe<3> probe = find_place<3>(mesh, place);
      ASSERT_EQ(probe.elements.size(), 1U) << element;
      const auto& inside = probe.elements.front();
      const ElementType<3>& type = *mesh.elements[static_cast<std::size_t>(inside.element)].type;
      const Eigen::Vector3d back =
          mesh.element_positions(inside.element).transpose() * type.shape_functions(inside.reference).value;
      EXPECT_LT((back - place).norm(), 1e-12) << element;
    }
  }
}

// An interface from the lower edge up to the middle: the tip, a node of elements on both sides, is one place.
TEST(sides_at, a_place_has_two_where_an_interface_or_a_border_parts_it) {
  Mesh<2> mesh = rectangle({{2.0, 2.0}, {2, 2}});
  for (std::size_t node = 0; node < mesh.nodes.size(); ++node)
    if (mesh.nodes[node].x() == 1.0 && mesh.nodes[node].y() <= 1.0)
      mesh.node_sets["joint"].push_back(static_cast<int>(node));
  std::vector<std::vector<TwoSidedFace<2>>> faces{faces_along(mesh, "joint")};
  split_along(mesh, faces);
  const auto sides = [&](double x, double y, const std::vector<int>& materials = {}) {
    return sides_at(mesh, find_place<2>(mesh, {x, y}), materials).size();
  };
  EXPECT_EQ(sides(1.0, 0.0), 2U);
  EXPECT_EQ(sides(1.0, 0.7), 2U);
  EXPECT_EQ(sides(1.0, 1.0), 1U);
  EXPECT_EQ(sides(1.0, 1.5), 1U);
  EXPECT_EQ(sides(0.5, 1.0), 1U);
  EXPECT_EQ(sides(0.5, 1.0, {1, 1, 2, 2}), 2U);  // the upper row is of another material
  EXPECT_EQ(sides(0.5, 0.5, {1, 1, 2, 2}), 1U);
}

TEST(find_place, outside_of_the_body_finds_nothing) {
  Problem<2> problem;
  problem.mesh = rectangle({{4.0, 3.0}, {4, 3}});
  EXPECT_TRUE(find_place<2>(problem.mesh, {4.1, 1.0}).elements.empty());
  EXPECT_EQ(find_place<2>(problem.mesh, {2.0, 1.0}).elements.size(), 4U);
  problem.materials["all"] = elastic_probed<2>();
  problem.prescribed = {
      {"left", Dof::u1, kZeroOfProbe}, {"bottom", Dof::u2, kZeroOfProbe}, {"bottom", Dof::w, kZeroOfProbe}};
  Solver<2> solver(std::move(problem), {});
  ASSERT_TRUE(solver.equilibrate().converged);
  EXPECT_TRUE(std::isnan(stress_at(solver, find_place<2>(solver.problem().mesh, {5.0, 1.0}))(k11)));
}

}  // namespace
