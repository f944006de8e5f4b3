// SPDX-License-Identifier: GPL-2.0-or-later
#include <gtest/gtest.h>

#include "fem/mesh/rectangle.hpp"
#include "fem/solver/problem.hpp"

using namespace polargrain::fem;

namespace {

const TimeTable kZero = TimeTable::constant(0.0);

Mesh block() {
  return rectangle({{0.04, 0.08}, {2, 4}});
}

std::vector<std::string> free_motions(const std::vector<PrescribedDof>& prescribed,
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
  const std::vector<PrescribedDof> supports{{"bottom_left", Dof::u1, kZero, {}},
                                            {"bottom_left", Dof::u2, kZero, {}},
                                            {"bottom_left", Dof::w, kZero, {}}};
  EXPECT_EQ(free_motions(supports), Strings{});
  EXPECT_EQ(free_motions(supports, Continuum::cauchy), Strings{"rotation about (0, 0)"});
}

TEST(free_rigid_motions, looks_at_each_part_of_the_body) {
  Mesh mesh = block();
  const Mesh other = rectangle({{0.04, 0.08}, {1, 1}, {0.1, 0.0}});
  const int shift = static_cast<int>(mesh.nodes.size());
  mesh.nodes.insert(mesh.nodes.end(), other.nodes.begin(), other.nodes.end());
  mesh.elements.push_back(other.elements[0]);
  for (int& node : mesh.elements.back().nodes) node += shift;
  const Strings motions = free_rigid_motions(
      mesh, Continuum::cosserat, {{"bottom", Dof::u2, kZero, {}}, {"bottom_left", Dof::u1, kZero, {}}});
  ASSERT_EQ(motions.size(), 3U);
  EXPECT_NE(motions[0].find("of the part around (0.12, 0.04)"), std::string::npos) << motions[0];
}

TEST(faults, lists_everything_that_is_wrong_at_once) {
  Problem problem;
  problem.mesh = block();
  problem.materials["sand"] = nullptr;
  problem.prescribed = {{"bottum", Dof::u2, kZero, {}},
                        {"left", Dof::u1, kZero, {}},
                        {"top", Dof::u1, TimeTable::ramp(0.1), {}}};
  problem.edge_loads = {{.on = "all", .pressure = TimeTable::constant(1.0)}};
  const Strings messages = faults(problem);
  const Strings expected{
      "'bottum'",         "'all' is none",        "no region 'sand'",
      "have no material", "two different values", "rigid motion free: translation along 2"};
  for (const std::string& part : expected) {
    bool found = false;
    for (const std::string& message : messages) found = found || message.find(part) != std::string::npos;
    EXPECT_TRUE(found) << part;
  }
  EXPECT_EQ(messages.size(), expected.size());
}

TEST(faults, a_corner_may_be_given_the_same_value_twice) {
  Problem problem;
  problem.mesh = block();
  problem.materials["all"] = nullptr;
  problem.prescribed = {
      {"bottom", Dof::u1, kZero, {}}, {"bottom", Dof::u2, kZero, {}}, {"left", Dof::u1, kZero, {}}};
  EXPECT_EQ(faults(problem), Strings{});
}

}  // namespace
