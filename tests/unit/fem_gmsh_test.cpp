// SPDX-License-Identifier: GPL-2.0-or-later
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "common/error.hpp"
#include "fem/element/kinematics.hpp"
#include "fem/mesh/gmsh.hpp"
#include "fem/mesh/gmsh_content.hpp"

using namespace polargrain;
using namespace polargrain::fem;

namespace {

const std::filesystem::path kData = "tests/data/fem";

class GmshFile : public ::testing::TestWithParam<std::string> {};

/// Gmsh writes 16 digits of what it computed to about 1e-13, hence 1e-11. Two unit squares side by side,
/// `soft` and `stiff`; Gmsh's surface of the second is clockwise, and one of its points belongs to no
/// element.
TEST_P(GmshFile, has_its_groups_and_counter_clockwise_elements) {
  const Mesh<2> mesh = read_gmsh(kData / GetParam());
  EXPECT_TRUE(distorted_elements(mesh).empty());
  for (const char* region : {"soft", "stiff"}) {
    double area = 0.0;
    for (const int e : mesh.regions.at(region)) {
      for (const PointGeometry<2>& point :
           point_geometries(*mesh.elements[static_cast<std::size_t>(e)].type, mesh.element_positions(e))) {
        area += point.volume;
        EXPECT_EQ(point.position(0) < 1.0, std::string(region) == "soft");
      }
    }
    EXPECT_NEAR(area, 1.0, 1e-11) << region;
  }
  EXPECT_EQ(mesh.regions.at("all").size(), mesh.elements.size());
  const std::map<std::string, double> lengths{{"left", 1}, {"right", 1}, {"bottom", 2}, {"top", 2}};
  for (const auto& [name, expected] : lengths) {
    double length = 0.0;
    Eigen::Vector2d outwards = Eigen::Vector2d::Zero();
    for (const BoundarySide& edge : mesh.boundaries.at(name)) {
      const std::vector<int> nodes = mesh.side_nodes(edge);
      const Eigen::Vector2d along = mesh.nodes[nodes[1]] - mesh.nodes[nodes[0]];
      length += along.norm();
      outwards += Eigen::Vector2d(along(1), -along(0));
      ASSERT_EQ(nodes.size(), 3U);
      EXPECT_LT((mesh.nodes[nodes[2]] - 0.5 * (mesh.nodes[nodes[0]] + mesh.nodes[nodes[1]])).norm(), 1e-11);
    }
    EXPECT_NEAR(length, expected, 1e-11) << name;
    const Eigen::Vector2d& on = mesh.nodes[mesh.nodes_on(name).front()];
    EXPECT_GT(outwards.dot(on - Eigen::Vector2d(1.0, 0.5)), 0.0) << name;
  }
  EXPECT_EQ(mesh.nodes[mesh.nodes_on("origin").at(0)], Eigen::Vector2d(0, 0));
  for (const Eigen::Vector2d& node : mesh.nodes) EXPECT_LE(node(0), 2.0);
}

INSTANTIATE_TEST_SUITE_P(Files, GmshFile,
                         ::testing::Values("two_blocks_q8_msh2.msh", "two_blocks_q8_msh4.msh",
                                           "two_blocks_t6_msh2.msh", "two_blocks_t6_msh4.msh"));

TEST(gmsh, both_versions_of_the_format_give_the_same_mesh) {
  const Mesh<2> two = read_gmsh(kData / "two_blocks_q8_msh2.msh");
  const Mesh<2> four = read_gmsh(kData / "two_blocks_q8_msh4.msh");
  EXPECT_EQ(two.nodes.size(), four.nodes.size());
  EXPECT_EQ(two.elements.size(), 8U);
  EXPECT_EQ(four.elements.size(), 8U);
}

/// The message of the InputError that reading the text gives.
std::string fault_of(const std::string& content) {
  const auto file =
      std::filesystem::temp_directory_path() / (std::to_string(getpid()) + "_fem_gmsh_test.msh");
  std::ofstream(file) << content;
  try {
    (void)read_gmsh(file);
  } catch (const InputError& error) {
    return error.faults().front().text();
  }
  return "no fault";
}

TEST(gmsh, says_what_is_wrong_with_a_file) {
  EXPECT_THROW(read_gmsh("nowhere.msh"), InputError);
  EXPECT_NE(fault_of("not a mesh").find("fem_gmsh_test.msh"), std::string::npos);
  const std::string head = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n3\n1 0 0 0\n2 1 0 0\n3 0 1 ";
  const std::string triangle = "\n$EndNodes\n$Elements\n1\n1 2 2 1 1 1 2 3\n$EndElements\n";
  EXPECT_NE(fault_of(head + "0" + triangle).find("Mesh.ElementOrder = 2"), std::string::npos);
  EXPECT_NE(fault_of(head + "0.5" + triangle).find("z = 0"), std::string::npos);
  EXPECT_NE(fault_of(head + "0\n$EndNodes\n").find("no surface elements"), std::string::npos);
}

// Two squares. Groups of version 2 are those of elements, and Gmsh's library makes them those of whole surfaces.
TEST(gmsh, groups_that_share_a_surface_are_told) {
  const std::string head =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n2 1 \"ground\"\n2 6 \"part\"\n"
      "$EndPhysicalNames\n$Nodes\n6\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 2 0 0\n6 2 1 0\n$EndNodes\n$Elements\n";
  const auto fault = [&head](const std::string& elements) {
    return fault_of(head + elements + "$EndElements\n");
  };
  const std::string part = "of its elements in surface 1 only some are in physical group 6";
  EXPECT_NE(fault("2\n1 3 2 1 1 1 2 3 4\n2 3 2 6 1 2 5 6 3\n").find("in surface 1 only some"),
            std::string::npos);
  EXPECT_EQ(fault("2\n1 3 2 1 1 1 2 3 4\n2 3 2 6 2 2 5 6 3\n"), "no fault");
  EXPECT_NE(fault("3\n1 3 2 1 1 1 2 3 4\n2 3 2 1 1 2 5 6 3\n3 3 2 6 1 1 2 3 4\n").find(part),
            std::string::npos);
  EXPECT_EQ(fault("3\n1 3 2 1 1 1 2 3 4\n2 3 2 1 2 2 5 6 3\n3 3 2 6 1 1 2 3 4\n"), "no fault");
  EXPECT_NE(fault("2\n1 3 2 6 1 1 2 3 4\n2 3 2 0 1 2 5 6 3\n").find(part), std::string::npos);  // in no group
}

// Gmsh's own language runs programs, and Gmsh reads it where nobody expects it: in a mesh that begins as a script, and in
// NAME.msh.opt beside NAME.msh.
TEST(gmsh, runs_no_script_that_comes_with_a_mesh) {
  const auto folder = std::filesystem::temp_directory_path() / ("fem_gmsh_script" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  const std::string command = "SystemCall \"touch " + (folder / "was_here").string() + "\";\n";
  std::filesystem::copy(kData / "two_blocks_q8_msh4.msh", folder / "mesh.msh");
  std::ofstream(folder / "mesh.msh.opt") << command;
  EXPECT_EQ(read_gmsh(folder / "mesh.msh").elements.size(), 8U);
  EXPECT_FALSE(std::filesystem::exists(folder / "was_here"));
  for (const std::string& begin : {std::string(), std::string("\n"), std::string(" $MeshFormat\n")}) {
    std::ofstream(folder / "script.msh") << begin << command;
    EXPECT_THROW(read_gmsh(folder / "script.msh"), InputError);
    EXPECT_FALSE(std::filesystem::exists(folder / "was_here")) << begin;
  }
  std::filesystem::remove_all(folder);
}

/// Content that Gmsh would not hand over, were it without faults.
TEST(gmsh, content_that_does_not_fit_together_is_refused_in_words) {
  const GmshContent whole{{{1, {0, 0, 0}}, {2, {1, 0, 0}}, {3, {1, 1, 0}}, {4, {0, 1, 0}}},
                          {{2, 1, 3, 4, {1, 2, 3, 4}}, {1, 1, 1, 2, {1, 2}}, {0, 1, 15, 1, {1}}},
                          {{1, "bottom", {1}}, {0, "origin", {1}}},
                          ""};
  EXPECT_EQ(mesh_of("a.msh", whole).boundaries.at("bottom").size(), 1U);
  const auto expect_refused = [&whole](const auto& spoil, const std::string& words) {
    GmshContent spoiled = whole;
    spoil(spoiled);
    try {
      (void)mesh_of("a.msh", spoiled);
      FAIL() << words;
    } catch (const InputError& error) {
      EXPECT_NE(error.faults().front().message.find(words), std::string::npos) << error.what();
    }
  };
  expect_refused([](GmshContent& c) { c.blocks[0].nodes[2] = 7; }, "has the node 7, which is not there");
  expect_refused([](GmshContent& c) { c.blocks[0].nodes.pop_back(); }, "nodes missing");
  expect_refused([](GmshContent& c) { c.blocks[0].nodes_per_element = 0; }, "nodes missing");
  expect_refused([](GmshContent& c) { c.blocks[0].kind = 16; }, "nodes missing");
  expect_refused([](GmshContent& c) { c.blocks[1].nodes_per_element = 1; }, "nodes missing");
  expect_refused([](GmshContent& c) { c.nodes[1].position[0] = NAN; }, "not finite");
  expect_refused([](GmshContent& c) { c.nodes[1].position[2] = NAN; }, "z = 0");
}

/// Two unit squares side by side. Gmsh's version 2 writes an element anew for each group; the copy may begin elsewhere, or run
/// the other way round.
TEST(gmsh, an_element_that_is_written_several_times_is_one) {
  const GmshContent content{
      {{1, {0, 0, 0}}, {2, {1, 0, 0}}, {3, {1, 1, 0}}, {4, {0, 1, 0}}, {5, {2, 0, 0}}, {6, {2, 1, 0}}},
      {{2, 1, 3, 4, {1, 2, 3, 4, 2, 5, 6, 3, 3, 4, 1, 2}}, {2, 2, 3, 4, {4, 3, 2, 1}}},
      {{2, "ground", {1, 2}}, {2, "left", {2}}},
      ""};
  const Mesh<2> mesh = mesh_of("a.msh", content);
  EXPECT_EQ(mesh.elements.size(), 2U);
  EXPECT_EQ(mesh.regions.at("all"), (std::vector<int>{0, 1}));
  EXPECT_EQ(mesh.regions.at("ground"), (std::vector<int>{0, 1}));
  EXPECT_EQ(mesh.regions.at("left"), std::vector<int>{0});
}

/// In whatever direction, and through two curves of one group; another group has the side too.
TEST(gmsh, a_side_that_is_listed_twice_in_a_group_counts_once) {
  const GmshContent content{
      {{1, {0, 0, 0}}, {2, {1, 0, 0}}, {3, {1, 1, 0}}, {4, {0, 1, 0}}},
      {{2, 1, 3, 4, {1, 2, 3, 4}}, {1, 1, 1, 2, {1, 2, 1, 2, 2, 1, 2, 3}}, {1, 2, 1, 2, {2, 1}}},
      {{1, "load", {1, 2}}, {1, "bottom", {2}}},
      ""};
  const Mesh<2> mesh = mesh_of("a.msh", content);
  ASSERT_EQ(mesh.boundaries.at("load").size(), 2U);
  EXPECT_NE(mesh.boundaries.at("load")[0].side, mesh.boundaries.at("load")[1].side);
  EXPECT_EQ(mesh.boundaries.at("bottom").size(), 1U);
}

/// A machine without Gmsh must say what is missing, and where it was looked for.
TEST(GmshModule, that_is_missing_is_named) {
  try {
    (void)read_gmsh(kData / "two_blocks_q8_msh4.msh", "Q8R", {"/nowhere"});
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_EQ(
        error.faults().front().message,
        "mesh files need the module polargrain_gmsh.so, which cannot be loaded (not in /nowhere); install "
        "Gmsh's library (Debian: libgmsh-dev) and build again");
  }
}

}  // namespace
