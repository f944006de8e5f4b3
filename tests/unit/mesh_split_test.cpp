// SPDX-License-Identifier: GPL-2.0-or-later
// Doubling the nodes of a curve or a surface inside of a mesh.
#include <gtest/gtest.h>

#include <set>

#include "common/error.hpp"
#include "fem/mesh/box.hpp"
#include "fem/mesh/rectangle.hpp"
#include "fem/mesh/split.hpp"

using namespace polargrain;
using namespace polargrain::fem;

namespace {

template <int dim>
using Curves = std::vector<std::vector<TwoSidedFace<dim>>>;

/// Names the nodes for which `holds` a set.
template <int dim, class Holds>
void name_nodes(Mesh<dim>& mesh, const std::string& name, Holds holds) {
  for (int node = 0; node < static_cast<int>(mesh.nodes.size()); ++node)
    if (holds(mesh.nodes[static_cast<std::size_t>(node)])) mesh.node_sets[name].push_back(node);
}

template <int dim>
int nodes_at(const Mesh<dim>& mesh, const typename Cosserat<dim>::Place& place) {
  int count = 0;
  for (const auto& node : mesh.nodes) count += (node - place).norm() < 1e-12 ? 1 : 0;
  return count;
}

/// Number of parts of the mesh that share no node.
template <int dim>
std::size_t parts(const Mesh<dim>& mesh) {
  std::vector<int> root(mesh.nodes.size());
  for (std::size_t i = 0; i < root.size(); ++i) root[i] = static_cast<int>(i);
  const auto find = [&](int i) {
    while (root[static_cast<std::size_t>(i)] != i) i = root[static_cast<std::size_t>(i)];
    return i;
  };
  for (const auto& element : mesh.elements)
    for (const int node : element.nodes)
      root[static_cast<std::size_t>(find(node))] = find(element.nodes.front());
  std::set<int> found;
  for (const auto& element : mesh.elements) found.insert(find(element.nodes.front()));
  return found.size();
}

template <int dim>
void expect_pairs_at_one_place(const Mesh<dim>& mesh, const std::vector<TwoSidedFace<dim>>& faces) {
  for (const TwoSidedFace<dim>& face : faces) {
    ASSERT_EQ(face.first_nodes.size(), face.second_nodes.size());
    ASSERT_EQ(face.first_nodes, mesh.side_nodes(face.first));
    const std::vector<int> second = mesh.side_nodes(*face.second);
    EXPECT_EQ(std::set<int>(second.begin(), second.end()),
              std::set<int>(face.second_nodes.begin(), face.second_nodes.end()));
    for (std::size_t a = 0; a < face.first_nodes.size(); ++a)
      EXPECT_EQ(mesh.nodes[static_cast<std::size_t>(face.first_nodes[a])],
                mesh.nodes[static_cast<std::size_t>(face.second_nodes[a])]);
  }
}

class EveryPlaneElement : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Elements, EveryPlaneElement, ::testing::ValuesIn(element_names<2>()));

TEST_P(EveryPlaneElement, a_curve_through_the_body_parts_it_in_two) {
  Mesh<2> mesh = rectangle({{4.0, 2.0}, {4, 4}}, GetParam());
  name_nodes(mesh, "joint", [](const auto& x) { return x(1) == 1.0; });
  const std::size_t before = mesh.nodes.size();
  const std::size_t on_curve = mesh.nodes_on("joint").size();
  Curves<2> curves{faces_along(mesh, "joint")};
  ASSERT_EQ(curves[0].size(), 4u);
  split_along(mesh, curves);
  EXPECT_EQ(mesh.nodes.size(), before + on_curve);
  EXPECT_EQ(parts(mesh), 2u);
  EXPECT_EQ(mesh.nodes_on("joint").size(), 2 * on_curve);
  EXPECT_EQ(mesh.nodes_on("left").size(), (GetParam().starts_with("Q4") ? 5u : 9u) + 1u) << "both copies";
  expect_pairs_at_one_place(mesh, curves[0]);
  EXPECT_TRUE(distorted_elements(mesh).empty());
}

