// SPDX-License-Identifier: GPL-2.0-or-later
// Beams and anchors: against closed forms, and figures of an independent code where the mesh has a share in them.
#include "fem/beam/beam.hpp"

#include <fmt/format.h>

#include "tests/support/structures.hpp"

using namespace polargrain;
using namespace polargrain::fem;

namespace {

const SolverOptions kTightOfBeam{.force_tolerance = 1e-10, .moment_tolerance = 1e-9};
/// For beams whose length and shear are 1e6 times as stiff as their bending: what rounding leaves.
const SolverOptions kStiff{.force_tolerance = 1e-6, .moment_tolerance = 1e-6};

/// A held block with a beam on nodes of its own along its top, from (0, height) to (length, height).
struct BeamOnTop {
  Problem<2> problem;
  std::vector<TwoSidedFace<2>> faces;
  OwnNodes<2> own;
  std::shared_ptr<Beam> beam;

  BeamOnTop(double length, int elements, const std::string& type, const BeamSection& section,
            const InterfaceParameters* bed = nullptr) {
    problem.mesh = rectangle({{length, 1.0}, {elements, 1}}, type);
    problem.materials["all"] = elastic_ground<2>(1e9);
    hold_all(problem);
    if (bed != nullptr) {
      const auto body = add_body<2>(problem, "top", *bed);
      faces = body.faces;
      own = body.own;
    } else {
      faces = faces_along(problem.mesh, "top");
      own = add_own_nodes(problem.mesh, faces);
      problem.mesh.node_sets["body"] = own.nodes;
      problem.prescribed.push_back({"body", Dof::w, kZero, {}});
    }
    beam = add_beam(problem, section, faces, own.face_nodes);
  }
  /// Names the node of the beam at (x, 1).
  void name(const std::string& name, double x) { name_node<2>(problem.mesh, name, {x, 1.0}, "body"); }
  void hold(const std::string& on, const std::vector<Dof>& dofs) {
    for (const Dof dof : dofs) problem.prescribed.push_back({on, dof, kZero, {}});
  }
  void clamp(const std::string& on) {
    hold(on, {Dof::u1, Dof::u2});
    problem.prescribed_fields.push_back({kBeamRotation, on, kZero, {}, {}});
  }
};

double moment_at(const std::vector<BeamResult>& results, double x) {
  for (const BeamResult& end : results)
    if (std::abs(end.place(0) - x) < 1e-9) return end.moment;
  return HUGE_VAL;
}

/// A finite beam on springs with a force in the middle: its deflection there and at the end, and the moment.
std::array<double, 3> beam_on_springs(int elements, double shear_stiffness) {
  const InterfaceParameters bed = glue(5e7, 1e3);
  BeamOnTop scene(8.0, elements, "Q8R", {1e9, 1e7, shear_stiffness}, &bed);
  scene.name("middle", 4.0);
  scene.name("end", 0.0);
  scene.problem.node_loads = {{"middle", Dof::u2, TimeTable::ramp(-1e5)}};
  scene.hold("end", {Dof::u1});
  const auto beam = scene.beam;
  Solver<2> solver(std::move(scene.problem), kStiff);
  EXPECT_TRUE(solver.equilibrate().converged);
  const StepReport report = solver.advance(1.0);
  EXPECT_TRUE(report.converged) << report.message;
  return {-solver.mean_displacement("middle")(1), -solver.mean_displacement("end")(1),
          moment_at(beam->results(solver.problem()), 4.0)};
}

// Hetenyi's closed form for a stiff shear area; errors of quadratic elements as the independent code has them.
TEST(beam, on_springs_with_a_force_in_the_middle) {
  constexpr double kDeflection = 1.057644164e-3;
  constexpr double kMoment = 23640.99948;
  for (const auto& [elements, of_deflection, of_moment] :
       {std::tuple(4, -1.6e-3, 1.1e-2), std::tuple(8, -2.3e-3, 3.4e-3), std::tuple(16, -2.3e-4, 2.6e-4),
        std::tuple(32, -1.5e-5, 1.6e-5)}) {
    const auto found = beam_on_springs(elements, 1e13);
    EXPECT_NEAR(found[0] / kDeflection - 1.0, of_deflection, 0.06 * std::abs(of_deflection)) << elements;
    EXPECT_NEAR(std::abs(found[2]) / kMoment - 1.0, of_moment, 0.06 * of_moment) << elements;
  }
  EXPECT_NEAR(beam_on_springs(32, 1e13)[1], -2.859133e-5, 1e-8);
}

TEST(beam, on_springs_with_its_shear) {
  const auto found = beam_on_springs(32, 5e7);
  EXPECT_NEAR(found[0], 1.383569908e-3, 1e-12);
  EXPECT_NEAR(std::abs(found[2]), 21369.699, 1e-3);
}

class EveryBeam : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Sides, EveryBeam, ::testing::Values("Q8R", "T6"));

