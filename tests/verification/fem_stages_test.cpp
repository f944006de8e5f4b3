// SPDX-License-Identifier: GPL-2.0-or-later
// Stages of construction: parts that come and go, against superposition, closed forms and an independent program.
#include <gtest/gtest.h>

#include <functional>
#include <iostream>
#include <utility>

#include "common/error.hpp"
#include "common/memory_archive.hpp"
#include "fem/material/cone_matching.hpp"
#include "fem/material/elastic.hpp"
#include "fem/material/elastoplastic.hpp"
#include "fem/material/local_material.hpp"
#include "fem/mesh/rectangle.hpp"
#include "fem/solver/geostatic.hpp"
#include "fem/solver/solver.hpp"

using namespace polargrain;
using namespace polargrain::fem;

namespace {

constexpr double kWeightOfStages = 18e3;
constexpr double kModulus = 20e6;
constexpr double kRatio = 0.3;
const double kOedometric = kModulus * (1 - kRatio) / ((1 + kRatio) * (1 - 2 * kRatio));
const TimeTable kZeroOfStages = TimeTable::constant(0.0);

std::shared_ptr<Material<2>> elastic() {
  return std::make_shared<LocalMaterial<ElasticLaw<2>>>(
      ElasticLaw<2>(ElasticParameters<2>{kModulus, kRatio, 8e6, 0.2}));
}

/// Rows and columns of unequal elements.
Mesh<2> grid(const std::vector<double>& x, const std::vector<double>& y) {
  const auto columns = static_cast<double>(x.size() - 1);
  const auto rows = static_cast<double>(y.size() - 1);
  Mesh<2> mesh = rectangle({{columns, rows}, {static_cast<int>(columns), static_cast<int>(rows)}});
  const auto place = [](const std::vector<double>& places, double at) {
    const auto cell = std::min(static_cast<std::size_t>(at), places.size() - 2);
    return places[cell] + (at - static_cast<double>(cell)) * (places[cell + 1] - places[cell]);
  };
  for (Eigen::Vector2d& node : mesh.nodes) node = {place(x, node.x()), place(y, node.y())};
  return mesh;
}

/// Gives the elements with their centres in a box to a region, and the others to `rest`.
void cut_out(Mesh<2>& mesh, const std::string& name, const Eigen::Vector2d& low,
             const Eigen::Vector2d& high) {
  std::vector<int>& rest = mesh.regions["rest"];
  if (mesh.regions.size() == 2 && rest.empty()) rest = mesh.regions.at("all");
  for (const int e : mesh.regions.at("all")) {
    const Eigen::Vector2d centre = mesh.element_positions(e).colwise().mean();
    if ((centre.array() < low.array()).any() || (centre.array() > high.array()).any()) continue;
    mesh.regions[name].push_back(e);
    std::erase(rest, e);
  }
}

/// The half of ground that a pit is dug in, as an independent program has computed it.
struct Pit {
  double width = 4.0;
  double depth = 5.0;
  Continuum continuum = Continuum::cauchy;
  double earth_pressure_ratio = 0.6;
  double surcharge = 0.0;
};

/// @param stages in which the pit is dug, layer by layer
Problem<2> ground_with_pit(const Pit& pit, int stages,
                           const std::function<std::shared_ptr<Material<2>>()>& law) {
  Problem<2> problem;
  problem.continuum = pit.continuum;
  problem.mesh = grid({0, 1, 2, 3, 4, 5, 6, 8, 11, 15, 20}, {-10, -8, -7, -6, -5, -4, -3, -2, -1, 0});
  problem.stages = {"ground"};
  for (int k = 0; k < stages; ++k) {
    const std::string name = "layer " + std::to_string(k);
    const double layer = pit.depth / stages;
    cut_out(problem.mesh, name, {0, -(k + 1) * layer}, {pit.width, -k * layer});
    problem.materials[name] = law();
    problem.lifetimes[name] = {0, k + 1};
    problem.stages.push_back("dig " + name);
  }
  problem.materials["rest"] = law();
  problem.prescribed = {{"left", Dof::u1, kZeroOfStages},
                        {"right", Dof::u1, kZeroOfStages},
                        {"bottom", Dof::u1, kZeroOfStages},
                        {"bottom", Dof::u2, kZeroOfStages}};
  if (pit.continuum == Continuum::cosserat) {
    problem.prescribed.push_back({"left", Dof::w, kZeroOfStages});
    problem.prescribed.push_back({"right", Dof::w, kZeroOfStages});
  }
  problem.body_loads = {gravity(kWeightOfStages)};
  problem.initial_stresses = {
      geostatic_stress({0.0, kWeightOfStages, pit.earth_pressure_ratio, pit.surcharge})};
  if (pit.surcharge > 0.0)
    problem.boundary_loads = {{.on = "top", .pressure = TimeTable::constant(pit.surcharge)}};
  return problem;
}

constexpr double kTight = 1e-13;
SolverOptions tight() {
  SolverOptions options;
  options.force_tolerance = options.moment_tolerance = kTight;
  return options;
}

/// Goes through all stages, each in so many steps.
void go_through(Solver<2>& solver, int steps) {
  const StepReport begun = solver.equilibrate();
  ASSERT_TRUE(begun.converged) << begun.message;
  for (int stage = 1; stage < static_cast<int>(solver.problem().stages.size()); ++stage) {
    solver.begin_stage(stage);
    for (int step = 1; step <= steps; ++step) {
      const double share = static_cast<double>(step) / steps;
      const StepReport report = solver.advance(stage - 1 + share, share);
      ASSERT_TRUE(report.converged) << "stage " << stage << ": " << report.message;
    }
  }
}

double displacement_at(const Solver<2>& solver, const Eigen::Vector2d& place, Dof dof) {
  const Mesh<2>& mesh = solver.problem().mesh;
  for (std::size_t node = 0; node < mesh.nodes.size(); ++node)
    if ((mesh.nodes[node] - place).norm() < 1e-9)
      return solver.shown_displacement()(static_cast<Eigen::Index>(entry_of<2>(node, dof)));
  throw RunError("no node there");
}

TEST(excavation, of_an_elastic_half_plane_meets_the_figures_of_an_independent_program) {
  struct Figure {
    Eigen::Vector2d place;
    Dof dof;
    double cauchy, cosserat;
  };
  const std::vector<Figure> figures{{{0, -5}, Dof::u2, 1.721975e-2, 1.715853e-2},
                                    {{4, 0}, Dof::u1, -4.975593e-3, -4.928576e-3},
                                    {{4, 0}, Dof::u2, 1.886134e-3, 1.968260e-3},
                                    {{4, -2}, Dof::u1, -7.563449e-3, -7.449937e-3}};
  for (const Continuum continuum : {Continuum::cauchy, Continuum::cosserat}) {
    for (const int stages : {1, 5}) {
      Solver<2> solver(ground_with_pit({.continuum = continuum}, stages, elastic), tight());
      go_through(solver, 1);
      for (const Figure& figure : figures) {
        const double expected = continuum == Continuum::cauchy ? figure.cauchy : figure.cosserat;
        // The figures have seven digits.
        EXPECT_NEAR(displacement_at(solver, figure.place, figure.dof) / expected, 1.0, 5e-7)
            << figure.place.transpose() << ", " << stages << " stages";
      }
    }
  }
}

class EveryPit : public ::testing::TestWithParam<Pit> {};

TEST_P(EveryPit, elastic_ground_does_not_know_in_how_many_stages_it_was_dug) {
  const auto dug = [](int stages, int steps) {
    Solver<2> solver(ground_with_pit(GetParam(), stages, elastic), tight());
    go_through(solver, steps);
    return solver.state().displacement;
  };
  const Eigen::VectorXd at_once = dug(1, 1);
  const Eigen::VectorXd in_layers = dug(static_cast<int>(GetParam().depth), 1);
  // Nodes of the pit have left the system at different times: compare those of the ground.
  Problem<2> problem = ground_with_pit(GetParam(), 1, elastic);
  const std::vector<char> left = nodes_of_elements(problem.mesh, elements_in_stage(problem, 1));
  double difference = 0.0;
  for (Eigen::Index entry = 0; entry < at_once.size(); ++entry)
    if (left[static_cast<std::size_t>(entry) / 3] != 0)
      difference = std::max(difference, std::abs(at_once(entry) - in_layers(entry)));
  const double largest = at_once.lpNorm<Eigen::Infinity>();
  std::cout << "[figure] one stage against layers: " << difference / largest << '\n';
  EXPECT_LT(difference, 1e-9 * largest);
  EXPECT_LT((dug(1, 7) - at_once).lpNorm<Eigen::Infinity>(), 1e-9 * largest);
}

INSTANTIATE_TEST_SUITE_P(Pits, EveryPit,
                         ::testing::Values(Pit{},
                                           Pit{.width = 6, .depth = 3, .continuum = Continuum::cosserat},
                                           Pit{.width = 2, .depth = 4, .earth_pressure_ratio = 1.4},
                                           Pit{.width = 8, .depth = 2, .surcharge = 20e3}));

/// Closed form: each layer comes without stress, and its weight compresses it and all below.
TEST(fill, that_comes_in_layers_settles_as_the_column_of_them_does) {
  constexpr int kLayers = 4;
  constexpr double kHeight = 2.0;
  for (const Continuum continuum : {Continuum::cauchy, Continuum::cosserat}) {
    for (const Deformation deformation : {Deformation::small, Deformation::large}) {
      Problem<2> problem;
      problem.continuum = continuum;
      problem.deformation = deformation;
      problem.mesh = rectangle({{1.0, kLayers * kHeight}, {1, kLayers}});
      for (int k = 0; k < kLayers; ++k) {
        const std::string name = "layer " + std::to_string(k);
        cut_out(problem.mesh, name, {0, k * kHeight}, {1, (k + 1) * kHeight});
        problem.materials[name] = elastic();
        problem.lifetimes[name] = {k, INT_MAX};
        problem.stages.push_back(name);
      }
      problem.prescribed = {{"left", Dof::u1, kZeroOfStages},
                            {"right", Dof::u1, kZeroOfStages},
                            {"bottom", Dof::u2, kZeroOfStages}};
      problem.body_loads = {gravity(kWeightOfStages)};
      Solver<2> solver(std::move(problem), tight());
      go_through(solver, 3);
      const double unit = kWeightOfStages * kHeight * kHeight / kOedometric;
      for (int k = 1; k <= kLayers; ++k) {
        const double expected = -unit * (k - 0.5 + (kLayers - k) * k);
        // In large deformation layers get thinner by strains of up to 0.5 %.
        EXPECT_NEAR(displacement_at(solver, {0, k * kHeight}, Dof::u2) / expected, 1.0,
                    deformation == Deformation::small ? 1e-11 : 1.5e-2);
      }
      EXPECT_NEAR(solver.reaction("bottom")(1) / (kWeightOfStages * kHeight * kLayers), 1.0, 1e-11);
    }
  }
}

/// Closed form: fill that comes with the stress of its weight is in balance with it, and only the ground below gives way.
TEST(fill, that_comes_with_the_stress_of_its_weight_moves_with_the_ground_as_a_block) {
  for (const double height : {0.5, 1.5}) {
    Problem<2> problem;
    problem.continuum = Continuum::cauchy;
    problem.mesh = grid({0, 1, 3}, {0, 1, 2, 2 + 0.5 * height, 2 + height});
    cut_out(problem.mesh, "fill", {0, 2}, {3, 2 + height});
    problem.stages = {"ground", "fill"};
    problem.lifetimes["fill"] = {1, INT_MAX};
    problem.materials["fill"] = elastic();
    problem.materials["rest"] = elastic();
    problem.prescribed = {{"left", Dof::u1, kZeroOfStages},
                          {"right", Dof::u1, kZeroOfStages},
                          {"bottom", Dof::u2, kZeroOfStages}};
    problem.body_loads = {gravity(kWeightOfStages)};
    problem.initial_stresses = {geostatic_stress({2.0 + height, kWeightOfStages, 0.4, 0.0}, "fill"),
                                geostatic_stress({2.0, kWeightOfStages, 0.4, 0.0}, "rest")};
    Solver<2> solver(std::move(problem), tight());
    go_through(solver, 2);
    const double settled = -kWeightOfStages * height * 2.0 / kOedometric;
    EXPECT_NEAR(displacement_at(solver, {0, 2}, Dof::u2) / settled, 1.0, 1e-11);
    EXPECT_NEAR(displacement_at(solver, {3, 2 + height}, Dof::u2) / settled, 1.0, 1e-11);
    for (std::size_t i = 0; i < solver.points(); ++i) {
      const double vertical = -kWeightOfStages * (2.0 + height - solver.position_of_point(i).y());
      EXPECT_NEAR(solver.state().responses[i].stress(k22) / vertical, 1.0, 1e-9);
    }
  }
}

/// Ground of 10 m settles by 18e4 * 10^2 / 2 / 26.9e6 = 0.33 m. The lower nodes of 1 m of fill have gone along when it comes, and
/// its upper ones have not: that is no strain of the fill, whose own is below 1 %.
TEST(fill, that_comes_on_settled_ground_is_strained_from_then_on) {
  const auto problem = [] {
    Problem<2> made;
    made.continuum = Continuum::cauchy;
    made.mesh = rectangle({{1.0, 11.0}, {1, 11}});
    cut_out(made.mesh, "fill", {0, 10}, {1, 11});
    made.materials = {{"fill", elastic()}, {"rest", elastic()}};
    made.lifetimes["fill"] = {1, INT_MAX};
    made.stages = {"ground", "fill", "press"};
    made.prescribed = {{"left", Dof::u1, kZeroOfStages},
                       {"right", Dof::u1, kZeroOfStages},
                       {"bottom", Dof::u2, kZeroOfStages}};
    made.body_loads = {gravity(10.0 * kWeightOfStages)};
    made.boundary_loads = {{.on = "top", .pressure = TimeTable::constant(5e6), .life = {2, INT_MAX}}};
    return made;
  };
  Solver<2> solver(problem(), tight());
  ASSERT_TRUE(solver.equilibrate().converged);
  EXPECT_LT(displacement_at(solver, {0, 10}, Dof::u2), -0.3);
  solver.begin_stage(1);
  ASSERT_TRUE(solver.advance(1.0).converged);
  EXPECT_EQ(solver.left_out(), "");
  MemoryArchive archive;
  solver.save(archive);
  Solver<2> resumed(problem(), tight());
  resumed.restore(archive);
  EXPECT_EQ(resumed.left_out(), "");
  Problem<2> all = problem();
  all.lifetimes.clear();
  all.stages.clear();
  all.boundary_loads.clear();
  Solver<2> after(std::move(all), {});
  ASSERT_TRUE(after.start_from(archive, {"fill", "rest"}).step.converged);
  EXPECT_EQ(after.left_out(), "");
  // What strains all of it is told: (18e4 * 10.79 + 5e6) / 26.9e6 at the lowest points.
  solver.begin_stage(2);
  ASSERT_TRUE(solver.advance(2.0).converged);
  EXPECT_NE(solver.left_out().find("element 0 has been strained by 0.26:"), std::string::npos)
      << solver.left_out();
}

/// A stress without a region is that of the ground at time zero; above its surface it would be a tension in the fill.
TEST(fill, that_comes_on_ground_of_a_given_stress_begins_without_one) {
  const auto stress_of_fill = [](const std::string& named) {
    Problem<2> problem;
    problem.continuum = Continuum::cauchy;
    problem.mesh = rectangle({{1.0, 3.0}, {1, 3}});
    cut_out(problem.mesh, "fill", {0, 2}, {1, 3});
    problem.materials = {{"fill", elastic()}, {"rest", elastic()}};
    problem.lifetimes["fill"] = {1, INT_MAX};
    problem.stages = {"ground", "fill"};
    problem.prescribed = {{"left", Dof::u1, kZeroOfStages},
                          {"right", Dof::u1, kZeroOfStages},
                          {"bottom", Dof::u2, kZeroOfStages}};
    problem.initial_stresses = {{[](const Eigen::Vector2d& place) {
                                   Vector7 stress = Vector7::Zero();
                                   stress(k22) = -kWeightOfStages * (2.0 - place.y());
                                   return stress;
                                 },
                                 named}};
    problem.body_loads = {gravity(kWeightOfStages)};
    problem.body_loads.front().region = "rest";
    Solver<2> solver(std::move(problem), tight());
    EXPECT_TRUE(solver.equilibrate().converged);
    solver.begin_stage(1);
    EXPECT_TRUE(solver.advance(1.0).converged);
    return solver.state().responses.back().stress(k22);
  };
  EXPECT_NEAR(stress_of_fill(""), 0.0, 1e-6);
  EXPECT_NEAR(stress_of_fill("rest"), 0.0, 1e-6);
}

/// A block that is pressed from above between two walls.
Problem<2> pressed_block(bool has_right_wall) {
  Problem<2> problem;
  problem.mesh = rectangle({{2.0, 1.0}, {4, 2}});
  problem.materials["all"] = elastic();
  problem.prescribed = {{"left", Dof::u1, kZeroOfStages}, {"bottom", Dof::u2, kZeroOfStages}};
  if (has_right_wall) problem.prescribed.push_back({"right", Dof::u1, kZeroOfStages, {}, {0, 1}});
  problem.boundary_loads = {{.on = "top", .pressure = TimeTable::constant(50e3)}};
  return problem;
}

TEST(support, that_ends_leaves_an_elastic_body_as_if_it_had_not_been_there) {
  Problem<2> staged = pressed_block(true);
  staged.stages = {"held", "free"};
  Solver<2> solver(std::move(staged), tight());
  go_through(solver, 4);
  Solver<2> free(pressed_block(false), tight());
  ASSERT_TRUE(free.equilibrate().converged);
  const double largest = free.state().displacement.lpNorm<Eigen::Infinity>();
  EXPECT_GT(largest, 1e-3);
  EXPECT_LT((solver.state().displacement - free.state().displacement).lpNorm<Eigen::Infinity>(),
            1e-11 * largest);
}

TEST(support, that_begins_holds_where_the_body_is_then_or_brings_it_back) {
  for (const bool from_here : {true, false}) {
    Problem<2> problem = pressed_block(false);
    problem.stages = {"loaded", "held", "unloaded"};
    problem.boundary_loads.front().life = {0, 2};
    problem.prescribed.push_back({"right", Dof::u1, kZeroOfStages, {}, {1, INT_MAX}, from_here});
    Solver<2> solver(std::move(problem), tight());
    ASSERT_TRUE(solver.equilibrate().converged);
    const double there = displacement_at(solver, {2, 1}, Dof::u1);
    EXPECT_GT(there, 1e-3);
    solver.begin_stage(1);
    ASSERT_TRUE(solver.advance(0.5, 0.5).converged);
    EXPECT_NEAR(displacement_at(solver, {2, 1}, Dof::u1), from_here ? there : 0.5 * there, 1e-15);
    ASSERT_TRUE(solver.advance(1.0, 1.0).converged);
    const double held = from_here ? there : 0.0;
    EXPECT_NEAR(displacement_at(solver, {2, 1}, Dof::u1), held, 1e-15);
    // Held where it is, the body feels no new force.
    const double pushed = solver.reaction("right")(0);
    if (from_here) {
      EXPECT_NEAR(pushed, 0.0, 1e-6);
    }
    solver.begin_stage(2);
    ASSERT_TRUE(solver.advance(2.0).converged);
    EXPECT_NEAR(displacement_at(solver, {2, 1}, Dof::u1), held, 1e-15);
    // Plane strain, unloaded above: the wall pulls the block along by u1, or brought it back to nothing.
    const double expected = kModulus / (1 - kRatio * kRatio) * held / 2.0;
    EXPECT_NEAR(solver.reaction("right")(0), expected, 1e-4);
  }
}

TEST(stage, that_is_interrupted_goes_on_to_the_same_bits) {
  const Pit pit{.continuum = Continuum::cosserat};
  const auto law = [] {
    ElastoplasticParameters<2> parameters;
    parameters.elastic = {kModulus, kRatio, 8e6, 0.2, Vector7::Zero()};
    const FrozenCone cone = cone_from_plane_strain({30, 5, 5e3});
    parameters.cone = {cone.friction, cone.dilatancy, cone.cohesion};
    return std::make_shared<LocalMaterial<ElastoplasticLaw<2>>>(ElastoplasticLaw<2>(parameters));
  };
  const auto steps = [](Solver<2>& solver, int from, int to) {
    for (int step = from; step < to; ++step) {
      const int stage = 1 + step / 3;
      if (step % 3 == 0) {
        solver.begin_stage(stage);
        if (stage == 2) solver.reset_displacements();
      }
      const double share = (step % 3 + 1) / 3.0;
      const StepReport report = solver.advance(stage - 1 + share, share);
      ASSERT_TRUE(report.converged) << step << ": " << report.message;
    }
  };
  Solver<2> whole(ground_with_pit(pit, 5, law), {});
  ASSERT_TRUE(whole.equilibrate().converged);
  steps(whole, 0, 9);
  for (const int interrupted : {1, 3, 4, 8}) {
    MemoryArchive archive;
    {
      Solver<2> first(ground_with_pit(pit, 5, law), {});
      ASSERT_TRUE(first.equilibrate().converged);
      steps(first, 0, interrupted);
      first.save(archive);
    }
    Solver<2> second(ground_with_pit(pit, 5, law), {});
    second.restore(archive);
    steps(second, interrupted, 9);
    EXPECT_EQ(second.state().displacement, whole.state().displacement) << interrupted;
    EXPECT_EQ(second.shown_displacement(), whole.shown_displacement());
    EXPECT_EQ(second.state().external_work, whole.state().external_work);
  }
}

TEST(stage, shows_displacements_since_they_were_reset) {
  Solver<2> solver(ground_with_pit({}, 5, elastic), tight());
  ASSERT_TRUE(solver.equilibrate().converged);
  solver.begin_stage(1);
  ASSERT_TRUE(solver.advance(1.0).converged);
  const double first = displacement_at(solver, {0, -5}, Dof::u2);
  solver.reset_displacements();
  EXPECT_EQ(displacement_at(solver, {0, -5}, Dof::u2), 0.0);
  solver.begin_stage(2);
  ASSERT_TRUE(solver.advance(2.0).converged);
  const Eigen::Index entry = 0;
  EXPECT_NE(first, 0.0);
  EXPECT_EQ(solver.shown_displacement()(entry),
            solver.state().displacement(entry) - solver.state().shown_from(entry));
}

TEST(stage, that_leaves_a_body_unheld_is_a_fault) {
  Problem<2> problem = pressed_block(true);
  problem.stages = {"held", "free"};
  problem.prescribed.front().life = {0, 1};
  const std::vector<std::string> messages = faults(problem);
  ASSERT_EQ(messages.size(), 1U);
  EXPECT_NE(messages.front().find("stage 'free'"), std::string::npos);
  EXPECT_NE(messages.front().find("translation along 1"), std::string::npos);
}

/// 72 m2 of ground of 18 kN/m3 and a load of 100 kPa on a line of 2 m inside of it; 2 m2 of ground elsewhere go, or come.
TEST(stage, that_changes_ground_elsewhere_leaves_a_load_inside_of_the_body) {
  constexpr double kLoad = 2.0 * 100e3;
  for (const Lifetime life : {Lifetime{0, 1}, Lifetime{1, INT_MAX}}) {
    for (const int load_begins : {0, 1}) {
      Problem<2> problem;
      problem.continuum = Continuum::cauchy;
      problem.mesh = rectangle({{12.0, 6.0}, {12, 6}});
      cut_out(problem.mesh, "part", {10, 5}, {12, 6});
      for (const int e : problem.mesh.regions.at("rest")) {
        const Eigen::Vector2d centre = problem.mesh.element_positions(e).colwise().mean();
        if (centre.x() > 2 && centre.x() < 4 && centre.y() > 4 && centre.y() < 5)
          problem.mesh.boundaries["slab"].push_back({e, 2});
      }
      ASSERT_EQ(problem.mesh.boundaries.at("slab").size(), 2U);
      problem.materials = {{"part", elastic()}, {"rest", elastic()}};
      problem.stages = {"before", "after"};
      problem.lifetimes["part"] = life;
      problem.prescribed = {{"left", Dof::u1, kZeroOfStages},
                            {"right", Dof::u1, kZeroOfStages},
                            {"bottom", Dof::u2, kZeroOfStages}};
      problem.body_loads = {gravity(kWeightOfStages)};
      problem.boundary_loads = {{.on = "slab"}};
      problem.boundary_loads.front().traction[1] = TimeTable::constant(-100e3);
      problem.boundary_loads.front().life.begin = load_begins;
      EXPECT_EQ(faults(problem), std::vector<std::string>{});
      Solver<2> solver(std::move(problem), tight());
      const auto expected = [&](int stage) {
        return kWeightOfStages * (life.holds(stage) ? 72.0 : 70.0) + (stage >= load_begins ? kLoad : 0.0);
      };
      // To round-off: the residual is at most 1e-13 of the forces.
      ASSERT_TRUE(solver.equilibrate().converged);
      EXPECT_NEAR(solver.reaction("bottom")(1) / expected(0), 1.0, 1e-10);
      solver.begin_stage(1);
      ASSERT_TRUE(solver.advance(1.0, 1.0).converged);
      EXPECT_NEAR(solver.reaction("bottom")(1) / expected(1), 1.0, 1e-10);
    }
  }
}

TEST(stage, that_loads_a_curve_inside_of_the_body_is_a_fault) {
  Problem<2> problem = ground_with_pit({}, 1, elastic);
  std::vector<BoundarySide>& floor = problem.mesh.boundaries["floor"];
  for (const int e : problem.mesh.regions.at("rest"))
    if (problem.mesh.element_positions(e).row(2).y() == -5.0 &&
        problem.mesh.element_positions(e).row(2).x() <= 4.0)
      floor.push_back({e, 2});
  ASSERT_EQ(floor.size(), 4U);
  problem.stages.emplace_back("fill with water");
  problem.boundary_loads = {{.on = "floor", .pressure = TimeTable::constant(50e3), .life = {2, INT_MAX}}};
  EXPECT_EQ(faults(problem), std::vector<std::string>{});
  // The pressure acts on the floor: as much as the reaction below grows by.
  Problem<2> dry = problem;
  for (auto* of : {&problem, &dry})
    for (auto& [region, material] : of->materials) material = elastic();
  dry.boundary_loads.clear();
  Solver<2> solver(problem, tight());
  go_through(solver, 1);
  Solver<2> without(std::move(dry), tight());
  go_through(without, 1);
  EXPECT_NEAR(solver.reaction("bottom")(1) - without.reaction("bottom")(1), 4 * 50e3, 1e-4);
  // The same of a pressure from the start that is zero until the pit is dug.
  Problem<2> from_start = problem;
  for (auto& [region, material] : from_start.materials) material = elastic();
  from_start.stage_starts = {0.0, 0.0, 1.0};
  from_start.boundary_loads = {{.on = "floor", .pressure = TimeTable({{0.0, 0.0}, {1.0, 0.0}, {2.0, 50e3}})}};
  EXPECT_EQ(faults(from_start), std::vector<std::string>{});
  Solver<2> filled(std::move(from_start), tight());
  go_through(filled, 1);
  EXPECT_NEAR(filled.reaction("bottom")(1) - without.reaction("bottom")(1), 4 * 50e3, 1e-4);
  // Before the pit is dug, and where nothing is dug at all, ground lies on both sides of the floor.
  const auto is_told = [&](const std::string& stage) {
    const std::vector<std::string> found = faults(problem);
    return found.size() == 1 &&
           found.front().starts_with(
               stage +
               "the pressure on 'floor' has ground on both sides at (1, -5): it has no side to act from");
  };
  problem.boundary_loads.front().life = {0, INT_MAX};
  EXPECT_TRUE(is_told(""));
  problem.lifetimes.clear();
  EXPECT_TRUE(is_told(""));
  problem.boundary_loads.front().life.begin = 1;
  EXPECT_TRUE(is_told("stage 'dig layer 0': "));
  // A traction has a direction.
  problem.boundary_loads.front().traction[1] =
      std::exchange(problem.boundary_loads.front().pressure, kZeroOfStages);
  EXPECT_EQ(faults(problem), std::vector<std::string>{});
}

/// Of a bank with a line at its middle one half is dug; a pressure on that line begins then.
TEST(stage, that_digs_either_side_of_a_curve_lets_its_pressure_push_what_is_left) {
  std::vector<double> pushed;
  for (const double from : {0.0, 2.0}) {
    Problem<2> problem;
    problem.continuum = Continuum::cauchy;
    problem.mesh = rectangle({{4.0, 2.0}, {4, 2}});
    cut_out(problem.mesh, "pit", {from, 0}, {from + 2, 2});
    for (const int e : problem.mesh.regions.at("all"))  // as the elements at the left see it
      if (problem.mesh.element_positions(e).col(0).maxCoeff() == 2.0)
        problem.mesh.boundaries["face"].push_back({e, 1});
    problem.materials = {{"pit", elastic()}, {"rest", elastic()}};
    problem.stages = {"before", "dig"};
    problem.lifetimes["pit"] = {0, 1};
    problem.prescribed = {{"bottom", Dof::u1, kZeroOfStages}, {"bottom", Dof::u2, kZeroOfStages}};
    problem.boundary_loads = {{.on = "face", .pressure = TimeTable::constant(20e3)}};
    EXPECT_EQ(faults(problem).size(), 1U);
    problem.boundary_loads.front().life.begin = 1;
    ASSERT_EQ(faults(problem), std::vector<std::string>{});
    Solver<2> solver(std::move(problem), tight());
    go_through(solver, 1);
    pushed.push_back(-solver.reaction("bottom")(0));
  }
  EXPECT_NEAR(pushed[0] / (2 * 20e3), 1.0, 1e-10);  // what is left at the right
  EXPECT_NEAR(pushed[1] / (2 * 20e3), -1.0, 1e-10);
}

}  // namespace