TEST_P(EveryPlaneElement, an_end_inside_the_body_stays_single) {
  Mesh<2> mesh = rectangle({{4.0, 4.0}, {4, 4}}, GetParam());
  name_nodes(mesh, "wall", [](const auto& x) { return x(0) == 2.0 && x(1) >= 2.0; });
  Curves<2> curves{faces_along(mesh, "wall")};
  split_along(mesh, curves);
  EXPECT_EQ(nodes_at<2>(mesh, {2.0, 2.0}), 1) << "the toe";
  EXPECT_EQ(nodes_at<2>(mesh, {2.0, 3.0}), 2);
  EXPECT_EQ(nodes_at<2>(mesh, {2.0, 4.0}), 2) << "the end on the outer boundary";
  EXPECT_EQ(parts(mesh), 1u);
  expect_pairs_at_one_place(mesh, curves[0]);
}

TEST_P(EveryPlaneElement, where_curves_meet_there_is_one_copy_a_sector) {
  Mesh<2> mesh = rectangle({{4.0, 4.0}, {4, 4}}, GetParam());
  name_nodes(mesh, "across", [](const auto& x) { return x(1) == 2.0; });
  name_nodes(mesh, "up", [](const auto& x) { return x(0) == 2.0; });
  name_nodes(mesh, "half", [](const auto& x) { return x(0) == 1.0 && x(1) >= 2.0; });
  Curves<2> curves{faces_along(mesh, "across"), faces_along(mesh, "up"), faces_along(mesh, "half")};
  split_along(mesh, curves);
  EXPECT_EQ(nodes_at<2>(mesh, {2.0, 2.0}), 4) << "two curves cross";
  EXPECT_EQ(nodes_at<2>(mesh, {1.0, 2.0}), 3) << "one ends at the other";
  EXPECT_EQ(parts(mesh), 5u);
  for (const auto& faces : curves) expect_pairs_at_one_place(mesh, faces);
}

TEST_P(EveryPlaneElement, faces_follow_each_other_and_look_to_one_side) {
  Mesh<2> mesh = rectangle({{4.0, 4.0}, {4, 4}}, GetParam());
  // An L: from the left to the middle and down.
  name_nodes(mesh, "bent",
             [](const auto& x) { return (x(1) == 2.0 && x(0) <= 2.0) || (x(0) == 2.0 && x(1) <= 2.0); });
  // Boundaries may list a side of either element.
  std::vector<TwoSidedFace<2>> found = faces_along(mesh, "bent");
  for (std::size_t i = 0; i < found.size(); ++i)
    mesh.boundaries["sides"].push_back(i % 2 == 0 ? found[i].first : *found[i].second);
  for (const std::string name : {"bent", "sides"}) {
    const std::vector<TwoSidedFace<2>> faces = faces_along(mesh, name);
    ASSERT_EQ(faces.size(), 4u);
    for (std::size_t i = 0; i + 1 < faces.size(); ++i)
      EXPECT_EQ(faces[i].first_nodes[1], faces[i + 1].first_nodes[0]) << name << i;
  }
}

TEST_P(EveryPlaneElement, own_nodes_lie_on_those_of_the_body) {
  Mesh<2> mesh = rectangle({{4.0, 4.0}, {2, 4}}, GetParam());
  const std::vector<TwoSidedFace<2>> faces = faces_along(mesh, "left");
  EXPECT_FALSE(faces.front().second);
  const std::size_t on_left = mesh.nodes_on("left").size();
  const OwnNodes<2> own = add_own_nodes(mesh, faces);
  EXPECT_EQ(own.nodes.size(), on_left);
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (std::size_t a = 0; a < faces[f].first_nodes.size(); ++a) {
      EXPECT_NE(own.face_nodes[f][a], faces[f].first_nodes[a]);
      EXPECT_EQ(mesh.nodes[static_cast<std::size_t>(own.face_nodes[f][a])],
                mesh.nodes[static_cast<std::size_t>(faces[f].first_nodes[a])]);
    }
}

/// Takes away the elements with their centre where `gone` says so.
template <class Gone>
void dig(Mesh<2>& mesh, Gone gone) {
  std::vector<Element<2>> left;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    if (!gone(Eigen::Vector2d(mesh.element_positions(static_cast<int>(e)).colwise().mean().transpose())))
      left.push_back(mesh.elements[e]);
  mesh.elements = std::move(left);
  mesh.boundaries.clear();
  mesh.regions.clear();
}