// Exact at nodes: P L^3 / 3 EI + P L / GA, and M = -P (L - x) at each node.
TEST_P(EveryBeam, a_cantilever_is_exact_at_its_nodes) {
  BeamOnTop scene(3.0, 3, GetParam(), {1e8, 2e6, 1e7});
  scene.name("root", 0.0);
  scene.name("tip", 3.0);
  scene.clamp("root");
  scene.problem.node_loads = {{"tip", Dof::u2, TimeTable::ramp(5e3)}, {"tip", Dof::u1, TimeTable::ramp(7e3)}};
  const auto beam = scene.beam;
  Solver<2> solver(std::move(scene.problem), kTightOfBeam);
  ASSERT_TRUE(solver.equilibrate().converged);
  ASSERT_TRUE(solver.advance(1.0).converged);
  const auto tip = solver.mean_displacement("tip");
  EXPECT_NEAR(tip(1), 5e3 * 27 / (3 * 2e6) + 5e3 * 3 / 1e7, 1e-11);
  EXPECT_NEAR(tip(0), 7e3 * 3 / 1e8, 1e-13);
  const double work = 0.5 * (5e3 * tip(1) + 7e3 * tip(0));
  EXPECT_NEAR(solver.state().external_work / work, 1.0, 1e-9);
  EXPECT_NEAR(solver.state().internal_work / work, 1.0, 1e-9);
  for (const BeamResult& end : beam->results(solver.problem())) {
    // The way along the top of an element runs to the left: N has its sign, V turns with the way, M does not.
    EXPECT_NEAR(std::abs(end.moment), 5e3 * (3.0 - end.place(0)), 1e-5);
    EXPECT_NEAR(end.axial, 7e3, 1e-5);
    EXPECT_NEAR(std::abs(end.shear), 5e3, 1e-5);
  }
}

// M L^2 / 2 EI, and M everywhere; then its end is held where it is, M L / EI, while the moment goes.
TEST_P(EveryBeam, a_moment_at_its_end_bends_a_cantilever) {
  BeamOnTop scene(3.0, 3, GetParam(), {1e8, 2e6, 1e7});
  scene.name("root", 0.0);
  scene.name("tip", 3.0);
  scene.clamp("root");
  const TimeTable moment({{0.0, 0.0}, {1.0, 5e3}, {2.0, 0.0}});
  scene.problem.node_loads = {{"tip", Dof::w, moment, {}, kBeamRotation},
                              {"tip", Dof::u1, TimeTable::ramp(7e3)}};
  scene.problem.stages = {"bent", "held"};
  scene.problem.prescribed_fields.push_back(
      {.field = kBeamRotation, .on = "tip", .value = kZero, .life = {1}, .from_here = true});
  const auto beam = scene.beam;
  const int turn = scene.problem.places().entry(0, scene.problem.mesh.nodes_on("tip").front());
  Solver<2> solver(std::move(scene.problem), kTightOfBeam);
  ASSERT_TRUE(solver.equilibrate().converged);
  ASSERT_TRUE(solver.advance(1.0).converged);
  EXPECT_NEAR(solver.mean_displacement("tip")(1), 5e3 * 9 / (2 * 2e6), 1e-11);
  EXPECT_NEAR(solver.state().displacement(turn), 5e3 * 3 / 2e6, 1e-11);
  for (const BeamResult& end : beam->results(solver.problem())) EXPECT_NEAR(std::abs(end.moment), 5e3, 1e-5);
  const double work = 0.5 * (5e3 * 5e3 * 3 / 2e6 + 7e3 * 7e3 * 3 / 1e8);
  EXPECT_NEAR(solver.state().external_work / work, 1.0, 1e-9) << "of the moment too";
  EXPECT_NEAR(solver.state().internal_work / work, 1.0, 1e-9);
  solver.begin_stage(1);
  ASSERT_TRUE(solver.advance(2.0).converged);
  EXPECT_NEAR(solver.state().displacement(turn), 5e3 * 3 / 2e6, 1e-15) << "given";
  EXPECT_NEAR(solver.mean_displacement("tip")(1), 5e3 * 9 / (2 * 2e6), 1e-11);
}

