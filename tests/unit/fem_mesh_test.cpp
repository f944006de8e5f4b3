// SPDX-License-Identifier: GPL-2.0-or-later
#include <gtest/gtest.h>

#include "common/error.hpp"
#include "fem/element/kinematics.hpp"
#include "fem/mesh/rectangle.hpp"

using namespace polargrain;
using namespace polargrain::fem;

namespace {

class EveryElement : public ::testing::TestWithParam<std::string> {};

double area(const Mesh<2>& mesh) {
  double sum = 0.0;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    for (const PointGeometry<2>& point :
         point_geometries(*mesh.elements[e].type, mesh.element_positions(static_cast<int>(e)))) {
      sum += point.volume;
    }
  }
  return sum;
}

TEST_P(EveryElement, fills_a_rectangle) {
  const Mesh<2> mesh = rectangle({{0.04, 0.08}, {3, 5}, {1.0, -2.0}}, GetParam());
  EXPECT_TRUE(distorted_elements(mesh).empty());
  EXPECT_NEAR(area(mesh), 0.04 * 0.08, 1e-16);  // quadrature of a constant: rounding only
}

TEST_P(EveryElement, boundaries_lie_on_the_outline_and_point_outwards) {
  const Mesh<2> mesh = rectangle({{2.0, 1.0}, {3, 2}}, GetParam());
  const std::map<std::string, Eigen::Vector2d> normals{
      {"left", {-1, 0}}, {"right", {1, 0}}, {"bottom", {0, -1}}, {"top", {0, 1}}};
  for (const auto& [name, normal] : normals) {
    double length = 0.0;
    for (const BoundarySide& edge : mesh.boundaries.at(name)) {
      const std::vector<int> numbers = mesh.side_nodes(edge);
      const Eigen::Vector2d along = mesh.nodes[numbers[1]] - mesh.nodes[numbers[0]];
      EXPECT_NEAR(Eigen::Vector2d(along(1), -along(0)).normalized().dot(normal), 1.0, 1e-15) << name;
      length += along.norm();
      if (numbers.size() == 3) {
        EXPECT_LT((mesh.nodes[numbers[2]] - 0.5 * (mesh.nodes[numbers[0]] + mesh.nodes[numbers[1]])).norm(),
                  1e-15);
      }
    }
    EXPECT_NEAR(length, normal(0) != 0.0 ? 1.0 : 2.0, 1e-15) << name;
    for (const int node : mesh.nodes_on(name)) {
      const Eigen::Vector2d outwards = mesh.nodes[node] - Eigen::Vector2d(1.0, 0.5);
      EXPECT_NEAR(outwards.dot(normal), normal(0) != 0.0 ? 1.0 : 0.5, 1e-15) << name;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Elements, EveryElement, ::testing::ValuesIn(element_names<2>()));

TEST(rectangle, names_its_corners) {
  const Mesh<2> mesh = rectangle({{2.0, 1.0}, {3, 2}});
  EXPECT_EQ(mesh.nodes[mesh.nodes_on("top_right").at(0)], Eigen::Vector2d(2.0, 1.0));
  EXPECT_EQ(mesh.nodes[mesh.nodes_on("bottom_left").at(0)], Eigen::Vector2d(0.0, 0.0));
  EXPECT_EQ(mesh.nodes_on("all").size(), 4U * 3U + 3U * 3U + 4U * 2U);
}

TEST(rectangle, refuses_what_it_cannot_divide) {
  EXPECT_THROW(rectangle({{2.0, -1.0}, {3, 2}}), RunError);
  EXPECT_THROW(rectangle({{2.0, 1.0}, {3, 0}}), RunError);
  EXPECT_THROW(rectangle({{2.0, 1.0}, {3, 2}}, "Q9"), RunError);
}

TEST(mesh, names_a_distorted_element) {
  Mesh<2> mesh = rectangle({{2.0, 1.0}, {2, 1}}, "Q4");
  std::swap(mesh.elements[1].nodes[0], mesh.elements[1].nodes[2]);
  std::swap(mesh.elements[1].nodes[0], mesh.elements[1].nodes[1]);
  const auto messages = distorted_elements(mesh);
  ASSERT_EQ(messages.size(), 1U);
  EXPECT_NE(messages[0].find("element 1 (Q4)"), std::string::npos) << messages[0];
}

TEST(mesh, unknown_names_are_an_error_that_lists_the_known_ones) {
  const Mesh<2> mesh = rectangle({{2.0, 1.0}, {2, 1}});
  try {
    (void)mesh.nodes_on("topp");
    FAIL();
  } catch (const RunError& error) {
    EXPECT_NE(std::string(error.what()).find("top_left"), std::string::npos);
  }
}

}  // namespace