// Whichever face comes first: elements below the pit have the lowest numbers.
TEST_P(EveryPlaneElement, the_first_side_is_the_one_with_ground_all_along) {
  for (const double sign : {-1.0, 1.0}) {
    Mesh<2> mesh = rectangle({{4.0, 4.0}, {4, 4}}, GetParam());
    name_nodes(mesh, "wall", [](const auto& x) { return x(0) == 2.0 && x(1) >= 1.0; });
    dig(mesh, [&](const auto& x) { return sign * (x(0) - 2.0) > 0.0 && x(1) > 2.0; });
    const std::vector<TwoSidedFace<2>> faces = faces_along(mesh, "wall");
    ASSERT_EQ(faces.size(), 3u);
    for (std::size_t i = 0; i < faces.size(); ++i) {
      EXPECT_LT(sign * (mesh.element_positions(faces[i].first.element).col(0).mean() - 2.0), 0.0) << i;
      if (i > 0) {
        EXPECT_EQ(faces[i - 1].first_nodes[1], faces[i].first_nodes[0]) << i;
      }
    }
  }
}

TEST(mesh_split, refuses_a_curve_with_ground_on_one_side_here_and_on_the_other_there) {
  Mesh<2> mesh = rectangle({{4.0, 4.0}, {4, 4}});
  name_nodes(mesh, "wall", [](const auto& x) { return x(0) == 2.0; });
  dig(mesh, [](const auto& x) { return (x(0) < 2.0 && x(1) > 3.0) || (x(0) > 2.0 && x(1) < 1.0); });
  EXPECT_THROW((void)faces_along(mesh, "wall"), RunError);
}

class EverySpaceElement : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Elements, EverySpaceElement, ::testing::ValuesIn(element_names<3>()));

TEST_P(EverySpaceElement, a_surface_through_the_body_parts_it_in_two) {
  Mesh<3> mesh = box({{2.0, 2.0, 2.0}, {2, 2, 2}}, GetParam());
  name_nodes(mesh, "joint", [](const auto& x) { return x(2) == 1.0; });
  const std::size_t on_surface = mesh.nodes_on("joint").size();
  const std::size_t before = mesh.nodes.size();
  Curves<3> surfaces{faces_along(mesh, "joint")};
  split_along(mesh, surfaces);
  EXPECT_EQ(mesh.nodes.size(), before + on_surface);
  EXPECT_EQ(parts(mesh), 2u);
  expect_pairs_at_one_place(mesh, surfaces[0]);
  // All look up or all look down.
  std::set<int> sides;
  for (const TwoSidedFace<3>& face : surfaces[0]) {
    const VectorRows<3> x = mesh.element_positions(face.first.element);
    sides.insert(x.col(2).mean() < 1.0 ? -1 : 1);
  }
  EXPECT_EQ(sides.size(), 1u);
}

TEST_P(EverySpaceElement, the_edge_of_a_surface_inside_the_body_stays_single) {
  Mesh<3> mesh = box({{2.0, 2.0, 2.0}, {2, 2, 2}}, GetParam());
  name_nodes(mesh, "joint", [](const auto& x) { return x(2) == 1.0 && x(0) <= 1.0; });
  Curves<3> surfaces{faces_along(mesh, "joint")};
  split_along(mesh, surfaces);
  EXPECT_EQ(nodes_at<3>(mesh, {1.0, 1.0, 1.0}), 1);
  EXPECT_EQ(nodes_at<3>(mesh, {0.0, 1.0, 1.0}), 2);
  EXPECT_EQ(parts(mesh), 1u);
  expect_pairs_at_one_place(mesh, surfaces[0]);
}

TEST(mesh_split, refuses_nodes_that_make_up_no_face) {
  Mesh<2> mesh = rectangle({{4.0, 4.0}, {2, 2}});
  EXPECT_THROW((void)faces_along(mesh, "bottom_left"), RunError);
  EXPECT_THROW((void)faces_along(mesh, "nowhere"), RunError);
}

}  // namespace