// Mp (1 - |N| / Np) where a pulled cantilever is bent by its end's rotation: the same moment everywhere.
TEST(beam, yields_at_its_plastic_moment) {
  BeamOnTop scene(2.0, 4, "Q8R", {1e8, 2e6, 1e7, 8e3, 40e3});
  scene.name("root", 0.0);
  scene.name("tip", 2.0);
  scene.clamp("root");
  scene.problem.prescribed_fields.push_back(
      {kBeamRotation, "tip", TimeTable({{0.0, 0.0}, {1.0, 3e-3}, {2.0, 2e-2}, {3.0, 1.8e-2}}), {}, {}});
  scene.problem.node_loads = {{"tip", Dof::u1, TimeTable::ramp(10e3)}};
  const auto beam = scene.beam;
  Solver<2> solver(std::move(scene.problem), kTightOfBeam);
  ASSERT_TRUE(solver.equilibrate().converged);
  ASSERT_TRUE(solver.advance(1.0).converged);
  EXPECT_NEAR(std::abs(beam->results(solver.problem()).front().moment), 2e6 * 3e-3 / 2.0, 1e-5);
  EXPECT_FALSE(beam->yields());
  const StepReport report = solver.advance(2.0);
  ASSERT_TRUE(report.converged) << report.message;
  EXPECT_TRUE(beam->yields());
  for (const BeamResult& end : beam->results(solver.problem()))
    EXPECT_NEAR(std::abs(end.moment), 8e3 * 0.75, 1e-5);
  ASSERT_TRUE(solver.advance(3.0).converged);
  for (const BeamResult& end : beam->results(solver.problem()))
    EXPECT_NEAR(std::abs(end.moment), 6e3 - 2e6 * 2e-3 / 2.0, 1e-4);
}

// A clamped beam under a line load: hinges at its ends at 12 Mp / L^2. Elements whose points have yielded resist by more there,
// which is told anew when it has grown by a tenth.
TEST(beam, tells_of_moments_above_its_plastic_one) {
  constexpr double kLength = 4.0, kPlastic = 1e5;
  constexpr double kFirst = 12.0 * kPlastic / (kLength * kLength);
  for (const int elements : {4, 8}) {
    BeamOnTop scene(kLength, elements, "Q8R", {1e9, 1e7, 1e12, kPlastic});
    scene.name("left end", 0.0);
    scene.name("right end", kLength);
    scene.clamp("left end");
    scene.clamp("right end");
    const double h = kLength / elements;
    for (int k = 1; k < 2 * elements; ++k) {
      const std::string name = fmt::format("node {}", k);
      scene.name(name, 0.5 * h * k);
      scene.problem.node_loads.push_back(
          {name, Dof::u2,
           TimeTable::ramp(-2.0 * kFirst * (k % 2 == 0 ? h / 3.0 : 2.0 * h / 3.0), 2.0 * kFirst)});
    }
    const auto beam = scene.beam;
    Solver<2> solver(std::move(scene.problem), kStiff);
    ASSERT_TRUE(solver.equilibrate().converged);
    ASSERT_TRUE(solver.advance(0.95 * kFirst).converged);
    EXPECT_TRUE(beam->take_notes().empty());
    for (const double load : {1.075, 1.32}) {
      ASSERT_TRUE(solver.advance(load * kFirst).converged);
      double most = 0.0;
      for (const BeamResult& end : beam->results(solver.problem()))
        most = std::max(most, std::abs(end.moment) / kPlastic);
      EXPECT_GT(most, 1.05);
      const std::vector<std::string> notes = beam->take_notes();
      ASSERT_EQ(notes.size(), 1U) << load;
      EXPECT_NE(notes.front().find(fmt::format(" is {:.3g} times Mp", most)), std::string::npos)
          << notes.front();
    }
    ASSERT_TRUE(solver.advance(1.33 * kFirst).converged);
    EXPECT_TRUE(beam->take_notes().empty());
  }
}

