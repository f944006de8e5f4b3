// SPDX-License-Identifier: GPL-2.0-or-later
// Meshes of Gmsh in space: groups, order of nodes, sides, and words about what is not read.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <map>

#include "common/error.hpp"
#include "fem/element/kinematics.hpp"
#include "fem/mesh/gmsh.hpp"
#include "fem/mesh/gmsh_content.hpp"

using namespace polargrain;
using namespace polargrain::fem;

namespace {

const std::filesystem::path kDataOfGmshSpace = "tests/data/fem/space";

using Place = Eigen::Vector3d;

/// Outward area vector of a side.
Place area_of(const Mesh<3>& mesh, const BoundarySide& side) {
  const ElementType<2>& type = *mesh.side_of(side).type;
  const std::vector<int> nodes = mesh.side_nodes(side);
  Place area = Place::Zero();
  for (const QuadraturePoint<2>& point : type.quadrature) {
    const ShapeFunctions<2> shape = type.shape_functions(point.position);
    Eigen::Matrix<double, 3, 2> tangents = Eigen::Matrix<double, 3, 2>::Zero();
    for (std::size_t a = 0; a < nodes.size(); ++a)
      tangents +=
          mesh.nodes[static_cast<std::size_t>(nodes[a])] * shape.derivative.row(static_cast<Eigen::Index>(a));
    area += point.weight * tangents.col(0).cross(tangents.col(1));
  }
  return area;
}

double volume_of(const Mesh<3>& mesh, int element) {
  double volume = 0.0;
  for (const PointGeometry<3>& point : point_geometries<3>(
           *mesh.elements[static_cast<std::size_t>(element)].type, mesh.element_positions(element)))
    volume += point.volume;
  return volume;
}

/// Middle nodes of straight elements lie half way between the ends of their edge: any other order of nodes shows.
void expect_nodes_in_order(const Mesh<3>& mesh) {
  for (const Element<3>& element : mesh.elements) {
    const auto& reference = element.type->node_positions;
    const auto at = [&](std::size_t a) { return mesh.nodes[static_cast<std::size_t>(element.nodes[a])]; };
    const auto corners = static_cast<std::size_t>(element.type->corners);
    for (std::size_t a = corners; a < reference.size(); ++a) {
      double nearest = HUGE_VAL;
      for (std::size_t b = 0; b < corners; ++b)
        for (std::size_t c = b + 1; c < corners; ++c)
          if (2.0 * reference[a] == reference[b] + reference[c])
            nearest = std::min(nearest, (at(a) - 0.5 * (at(b) + at(c))).norm());
      EXPECT_LT(nearest, 1e-11) << element.type->name << " node " << a;
    }
  }
}

class GmshBody : public ::testing::TestWithParam<std::string> {};

/// Two unit cubes side by side along x1. Gmsh writes 16 digits of what it computed to about 1e-13, hence 1e-11.
TEST_P(GmshBody, HasItsGroupsAndItsNodesInOrder) {
  const Mesh<3> mesh = read_gmsh<3>(kDataOfGmshSpace / GetParam());
  EXPECT_TRUE(distorted_elements(mesh).empty());
  expect_nodes_in_order(mesh);
  for (const char* region : {"soft", "stiff"}) {
    double volume = 0.0;
    for (const int e : mesh.regions.at(region)) {
      volume += volume_of(mesh, e);
      EXPECT_EQ(mesh.element_positions(e).col(0).mean() < 1.0, std::string(region) == "soft");
    }
    EXPECT_NEAR(volume, 1.0, 1e-11) << region;
  }
  EXPECT_EQ(mesh.regions.at("all").size(), mesh.elements.size());
  const std::map<std::string, Place> areas{{"left", {-1, 0, 0}},  {"right", {1, 0, 0}},
                                           {"front", {0, -2, 0}}, {"back", {0, 2, 0}},
                                           {"top", {0, 0, 2}},    {"bottom", {0, 0, -2}}};
  for (const auto& [name, expected] : areas) {
    Place area = Place::Zero();
    for (const BoundarySide& side : mesh.boundaries.at(name)) area += area_of(mesh, side);
    EXPECT_LT((area - expected).norm(), 1e-11) << name;
  }
  // A curve and a point are sets of nodes.
  for (const int node : mesh.nodes_on("foot")) {
    EXPECT_EQ(mesh.nodes[static_cast<std::size_t>(node)](0), 0.0);
    EXPECT_EQ(mesh.nodes[static_cast<std::size_t>(node)](2), 0.0);
  }
  EXPECT_GE(mesh.nodes_on("foot").size(), 3U);
  EXPECT_EQ(mesh.nodes[static_cast<std::size_t>(mesh.nodes_on("origin").at(0))], Place(0, 0, 0));
  for (const Place& node : mesh.nodes)
    EXPECT_LE(node(0), 2.0 + 1e-11);  // a point for construction lies beyond
}

/// The same blocks seen in a mirror: Gmsh writes such elements where a surface is drawn out against its normal.
TEST_P(GmshBody, MirroredElementsAreTurnedRound) {
  GmshContent content = read_gmsh_content(kDataOfGmshSpace / GetParam());
  for (GmshContent::Node& node : content.nodes) node.position[0] *= -1.0;
  const Mesh<3> mesh = mesh_of<3>("mirror.msh", content);
  EXPECT_TRUE(distorted_elements(mesh).empty());
  expect_nodes_in_order(mesh);
  Place area = Place::Zero();
  for (const BoundarySide& side : mesh.boundaries.at("right")) area += area_of(mesh, side);
  EXPECT_LT((area - Place(-1, 0, 0)).norm(), 1e-11);
}

INSTANTIATE_TEST_SUITE_P(Files, GmshBody,
                         ::testing::Values("two_blocks_hex20.msh", "two_blocks_hex20_msh2.msh",
                                           "two_blocks_hex8.msh", "two_blocks_tet10.msh",
                                           "two_blocks_wedge15.msh"));

TEST(GmshBody, ElementsAreThoseOfTheFile) {
  const auto name_in = [](const char* file, std::string_view serendipity = "H20R") {
    return read_gmsh<3>(kDataOfGmshSpace / file, serendipity).elements.front().type->name;
  };
  EXPECT_EQ(name_in("two_blocks_hex20.msh"), "H20R");
  EXPECT_EQ(name_in("two_blocks_hex20.msh", "H20"), "H20");
  EXPECT_EQ(name_in("two_blocks_hex8.msh"), "H8");
  EXPECT_EQ(name_in("two_blocks_hex8.msh", "H8R"), "H8R");
  EXPECT_EQ(name_in("two_blocks_tet10.msh"), "T10");
  EXPECT_EQ(name_in("two_blocks_wedge15.msh"), "W15");
}

/// The unit cube, from either of two groups, and its base, which begins elsewhere and runs round the other way.
TEST(GmshBody, WhatIsWrittenTwiceCountsOnce) {
  GmshContent content;
  const std::vector<std::array<double, 3>> corners{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                                   {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  for (std::size_t k = 0; k < corners.size(); ++k) content.nodes.push_back({k + 1, corners[k]});
  content.blocks = {{3, 1, 5, 8, {1, 2, 3, 4, 5, 6, 7, 8}},
                    {3, 2, 5, 8, {2, 3, 4, 1, 6, 7, 8, 5}},
                    {2, 1, 3, 4, {1, 2, 3, 4, 3, 2, 1, 4}}};
  content.groups = {{3, "ground", {1}}, {3, "part", {2}}, {2, "base", {1}}};
  const Mesh<3> mesh = mesh_of<3>("a.msh", content);
  ASSERT_EQ(mesh.elements.size(), 1U);
  EXPECT_NEAR(volume_of(mesh, 0), 1.0, 1e-14);
  EXPECT_EQ(mesh.regions.at("ground"), mesh.regions.at("part"));
  ASSERT_EQ(mesh.boundaries.at("base").size(), 1U);
  EXPECT_NEAR(area_of(mesh, mesh.boundaries.at("base").front()).z(), -1.0, 1e-14);
}

TEST(GmshBody, SaysWhatToWriteForElementsThatAreNotRead) {
  const auto fault_of = [](const auto& make) -> std::string {
    try {
      (void)make();
    } catch (const InputError& error) {
      return error.faults().front().message;
    }
    return "no fault";
  };
  EXPECT_NE(fault_of([] {
              return read_gmsh<3>(kDataOfGmshSpace / "two_blocks_hex27.msh");
            }).find("hexahedra of 27 nodes: set Mesh.SecondOrderIncomplete = 1 to get 20"),
            std::string::npos);
  EXPECT_NE(fault_of([] {
              return read_gmsh<3>(kDataOfGmshSpace / "two_blocks_tet4.msh");
            }).find("tetrahedra of 4 nodes, too stiff to be offered: set Mesh.ElementOrder = 2"),
            std::string::npos);
  // Where the plane is asked for, and where a name stands for a surface and for a curve.
  EXPECT_NE(fault_of([] {
              return read_gmsh<2>(kDataOfGmshSpace / "two_blocks_hex20.msh");
            }).find("volume elements"),
            std::string::npos);
  GmshContent content = read_gmsh_content(kDataOfGmshSpace / "two_blocks_hex8.msh");
  for (GmshContent::Group& group : content.groups)
    if (group.name == "foot") group.name = "left";
  EXPECT_NE(fault_of([&] { return mesh_of<3>("a.msh", content); }).find("give each its own"),
            std::string::npos);
  // A volume without a name beside one that has one: half of the body would be missing.
  GmshContent half = read_gmsh_content(kDataOfGmshSpace / "two_blocks_hex8.msh");
  std::vector<int> entities;
  for (const GmshContent::Block& block : half.blocks)
    if (block.dimension == 3) entities.push_back(block.entity);
  ASSERT_GE(entities.size(), 2U);
  std::erase_if(half.groups, [](const GmshContent::Group& group) { return group.dimension == 3; });
  half.groups.push_back({3, "ground", {entities.front()}});
  EXPECT_NE(fault_of([&] {
              return mesh_of<3>("a.msh", half);
            }).find("has elements and no physical name, while others have one"),
            std::string::npos);
  // Surfaces alone: Gmsh leaves the volumes out where no volume has a name.
  std::erase_if(content.blocks, [](const auto& block) { return block.dimension == 3; });
  std::erase_if(content.groups, [](const auto& group) { return group.dimension == 3; });
  EXPECT_EQ(dimension_of(content), 2);
  EXPECT_NE(fault_of([&] { return mesh_of<2>("a.msh", content); }).find("Physical Volume"),
            std::string::npos);
}

}  // namespace
