// SPDX-License-Identifier: GPL-2.0-or-later
// The built-in cylinder: volume, area, names and sectors.
#include <gtest/gtest.h>

#include <cmath>

#include "common/error.hpp"
#include "fem/element/kinematics.hpp"
#include "fem/mesh/cylinder.hpp"

using namespace polargrain;
using namespace polargrain::fem;

namespace {

using Sector = CylinderSpecification::Sector;
using Place = Eigen::Vector3d;

double volume(const Mesh<3>& mesh) {
  double sum = 0.0;
  for (int e = 0; e < static_cast<int>(mesh.elements.size()); ++e)
    for (const PointGeometry<3>& point :
         point_geometries<3>(*mesh.elements[static_cast<std::size_t>(e)].type, mesh.element_positions(e)))
      sum += point.volume;
  return sum;
}

/// Outward area vector of a boundary, and its area.
std::pair<Place, double> area(const Mesh<3>& mesh, const std::string& name) {
  Place sum = Place::Zero();
  double norm = 0.0;
  for (const BoundarySide& side : mesh.boundaries.at(name)) {
    const ElementType<2>& type = *mesh.side_of(side).type;
    const std::vector<int> nodes = mesh.side_nodes(side);
    for (const QuadraturePoint<2>& point : type.quadrature) {
      const ShapeFunctions<2> shape = type.shape_functions(point.position);
      Eigen::Matrix<double, 3, 2> tangents = Eigen::Matrix<double, 3, 2>::Zero();
      for (std::size_t a = 0; a < nodes.size(); ++a)
        tangents += mesh.nodes[static_cast<std::size_t>(nodes[a])] *
                    shape.derivative.row(static_cast<Eigen::Index>(a));
      const Place normal = point.weight * tangents.col(0).cross(tangents.col(1));
      sum += normal;
      norm += normal.norm();
    }
  }
  return {sum, norm};
}

TEST(Cylinder, HasItsVolumeAndItsFaces) {
  const CylinderSpecification of{0.5, 2.0, 4, 2, 3};
  const Mesh<3> mesh = cylinder(of);
  EXPECT_EQ(mesh.elements.size(), static_cast<std::size_t>(number_of_elements(of)));
  EXPECT_TRUE(distorted_elements(mesh).empty());
  // Sixteen parabolas through three points of the circle each: chord and sagitta of half a sixteenth of it.
  const double half = M_PI / 16.0;
  const double face = 16.0 * 0.25 * std::sin(half) * (std::cos(half) + 4.0 / 3.0 * (1.0 - std::cos(half)));
  EXPECT_LT(face, M_PI * 0.25);
  EXPECT_NEAR(volume(mesh), face * 2.0, 1e-13);
  EXPECT_NEAR(area(mesh, "bottom").first(2), -face, 1e-13);
  EXPECT_NEAR(area(mesh, "top").first(2), face, 1e-13);
  EXPECT_NEAR(area(mesh, "side").second, 2.0 * M_PI * 0.5 * 2.0, 3e-4);
  EXPECT_LT(area(mesh, "side").first.norm(), 1e-13);
  EXPECT_EQ(mesh.boundaries.size(), 3U);
  for (const int node : mesh.nodes_on("side"))
    EXPECT_NEAR(mesh.nodes[static_cast<std::size_t>(node)].head<2>().norm(), 0.5, 1e-15);
  EXPECT_EQ(mesh.nodes_on("axis").size(), 2U * 3U + 1U);
  EXPECT_EQ(mesh.nodes[static_cast<std::size_t>(mesh.nodes_on("top_axis").at(0))], Place(0, 0, 2));
  EXPECT_EQ(mesh.nodes[static_cast<std::size_t>(mesh.nodes_on("bottom_side_right").at(0))], Place(0.5, 0, 0));
  EXPECT_EQ(mesh.nodes[static_cast<std::size_t>(mesh.nodes_on("bottom_side_back").at(0))], Place(0, 0.5, 0));
  EXPECT_EQ(mesh.nodes[static_cast<std::size_t>(mesh.nodes_on("top_side_left").at(0))], Place(-0.5, 0, 2));
  EXPECT_EQ(mesh.nodes_on("bottom_side").size(), 32U);  // two nodes an element around
}

TEST(Cylinder, SectorsAreCutByPlanesOfSymmetry) {
  const double whole = volume(cylinder({0.5, 1.0, 2, 1, 2}));
  const CylinderSpecification of_half{0.5, 1.0, 2, 1, 2, Sector::half};
  const CylinderSpecification of_quarter{0.5, 1.0, 2, 1, 2, Sector::quarter};
  const Mesh<3> half = cylinder(of_half);
  const Mesh<3> quarter = cylinder(of_quarter);
  EXPECT_EQ(half.elements.size(), static_cast<std::size_t>(number_of_elements(of_half)));
  EXPECT_EQ(quarter.elements.size(), static_cast<std::size_t>(number_of_elements(of_quarter)));
  EXPECT_NEAR(volume(half), 0.5 * whole, 1e-14);
  EXPECT_NEAR(volume(quarter), 0.25 * whole, 1e-14);
  EXPECT_LT((area(half, "front").first - Place(0, -1, 0)).norm(), 1e-14);
  EXPECT_EQ(half.boundaries.count("left"), 0U);
  EXPECT_LT((area(quarter, "front").first - Place(0, -0.5, 0)).norm(), 1e-14);
  EXPECT_LT((area(quarter, "left").first - Place(-0.5, 0, 0)).norm(), 1e-14);
  for (const Place& node : quarter.nodes) EXPECT_GE(node.minCoeff(), 0.0);
}

TEST(Cylinder, RefusesWhatItCannotDivide) {
  EXPECT_THROW(cylinder({0.0, 1.0, 2, 1, 1}), RunError);
  EXPECT_THROW(cylinder({1.0, -1.0, 2, 1, 1}), RunError);
  EXPECT_THROW(cylinder({1.0, 1.0, 3, 1, 1}), RunError);
  EXPECT_THROW(cylinder({1.0, 1.0, 2, 0, 1}), RunError);
  EXPECT_THROW(cylinder({1.0, 1.0, 2, 1, 1}, "T10"), RunError);
}

}  // namespace