// A portal frame along three sides of a block, feet clamped, pushed at its head: closed form of slope deflection with one EI.
// Length and shear give way by 1e-5 of the bending.
TEST(beam, a_portal_frame_pushed_sideways) {
  Problem<2> problem;
  problem.mesh = rectangle({{4.0, 3.0}, {4, 3}}, "Q8R");
  problem.materials["all"] = elastic_ground<2>(1e9);
  // The way goes up on the left, to the right and down: reversed sides, so that the corner is one node.
  std::vector<BoundarySide>& frame = problem.mesh.boundaries["frame"];
  for (const std::string side : {"left", "top", "right"})
    frame.insert(frame.end(), problem.mesh.boundaries[side].begin(), problem.mesh.boundaries[side].end());
  hold_all(problem);
  const auto faces = faces_along(problem.mesh, "frame");
  const auto own = add_own_nodes(problem.mesh, faces);
  problem.mesh.node_sets["body"] = own.nodes;
  problem.prescribed.push_back({"body", Dof::w, kZero, {}});
  const double bending = 3e6;
  const auto beam = add_beam(problem, {1e12, bending, 1e12}, faces, own.face_nodes);
  name_node<2>(problem.mesh, "left foot", {0.0, 0.0}, "body");
  name_node<2>(problem.mesh, "right foot", {4.0, 0.0}, "body");
  name_node<2>(problem.mesh, "head", {0.0, 3.0}, "body");
  for (const std::string foot : {"left foot", "right foot"}) {
    problem.prescribed.push_back({foot, Dof::u1, kZero, {}});
    problem.prescribed.push_back({foot, Dof::u2, kZero, {}});
    problem.prescribed_fields.push_back({kBeamRotation, foot, kZero, {}, {}});
  }
  problem.node_loads = {{"head", Dof::u1, TimeTable::ramp(6e3)}};
  Solver<2> solver(std::move(problem), kStiff);
  ASSERT_TRUE(solver.equilibrate().converged);
  ASSERT_TRUE(solver.advance(1.0).converged);
  // With k = (I_beam / L) / (I_column / h) = h / L: sway P h^3 (3 k + 2) / (12 EI (6 k + 1)), feet P h (3 k + 1) / (2 (6 k + 1)).
  const double k = 3.0 / 4.0;
  EXPECT_NEAR(solver.mean_displacement("head")(0), 6e3 * 27 * (3 * k + 2) / (12 * bending * (6 * k + 1)),
              1e-7);
  double at_foot = 0.0;
  for (const BeamResult& end : beam->results(solver.problem()))
    if (end.place.norm() < 1e-9) at_foot = std::abs(end.moment);
  EXPECT_NEAR(at_foot, 6e3 * 3 * (3 * k + 1) / (2 * (6 * k + 1)), 0.05);
}

// Welded to the ground: the bending stiffness of both together, E h^3 / 12 of the ground and EI of beams on its axis.
TEST(beam, welded_to_the_ground_it_stiffens_it) {
  const auto deflection = [](double bending) {
    Problem<2> problem;
    problem.mesh = rectangle({{8.0, 0.5}, {16, 2}}, "Q8R");
    problem.continuum = Continuum::cauchy;
    problem.materials["all"] = elastic_ground<2>(1e8, 0.0);
    name_nodes(problem.mesh, "axis", [](const auto& x) { return x(1) == 0.25; });
    if (bending > 0.0) {
      const auto faces = faces_along(problem.mesh, "axis");
      std::vector<std::vector<int>> nodes;
      for (const auto& face : faces) nodes.push_back(face.first_nodes);
      add_beam(problem, {1.0, bending, 1e12}, faces, nodes);
      problem.prescribed_fields.push_back({kBeamRotation, "root", kZero, {}, {}});
      name_node<2>(problem.mesh, "root", {0.0, 0.25}, "axis");
    }
    for (const Dof dof : {Dof::u1, Dof::u2}) problem.prescribed.push_back({"left", dof, kZero, {}});
    name_node<2>(problem.mesh, "tip", {8.0, 0.25}, "axis");
    problem.node_loads = {{"tip", Dof::u2, TimeTable::ramp(1e3)}};
    Solver<2> solver(std::move(problem), kStiff);
    EXPECT_TRUE(solver.equilibrate().converged);
    EXPECT_TRUE(solver.advance(1.0).converged);
    return solver.mean_displacement("tip")(1);
  };
  const double of_ground = 1e8 * 0.125 / 12;
  EXPECT_NEAR(deflection(0.0), 1e3 * 512 / (3 * of_ground), 0.01 * 1e3 * 512 / (3 * of_ground));
  const double both = of_ground + 2e6;
  EXPECT_NEAR(deflection(2e6), 1e3 * 512 / (3 * both), 0.01 * 1e3 * 512 / (3 * both));
}

