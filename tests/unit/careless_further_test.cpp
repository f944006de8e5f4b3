// SPDX-License-Identifier: GPL-2.0-or-later
// More scenes with one thing wrong each: loads that turn between steps, tolerances that are a share of a pressure of nowhere,
// meshes whose parts only touch.
#include <fmt/format.h>

#include "tests/support/careless_scenes.hpp"

namespace polargrain::testing {
namespace {

using app::Rank;

bool is_told(const app::Remarks& remarks, const std::string& message, Rank rank) {
  return std::ranges::any_of(remarks, [&](const app::Remark& remark) {
    return remark.rank == rank && remark.at.line > 0 && !remark.remedy.empty() &&
           app::line_of(remark).find(message) != std::string::npos;
  });
}

class FurtherCarelessTest : public ::testing::TestWithParam<Careless> {};

TEST_P(FurtherCarelessTest, IsTold) {
  const app::Remarks remarks = remarks_of(GetParam());
  EXPECT_TRUE(is_told(remarks, GetParam().message, GetParam().rank)) << app::text_of(remarks, true);
}

const std::string kTwoCycles =
    "{u2: [[0, 0], [0.125, -1 mm], [0.375, 1 mm], [0.625, -1 mm], [0.875, 1 mm], [1, 0]]}";

/// Eight millimetres there and back: six steps end at -2/3, 2/3, 0, -2/3, 2/3 and 0 mm, which is 16/3 mm.
INSTANTIATE_TEST_SUITE_P(
    TurnsBetweenSteps, FurtherCarelessTest,
    ::testing::Values(
        Careless{"TwoCyclesInSixSteps", replaced(kGrains, "{u2: -8 mm}", kTwoCycles), "count: 20", "count: 6",
                 "a load turns between the ends of 6 steps, which see 67 % of its way"},
        Careless{"TwoCyclesInTwentySteps", kGrains, "{u2: -8 mm}", kTwoCycles,
                 "a load turns between the ends of 20 steps, which see 80 % of its way", Rank::doubtful},
        Careless{"PulseWithinAStep", kGround, "[[0, 10 kPa], [1, 60 kPa]]",
                 "[[0, 10 kPa], [0.05, 60 kPa], [0.1, 10 kPa], [1, 20 kPa]]", "which see 9.1 % of its way"},
        Careless{
            "WeightThatShakes", kGround, "{unit_weight: 18 kN/m3}",
            "{unit_weight: 18 kN/m3}\n  - {force: [2 kN/m3, 0], factor: [[0, 0], [0.25, 1], [0.75, -1], [1, 0]]}",
            "which see 80 % of its way", Rank::doubtful}),
    [](const auto& info) { return info.param.name; });

Careless with_reference(const std::string& name, const std::string& pressure, const std::string& message,
                        Rank rank) {
  return {name,          kGrains,
          "model: cell", "model: adaptive, adaptive: {tolerance: 2 %, reference_pressure: " + pressure + "}",
          message,       rank};
}

INSTANTIATE_TEST_SUITE_P(
    ReferencePressure, FurtherCarelessTest,
    ::testing::Values(with_reference("InMegapascals", "100 MPa",
                                     "reference_pressure is 100 MPa, the largest stress of the case 100 kPa",
                                     Rank::wrong),
                      with_reference("OfADam", "2 MPa", "allows any error", Rank::wrong),
                      with_reference("InPascals", "90", "saves nothing", Rank::costly)),
    [](const auto& info) { return info.param.name; });

/// Elements of 500 mm in ground that yields and does not soften, and in elastic ground.
INSTANTIATE_TEST_SUITE_P(
    LengthBelowElements, FurtherCarelessTest,
    ::testing::Values(
        Careless{"OfDust", kGround, "lc: 20 cm", "lc: 0.02 mm",
                 "measure 500 mm, 25000 times lc (at most 10000): lc has no effect", Rank::doubtful},
        Careless{
            "OfDustInElasticGround", kGround,
            "elastoplastic, E: 30 MPa, nu: 0.3, Gc: 12 MPa, lc: 20 cm, friction_angle: 30 deg, dilatancy_angle: "
            "5 deg, cohesion: 10 kPa",
            "elastic, E: 30 MPa, nu: 0.3, Gc: 12 MPa, lc: 0.02 mm", "25000 times lc (at most 10000)",
            Rank::doubtful}),
    [](const auto& info) { return info.param.name; });

#ifdef POLARGRAIN_HAS_GMSH
/// Two squares of one element of eight nodes on each other, 1 m wide. @param own whether the upper one has nodes of its own
std::string two_squares(bool own) {
  std::string nodes, elements;
  int count = 0;
  std::vector<std::array<int, 8>> squares;
  for (int square = 0; square < 2; ++square) {
    constexpr double kPlaces[8][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0.5, 0}, {1, 0.5}, {0.5, 1}, {0, 0.5}};
    std::array<int, 8> numbers{};
    for (std::size_t k = 0; k < 8; ++k) {
      const bool shared = square == 1 && !own && kPlaces[k][1] == 0.0;
      if (shared) {
        numbers[k] = squares[0][k == 0 ? 3 : k == 1 ? 2 : 6];
        continue;
      }
      numbers[k] = ++count;
      nodes += fmt::format("{} {} {} 0\n", count, kPlaces[k][0], kPlaces[k][1] + square);
    }
    squares.push_back(numbers);
    elements += fmt::format("{} 16 2 4 {} {}\n", square + 1, square + 4, fmt::join(numbers, " "));
  }
  elements += fmt::format("3 8 2 1 1 {} {} {}\n", squares[0][0], squares[0][1], squares[0][4]);
  elements += fmt::format("4 8 2 3 3 {} {} {}\n", squares[1][2], squares[1][3], squares[1][6]);
  return fmt::format(
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n1 1 \"bottom\"\n1 3 \"top\"\n2 4 \"soil\"\n"
      "$EndPhysicalNames\n$Nodes\n{}\n{}$EndNodes\n$Elements\n4\n{}$EndElements\n",
      count, nodes, elements);
}

app::Remarks remarks_on_mesh(const std::string& mesh) {
  const Scratch scratch("careless_squares");
  write(scratch.path() / "two.msh", mesh);
  write(scratch.path() / "case.yaml", R"(title: Two squares on each other
mesh: {file: two.msh}
materials:
  soil: {model: elastic, E: 40 MPa, nu: 0.3, Gc: 15 MPa, lc: 0.2 m}
regions: {soil: soil}
boundary:
  - {on: bottom, fix: [u1, u2]}
  - {on: top, fix: [u1, w], move: {u2: -1 mm}}
steps: {count: 1}
)");
  return app::remarks_on(coupler::read_case(scratch.path() / "case.yaml"), std::vector<std::string>{}, {});
}

TEST(SeamsOfAMesh, AreToldWhereNothingHoldsThem) {
  const app::Remarks apart = remarks_on_mesh(two_squares(true));
  EXPECT_TRUE(is_told(apart, "3 pairs of nodes lie at one place each, the first at (0, 1) m", Rank::wrong))
      << app::text_of(apart, true);
  const app::Remarks joined = remarks_on_mesh(two_squares(false));
  EXPECT_TRUE(joined.empty()) << app::text_of(joined, true);
}

/// An element 2 m wide beneath two of 1 m: the middles of their lower sides, at x1 = 0.5 and 1.5 m, lie within its upper side.
TEST(SeamsOfAMesh, AreToldWhereElementsDoNotMeetNodeToNode) {
  constexpr const char* kOneBelowTwo = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
3
1 1 "bottom"
1 3 "top"
2 4 "soil"
$EndPhysicalNames
$Nodes
18
1 0 0 0
2 2 0 0
3 2 1 0
4 0 1 0
5 1 0 0
6 2 0.5 0
7 1 1 0
8 0 0.5 0
9 1 2 0
10 0 2 0
11 0.5 1 0
12 1 1.5 0
13 0.5 2 0
14 0 1.5 0
15 2 2 0
16 1.5 1 0
17 2 1.5 0
18 1.5 2 0
$EndNodes
$Elements
6
1 16 2 4 4 1 2 3 4 5 6 7 8
2 16 2 4 4 4 7 9 10 11 12 13 14
3 16 2 4 4 7 3 15 9 16 17 18 12
4 8 2 1 1 1 2 5
5 8 2 3 3 10 9 13
6 8 2 3 3 9 15 18
$EndElements
)";
  const app::Remarks remarks = remarks_on_mesh(kOneBelowTwo);
  EXPECT_TRUE(is_told(remarks, "elements do not meet node to node at (0.5, 1) m: 2 nodes lie within sides",
                      Rank::wrong))
      << app::text_of(remarks, true);
}
#endif

}  // namespace
}  // namespace polargrain::testing
