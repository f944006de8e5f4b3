// SPDX-License-Identifier: GPL-2.0-or-later
#include <gtest/gtest.h>

#include <algorithm>

#include "fem/mesh/rectangle.hpp"
#include "fem/solver/constraints.hpp"
#include "fem/solver/problem.hpp"
#include "tests/support/structures.hpp"

using namespace polargrain::fem;

namespace {

Mesh<2> block() {
  return rectangle({{0.04, 0.08}, {2, 4}});
}

std::vector<std::string> free_motions(const std::vector<PrescribedDof<2>>& prescribed,
                                      Continuum continuum = Continuum::cosserat) {
  return free_rigid_motions(block(), continuum, prescribed);
}

using Strings = std::vector<std::string>;

TEST(free_rigid_motions, finds_none_when_the_supports_hold) {
  EXPECT_EQ(free_motions({{"bottom", Dof::u2, kZero, {}}, {"bottom_left", Dof::u1, kZero, {}}}), Strings{});
  EXPECT_EQ(free_motions({{"bottom_left", Dof::u2, kZero, {}},
                          {"bottom_left", Dof::u1, kZero, {}},
                          {"top_right", Dof::u1, kZero, {}}}),
            Strings{});
}

TEST(free_rigid_motions, names_each_free_motion) {
  EXPECT_EQ(free_motions({}), (Strings{"translation along 1", "translation along 2", "rotation"}));
  EXPECT_EQ(free_motions({{"bottom", Dof::u2, kZero, {}}}), Strings{"translation along 1"});
  EXPECT_EQ(free_motions({{"left", Dof::u1, kZero, {}}}), Strings{"translation along 2"});
  EXPECT_EQ(free_motions({{"bottom_left", Dof::u1, kZero, {}}, {"bottom_left", Dof::u2, kZero, {}}}),
            Strings{"rotation about (0, 0)"});
  // Two rollers on one line hold translation across it only together with rotation: u1 at two nodes.
  EXPECT_EQ(free_motions({{"bottom_left", Dof::u1, kZero, {}}, {"bottom_right", Dof::u2, kZero, {}}}).size(),
            1U);
}

TEST(free_rigid_motions, a_held_micro_rotation_holds_the_rotation_of_a_cosserat_body_only) {
  const std::vector<PrescribedDof<2>> supports{{"bottom_left", Dof::u1, kZero, {}},
                                               {"bottom_left", Dof::u2, kZero, {}},
                                               {"bottom_left", Dof::w, kZero, {}}};
  EXPECT_EQ(free_motions(supports), Strings{});
  EXPECT_EQ(free_motions(supports, Continuum::cauchy), Strings{"rotation about (0, 0)"});
}

TEST(free_rigid_motions, looks_at_each_part_of_the_body) {
  Mesh<2> mesh = block();
  const Mesh<2> other = rectangle({{0.04, 0.08}, {1, 1}, {0.1, 0.0}});
  const int shift = static_cast<int>(mesh.nodes.size());
  mesh.nodes.insert(mesh.nodes.end(), other.nodes.begin(), other.nodes.end());
  mesh.elements.push_back(other.elements[0]);
  for (int& node : mesh.elements.back().nodes) node += shift;
  const Strings motions = free_rigid_motions(
      mesh, Continuum::cosserat, {{"bottom", Dof::u2, kZero, {}}, {"bottom_left", Dof::u1, kZero, {}}});
  ASSERT_EQ(motions.size(), 3U);
  EXPECT_NE(motions[0].find("of the part around (0.12, 0.04)"), std::string::npos) << motions[0];
}

TEST(free_rigid_motions, sides_that_are_tied_do_not_turn_and_still_move) {
  const std::vector<Tie> ties{{"left", "right"}};
  const auto free_with_ties = [&](const std::vector<PrescribedDof<2>>& prescribed) {
    return free_rigid_motions(block(), Continuum::cauchy, prescribed, ties);
  };
  EXPECT_EQ(free_with_ties({{"bottom_left", Dof::u1, kZero, {}}, {"bottom_left", Dof::u2, kZero, {}}}),
            Strings{});
  EXPECT_EQ(free_with_ties({{"bottom_left", Dof::u1, kZero, {}}}), Strings{"translation along 2"});
}

TEST(free_rigid_motions, parts_that_are_tied_are_one) {
  Mesh<2> mesh = rectangle({{0.04, 0.08}, {1, 2}});
  const Mesh<2> other = rectangle({{0.04, 0.08}, {1, 2}, {0.1, 0.0}});
  const int shift = static_cast<int>(mesh.nodes.size());
  mesh.nodes.insert(mesh.nodes.end(), other.nodes.begin(), other.nodes.end());
  for (Element<2> element : other.elements) {
    for (int& node : element.nodes) node += shift;
    mesh.elements.push_back(element);
  }
  for (const int node : mesh.nodes_on("left")) mesh.node_sets["other left"].push_back(node + shift);
  const std::vector<PrescribedDof<2>> supports{{"bottom", Dof::u1, kZero, {}},
                                               {"bottom", Dof::u2, kZero, {}}};
  EXPECT_EQ(free_rigid_motions(mesh, Continuum::cosserat, supports).size(), 3U);
  EXPECT_EQ(free_rigid_motions(mesh, Continuum::cosserat, supports, {{"left", "other left"}}), Strings{});
}

TEST(tied_nodes, finds_the_partner_of_every_node) {
  const Mesh<2> mesh = block();
  const TiedNodes tied = tied_nodes(mesh, {"left", "right"});
  EXPECT_EQ(tied.fault, "");
  ASSERT_EQ(tied.pairs.size(), 9U);  // 4 elements of eight nodes along the side
  for (const auto& [follower, leader] : tied.pairs) {
    EXPECT_EQ(mesh.nodes[static_cast<std::size_t>(follower)](0), 0.0);
    EXPECT_EQ(mesh.nodes[static_cast<std::size_t>(leader)](0), 0.04);
    EXPECT_EQ(mesh.nodes[static_cast<std::size_t>(follower)](1),
              mesh.nodes[static_cast<std::size_t>(leader)](1));
  }
}

TEST(tied_nodes, says_why_two_sides_do_not_match) {
  Mesh<2> mesh = block();
  EXPECT_NE(tied_nodes(mesh, {"left", "rigth"}).fault.find("no boundary or node set 'rigth'"),
            std::string::npos);
  EXPECT_NE(tied_nodes(mesh, {"left", "top"}).fault.find("'left' has 9 nodes and 'top' has 5"),
            std::string::npos);
  EXPECT_NE(tied_nodes(mesh, {"left", "left"}).fault.find("lie on each other"), std::string::npos);
  for (Eigen::Vector2d& node : mesh.nodes) {
    if (node(0) == 0.04 && node(1) == 0.04) node(1) = 0.0401;
  }
  EXPECT_NE(tied_nodes(mesh, {"left", "right"}).fault.find("'right' has no node at"), std::string::npos);
}

TEST(faults, what_holds_one_side_of_a_tie_holds_the_other) {
  Problem<2> problem;
  problem.mesh = block();
  problem.materials["all"] = nullptr;
  problem.ties = {{"left", "right"}};
  problem.prescribed = {{"bottom", Dof::u1, kZero, {}}, {"bottom", Dof::u2, kZero, {}}};
  EXPECT_EQ(faults(problem), Strings{});
  problem.prescribed.push_back({"top_left", Dof::u1, TimeTable::ramp(1.0), {}});
  ASSERT_EQ(faults(problem).size(), 1U);
  EXPECT_NE(faults(problem)[0].find("u1 is given at the node (0, 0.08), and not alike"), std::string::npos);
  problem.prescribed.push_back({"top_right", Dof::u1, TimeTable::ramp(2.0), {}});
  EXPECT_EQ(faults(problem).size(), 1U);
  problem.prescribed.back().value = TimeTable::ramp(1.0);
  EXPECT_EQ(faults(problem), Strings{});
}

/// Ground that is one body as yet: a stage behind parts it at x = 0.5. Half of its top, left of there, is moved.
template <int dim>
Problem<dim> ground_in_one(const Mesh<dim>& mesh, bool has_interface) {
  Problem<dim> problem;
  problem.mesh = mesh;
  problem.materials["all"] = elastic_ground<dim>(1e7);
  problem.stages = {"first", "later"};
  name_nodes(problem.mesh, "line", [](const auto& x) { return x(0) == 0.5; });
  std::vector<BoundarySide>& half = problem.mesh.boundaries["half"];
  for (const BoundarySide& side : problem.mesh.boundaries.at("top"))
    if (problem.mesh.element_positions(side.element).col(0).mean() < 0.5) half.push_back(side);
  constexpr Dof up = dim == 2 ? Dof::u2 : Dof::u3;
  for (const Dof dof : node_dofs<dim>()) problem.prescribed.push_back({"bottom", dof, kZero, {}});
  problem.prescribed.push_back({"half", up, TimeTable::ramp(-1e-3), {}});
  if (!has_interface) return problem;
  std::vector<std::vector<TwoSidedFace<dim>>> curves{faces_along(problem.mesh, "line")};
  split_along(problem.mesh, curves);
  std::vector<InterfaceFace<dim>> faces;
  for (const TwoSidedFace<dim>& face : curves[0])
    faces.push_back(
        {face.type, face.first_nodes, face.second_nodes, {face.first.element, face.second->element}, {}});
  InterfaceSettings settings{"joint", glue(1e9, 1e9), {}};
  settings.parts_ground = true;
  problem.contributions.push_back(std::make_shared<Interface<dim>>(problem.mesh, settings, std::move(faces)));
  problem.contributions.back()->life.begin = 1;
  return problem;
}

template <int dim>
void expect_that_the_support_holds_both_copies(const Mesh<dim>& mesh) {
  constexpr Dof up = dim == 2 ? Dof::u2 : Dof::u3;
  std::vector<double> reactions;
  for (const bool has_interface : {false, true}) {
    Problem<dim> problem = ground_in_one<dim>(mesh, has_interface);
    EXPECT_EQ(faults(problem), Strings{});
    Solver<dim> solver(problem, {});
    ASSERT_TRUE(solver.equilibrate().converged);
    ASSERT_TRUE(solver.advance(1.0).converged);
    // All nodes at the end of the moved half are at the end of the line too.
    for (const int node : solver.problem().mesh.nodes_on("line")) {
      if (solver.problem().mesh.nodes[static_cast<std::size_t>(node)](dim - 1) != 1.0) continue;
      EXPECT_EQ(solver.shown_displacement()(entry_of<dim>(node, up)), -1e-3) << node;
    }
    reactions.push_back(solver.reaction("half")(dim - 1));
  }
  EXPECT_NEAR(reactions[1] / reactions[0], 1.0, 1e-9);
}

TEST(Constraints, a_support_of_one_copy_holds_the_others_until_an_interface_parts_them) {
  expect_that_the_support_holds_both_copies<2>(rectangle({{1.0, 1.0}, {2, 2}}));
  expect_that_the_support_holds_both_copies<3>(box({{1.0, 1.0, 1.0}, {2, 1, 2}}));
}

TEST(faults, copies_of_a_node_are_not_given_two_values_while_they_are_one) {
  Problem<2> problem = ground_in_one<2>(rectangle({{1.0, 1.0}, {2, 2}}), true);
  std::vector<BoundarySide>& other = problem.mesh.boundaries["other half"];
  for (const BoundarySide& side : problem.mesh.boundaries.at("top"))
    if (problem.mesh.element_positions(side.element).col(0).mean() > 0.5) other.push_back(side);
  problem.prescribed.push_back({"other half", Dof::u2, TimeTable::ramp(-1e-3), {}});
  EXPECT_EQ(faults(problem), Strings{});
  problem.prescribed.back().value = kZero;
  ASSERT_EQ(faults(problem).size(), 1U);
  EXPECT_NE(
      faults(problem)[0].find("u2 is given two different values at (0.5, 1), on 'half' and on 'other half'"),
      std::string::npos)
      << faults(problem)[0];
  problem.prescribed.back().life.begin = 1;
  EXPECT_EQ(faults(problem), Strings{});
}

TEST(faults, lists_everything_that_is_wrong_at_once) {
  Problem<2> problem;
  problem.mesh = block();
  problem.materials["sand"] = nullptr;
  problem.prescribed = {{"bottum", Dof::u2, kZero, {}},
                        {"left", Dof::u1, kZero, {}},
                        {"top", Dof::u1, TimeTable::ramp(0.1), {}}};
  problem.boundary_loads = {{.on = "all", .pressure = TimeTable::constant(1.0)}};
  const Strings messages = faults(problem);
  const Strings expected{
      "'bottum'",         "'all' is not a boundary", "no region 'sand'",
      "have no material", "two different values",    "rigid motion free: translation along 2"};
  for (const std::string& part : expected) {
    bool found = false;
    for (const std::string& message : messages) found = found || message.find(part) != std::string::npos;
    EXPECT_TRUE(found) << part;
  }
  EXPECT_EQ(messages.size(), expected.size());
}

/// Two elements beside each other, with a pressure on the face between them.
template <int dim>
void expect_no_pressure_inside_of(const Mesh<dim>& mesh) {
  Problem<dim> problem;
  problem.mesh = mesh;
  const auto is_between = [&](int node) { return mesh.nodes[static_cast<std::size_t>(node)](0) == 1.0; };
  for (int k = 0; k < static_cast<int>(mesh.elements.front().type->sides.size()); ++k)
    if (std::ranges::all_of(mesh.side_nodes({0, k}), is_between))
      problem.mesh.boundaries["middle"] = {BoundarySide{0, k}};
  problem.materials["all"] = nullptr;
  for (int i = 0; i < dim; ++i) problem.prescribed.push_back({"bottom", static_cast<Dof>(i), kZero, {}});
  problem.boundary_loads = {{.on = "middle", .pressure = TimeTable::constant(1e3)}};
  ASSERT_EQ(faults(problem).size(), 1U);
  EXPECT_TRUE(faults(problem)[0].starts_with("the pressure on 'middle' has ground on both sides at (1, "))
      << faults(problem)[0];
  problem.boundary_loads.front().on = "right";
  EXPECT_EQ(faults(problem), Strings{});
  problem.boundary_loads.front().on = "middle";
  add_interface(problem, "middle", glue(1e9, 1e9));  // parts it: the boundary is that of one side
  EXPECT_EQ(faults(problem), Strings{});
}

TEST(faults, tells_of_a_pressure_between_two_elements) {
  expect_no_pressure_inside_of<2>(rectangle({{2.0, 1.0}, {2, 1}}));
  expect_no_pressure_inside_of<3>(box({{2.0, 1.0, 1.0}, {2, 1, 1}}));
}

TEST(faults, a_corner_may_be_given_the_same_value_twice) {
  Problem<2> problem;
  problem.mesh = block();
  problem.materials["all"] = nullptr;
  problem.prescribed = {
      {"bottom", Dof::u1, kZero, {}}, {"bottom", Dof::u2, kZero, {}}, {"left", Dof::u1, kZero, {}}};
  EXPECT_EQ(faults(problem), Strings{});
}

TEST(faults, a_corner_may_be_given_one_value_in_two_ways) {
  Problem<2> problem;
  problem.mesh = block();
  problem.materials["all"] = nullptr;
  const TimeTable in_pieces({{0.0, 0.0}, {0.3, 0.3e-3}, {1.0, 1e-3}, {2.0, 1e-3}});
  problem.prescribed = {{"bottom", Dof::u2, kZero, {}},
                        {"bottom", Dof::u1, TimeTable::ramp(1e-3), {}},
                        {"left", Dof::u1, in_pieces, {}},
                        {"right", Dof::u2, TimeTable::ramp(0.0), {}}};
  EXPECT_EQ(faults(problem), Strings{});
  problem.prescribed[2].value = TimeTable({{0.0, 0.0}, {0.3, 0.4e-3}, {1.0, 1e-3}});
  EXPECT_EQ(faults(problem).size(), 1U);
}

TEST(faults, a_set_of_nodes_goes_before_boundaries_and_these_before_all) {
  Problem<2> problem;
  problem.mesh = block();
  problem.materials["all"] = nullptr;
  problem.prescribed = {{"all", Dof::u1, TimeTable::ramp(3e-3), {}},
                        {"bottom", Dof::u2, kZero, {}},
                        {"bottom", Dof::u1, kZero, {}},
                        {"left", Dof::u1, TimeTable::ramp(1e-3), {}}};
  ASSERT_EQ(faults(problem).size(), 1U);
  EXPECT_EQ(
      faults(problem)[0],
      "u1 is given two different values at the node (0, 0), on 'bottom' and on 'left': give it once there, or "
      "give that node an item of its own, on 'bottom_left': a set of nodes goes before boundaries");
  problem.prescribed.push_back({"bottom_left", Dof::u1, TimeTable::ramp(2e-3), {}});
  EXPECT_EQ(faults(problem), Strings{});

  const Constraints<2> constraints(problem);
  const Mesh<2>& mesh = problem.mesh;
  Eigen::VectorXd nodal = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(entry_of<2>(mesh.nodes.size())));
  constraints.apply(1.0, nodal);
  const auto u1_at = [&](const std::string& set, std::size_t which) {
    return nodal(
        static_cast<Eigen::Index>(entry_of<2>(static_cast<std::size_t>(mesh.nodes_on(set)[which]), Dof::u1)));
  };
  EXPECT_EQ(u1_at("bottom_left", 0), 2e-3);
  EXPECT_EQ(u1_at("bottom_right", 0), 0.0);
  EXPECT_EQ(u1_at("top_left", 0), 1e-3);
  EXPECT_EQ(u1_at("top_right", 0), 3e-3);
}

}  // namespace