// A plate of soft ground pressed from above, clamped on its left: the beam along its bottom carries nearly all, its shear at the foot
// q L, at the middle of the way q L / 2, at the tip nothing.
TEST(beam, shear_of_a_welded_beam_is_in_balance_with_its_load) {
  for (const int elements : {1, 2, 5}) {
    Problem<2> problem;
    problem.mesh = rectangle({{2.0, 0.1}, {elements, 1}}, "Q8R");
    problem.continuum = Continuum::cauchy;
    problem.materials["all"] = elastic_ground<2>(1.0, 0.0);
    const auto faces = faces_along(problem.mesh, "bottom");
    std::vector<std::vector<int>> nodes;
    for (const auto& face : faces) nodes.push_back(face.first_nodes);
    const auto beam = add_beam(problem, {1e8, 2e6, 1e7}, faces, nodes);
    problem.prescribed_fields.push_back({kBeamRotation, "bottom_left", kZero, {}, {}});
    for (const Dof dof : {Dof::u1, Dof::u2}) problem.prescribed.push_back({"left", dof, kZero, {}});
    problem.boundary_loads = {{.on = "bottom", .pressure = TimeTable::ramp(6e3)}};
    Solver<2> solver(std::move(problem), kTightOfBeam);
    ASSERT_TRUE(solver.equilibrate().converged);
    ASSERT_TRUE(solver.advance(1.0).converged);
    for (const BeamResult& end : beam->results(solver.problem()))
      EXPECT_NEAR(std::abs(end.shear), 6e3 * (2.0 - end.place(0)), 1.0) << elements;
  }
}

/// A block of 1 m whose top moves, with a node "middle" in the midst of it.
Problem<2> block_that_is_drawn(const TimeTable& movement) {
  Problem<2> problem;
  problem.mesh = rectangle({{1.0, 1.0}, {1, 1}});
  problem.materials["all"] = elastic_ground<2>(1e7, 0.0);
  problem.prescribed = {{"bottom", Dof::u2, kZero, {}},
                        {"bottom_left", Dof::u1, kZero, {}},
                        {"all", Dof::w, kZero, {}},
                        {"top", Dof::u2, movement, {}}};
  name_nodes(problem.mesh, "middle", [](const auto& x) { return x(1) == 1.0 && x(0) == 0.5; });
  return problem;
}

TEST(anchor, holds_its_prestress_and_yields) {
  Problem<2> problem =
      block_that_is_drawn(TimeTable({{0.0, 0.0}, {1.0, 1e-3}, {2.0, 1e-2}, {3.0, 9e-3}, {4.0, -2e-2}}));
  // From the middle of the top, 2 m straight down to a fixed place.
  AnchorSettings<2> settings{"tie", problem.mesh.nodes_on("middle").front(), {}, {0.5, -1.0}, 4e6};
  settings.prestress = 1e3;
  settings.strength = 8e3;
  settings.compressive_strength = 2e3;
  const auto anchor = std::make_shared<Anchor<2>>(problem.mesh, settings);
  problem.contributions.push_back(anchor);
  Solver<2> solver(std::move(problem), kTightOfBeam);
  ASSERT_TRUE(solver.equilibrate().converged);
  EXPECT_NEAR(anchor->force(), 1e3, 1e-9);
  for (const auto& [time, force] : {std::pair(1.0, 1e3 + 2e6 * 1e-3), std::pair(2.0, 8e3),
                                    std::pair(3.0, 8e3 - 2e6 * 1e-3), std::pair(4.0, -2e3)}) {
    ASSERT_TRUE(solver.advance(time).converged);
    EXPECT_NEAR(anchor->force(), force, 1e-8) << time;
    // Pulled in, the body's top is held back by the tie.
    EXPECT_GT(solver.reaction("top")(1), force - 1e9);
  }
}

/// A rod of 1 m and 1 MN on the top of a block that is drawn up, let back, pushed down by 5 mm and drawn up again.
struct PulledRod {
  std::string what;
  double prestress, strength, compressive_strength;
  std::vector<double> forces;  ///< N, by time
};

// A slack rope keeps its length, so that it is taut again where it went slack. Yielding leaves a length, in tension and in a strut.
TEST(anchor, is_a_rope_or_a_strut) {
  for (const PulledRod& rod : {
           PulledRod{"rope", 0.0, HUGE_VAL, 0.0, {5e3, 0.0, 0.0, 3e3, 5e3, 0.0}},
           PulledRod{"rope with a prestress", 2e3, HUGE_VAL, 0.0, {7e3, 2e3, 0.0, 5e3, 7e3, 2e3}},
           PulledRod{"rope that yields", 0.0, 4e3, 0.0, {4e3, 0.0, 0.0, 2e3, 4e3, 0.0}},
           PulledRod{"prestressed rope that yields", 2e3, 6e3, 0.0, {6e3, 1e3, 0.0, 4e3, 6e3, 1e3}},
           PulledRod{"strut", 0.0, HUGE_VAL, 2e3, {5e3, 0.0, -2e3, 6e3, 8e3, 3e3}},
           PulledRod{"rod", 0.0, HUGE_VAL, HUGE_VAL, {5e3, 0.0, -5e3, 3e3, 5e3, 0.0}},
       }) {
    Problem<2> problem = block_that_is_drawn(
        TimeTable({{0.0, 0.0}, {1.0, 5e-3}, {2.0, 0.0}, {3.0, -5e-3}, {4.0, 3e-3}, {5.0, 5e-3}, {6.0, 0.0}}));
    AnchorSettings<2> settings{"tie", problem.mesh.nodes_on("middle").front(), {}, {0.5, 0.0}, 1e6};
    settings.prestress = rod.prestress;
    settings.strength = rod.strength;
    settings.compressive_strength = rod.compressive_strength;
    const auto anchor = std::make_shared<Anchor<2>>(problem.mesh, settings);
    problem.contributions.push_back(anchor);
    Solver<2> solver(std::move(problem), kTightOfBeam);
    ASSERT_TRUE(solver.equilibrate().converged) << rod.what;
    EXPECT_NEAR(anchor->force(), rod.prestress, 1e-8) << rod.what;
    for (std::size_t k = 0; k < rod.forces.size(); ++k) {
      const StepReport report = solver.advance(static_cast<double>(k + 1));
      ASSERT_TRUE(report.converged) << rod.what << k << report.message;
      EXPECT_NEAR(anchor->force(), rod.forces[k], 1e-8) << rod.what << k;
      // Of the block 0.5 * 1e7 * 5e-3^2 at first, of the rod half its force more.
      EXPECT_NEAR(solver.state().internal_work, solver.state().external_work, 125.0 * 1e-9) << rod.what << k;
      if (k == 0 && rod.what == "rod") {
        EXPECT_NEAR(solver.state().internal_work, 125.0 + 12.5, 1e-7);
      }
    }
  }
}

// A rope of 1 MN that yields at 4 kN: taut, slack and yielding.
TEST(anchor, tangent_is_the_slope_of_its_force) {
  const Mesh<2> mesh = rectangle({{1.0, 1.0}, {1, 1}});
  AnchorSettings<2> settings{"tie", 0, 1, {}, 1e6};
  settings.compressive_strength = 0.0;
  settings.strength = 4e3;
  Anchor<2> anchor(mesh, settings);
  anchor.allocate();
  const Eigen::VectorXd start =
      Eigen::VectorXd::Zero(Cosserat<2>::dofs * static_cast<Eigen::Index>(mesh.nodes.size()));
  const double length = (mesh.nodes[1] - mesh.nodes[0]).norm();
  const Eigen::Vector2d way = (mesh.nodes[1] - mesh.nodes[0]) / length;
  const auto force_at = [&](double strain) {
    Eigen::VectorXd increment = start;
    increment.segment<2>(entry_of<2>(1)) = strain * length * way;
    NodalForces forces{start, start};
    EXPECT_EQ(anchor.evaluate({0.0, 1.0, start, increment}, forces), "");
    return way.dot(forces.internal.segment<2>(entry_of<2>(1)));
  };
  const double stiffness = settings.axial_stiffness / length;
  constexpr double kStep = 1e-6;
  for (const auto& [strain, share] : {std::pair(2e-3, 1.0), std::pair(-2e-3, 0.0), std::pair(8e-3, 0.0)}) {
    const double slope = (force_at(strain + kStep) - force_at(strain - kStep)) / (2 * kStep * length);
    (void)force_at(strain);
    // Its entries are those of node 0, then those of node 1.
    const Eigen::Matrix2d of_second = anchor.tangent(0).bottomRightCorner<2, 2>();
    EXPECT_NEAR(slope, share * stiffness, 1e-6 * stiffness) << strain;
    EXPECT_NEAR(way.dot(of_second * way), slope, 2e-6 * stiffness) << strain;
  }
}

}  // namespace
