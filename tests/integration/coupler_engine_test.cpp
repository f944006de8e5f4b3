// SPDX-License-Identifier: GPL-2.0-or-later
// The whole program with real grains: LIGGGHTS in its workers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "common/packing.hpp"
#include "coupler/cells/cell_material.hpp"
#include "fem/mesh/rectangle.hpp"
#include "fem/solver/solver.hpp"
#include "tests/integration/command.hpp"

namespace polargrain::testing {
namespace {

const std::filesystem::path kSource = POLARGRAIN_SOURCE_DIRECTORY;
constexpr double kConfining = 100e3;

/// Rolling resistance for the script of the demo.
std::string with_rolling(std::string script) {
  const std::string style = "pair_style      gran model hooke/radii tangential history";
  const std::size_t place = script.find(style);
  EXPECT_NE(place, std::string::npos);
  return script.replace(
      place, style.size(),
      "fix rolling_friction all property/global coefficientRollingFriction peratomtypepair 1 0.4\n"
      "fix rolling_stiffness all property/global rollingStiffnessRatio peratomtypepair 1 4\n" +
          style + " rolling_friction li_chu");
}

/// Two elements between smooth plates, cells of the demo.
std::string case_text(const std::string& script) {
  return "title: Two elements of grains\n"
         "mesh: {rectangle: {size: [0.4 m, 0.8 m], elements: [1, 2]}}\n"
         "materials:\n"
         "  sand: {model: cell, script: " +
         script +
         ", packing: packing400.csv, G: 37 MPa, Gc: 33 MPa, lc: 20 mm}\n"
         "regions: {all: sand}\n"
         "boundary:\n"
         "  - {on: bottom, fix: [u2]}\n"
         "  - {on: bottom_left, fix: [u1]}\n"
         "  - {on: top, move: {u2: -1.6 mm}}\n"
         "  - {on: [left, right], pressure: 100 kPa}\n"
         "steps: {count: 2, tolerance: 5e-3}\n"
         "monitors: {top_force: {on: top, reaction: u2}}\n";
}

class EngineTest : public ::testing::Test {
 protected:
  EngineTest() : scratch_(::testing::UnitTest::GetInstance()->current_test_info()->name()) {
    std::filesystem::copy(kSource / "cases/biaxial/packing400.csv", scratch_.path());
    script_ = content(kSource / "liggghts_inputs/cells/hooke_radii.in");
  }

  [[nodiscard]] Outcome run_with_script(const std::string& script, const std::string& options) const {
    write(scratch_.path() / "cell.in", script);
    write(scratch_.path() / "case.yaml", case_text("cell.in"));
    return run_in(scratch_.path(), POLARGRAIN " run case.yaml " + options);
  }

  Scratch scratch_;
  std::string script_;
};

TEST_F(EngineTest, OneAndTwoWorkersWriteTheSameHistory) {
  const Outcome one = run_with_script(script_, "-o one -w 1");
  ASSERT_EQ(one.status, 0) << one.errors;
  const Outcome two = run_with_script(script_, "-o two -w 2");
  ASSERT_EQ(two.status, 0) << two.errors;
  const std::string history = content(scratch_.path() / "one/history.csv");
  EXPECT_EQ(history, content(scratch_.path() / "two/history.csv"));
  EXPECT_EQ(std::count(history.begin(), history.end(), '\n'), 4);
}

TEST_F(EngineTest, ABrokenScriptEndsTheRunInLiggghtsWords) {
  const Outcome outcome =
      run_with_script(script_ + "\npear_style gran\n", "-o out -w 1 --quiet --trust-scripts");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.errors.find("worker 1 died at work on a cell of material 'sand' (cell.in)"),
            std::string::npos)
      << outcome.errors;
  EXPECT_NE(outcome.errors.find("ERROR: Unknown command: pear_style gran"), std::string::npos)
      << outcome.errors;
  EXPECT_NE(outcome.errors.find("out/logs/worker-1.log"), std::string::npos) << outcome.errors;
  // The user's line, one below the blank one that was appended.
  const auto line = 2 + std::count(script_.begin(), script_.end(), '\n');
  EXPECT_NE(outcome.errors.find("cell.in:" + std::to_string(line) + ": pear_style gran"), std::string::npos)
      << outcome.errors;
  EXPECT_EQ(outcome.out, "");
}

TEST_F(EngineTest, AnUnstableTimeStepIsRefusedWithAStableOne) {
  const Outcome outcome =
      run_with_script(script_ + "\ntimestep 5e-5\n", "-o out -w 2 --quiet --set steps.cut=1");
  std::cout << "[figure] the message: " << outcome.errors;
  // The digits follow the default damping.
  for (const char* part :
       {"ERROR: The time step of cell.in, 5e-05 s, is unstable for these grains and contacts: the "
        "largest stable one is 3.",
        "Leave the line 'timestep' out, and "})
    EXPECT_NE(outcome.errors.find(part), std::string::npos) << outcome.errors;
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.errors.find("out/logs/worker-"), std::string::npos) << outcome.errors;
  EXPECT_NE(content(scratch_.path() / "out/summary.json").find("\"status\": \"failed\""), std::string::npos);
}

TEST_F(EngineTest, AStockRollingModelIsRefusedWhereCurvatureCounts) {
  std::string script = with_rolling(script_);
  const std::string model = "rolling_friction li_chu";
  script.replace(script.find(model), model.size(), "rolling_friction epsd2");
  const std::size_t stiffness = script.find("fix rolling_stiffness");
  script.erase(stiffness, script.find('\n', stiffness) + 1 - stiffness);
  write(scratch_.path() / "cell.in", script);
  std::string text = case_text("cell.in");
  const std::string cosserat = "G: 37 MPa, Gc: 33 MPa, lc: 20 mm";
  text.replace(text.find(cosserat), cosserat.size(), "rotations: controlled");
  write(scratch_.path() / "case.yaml", text);
  const Outcome outcome = run_in(scratch_.path(), POLARGRAIN " run case.yaml -o out -w 1 --quiet");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.errors.find("With controlled rotations the rolling model must be li_chu (or off)"),
            std::string::npos)
      << outcome.errors << script;
}

TEST_F(EngineTest, GrainsThatCarryTheWholeCosseratContinuum) {
  // Between rough plates that hold the rotations, so that curvatures arise; nothing but grains.
  write(scratch_.path() / "cell.in", with_rolling(script_));
  write(scratch_.path() / "case.yaml",
        "title: Two elements of grains that control their rotations\n"
        "mesh: {rectangle: {size: [0.4 m, 0.8 m], elements: [1, 2]}}\n"
        "materials: {sand: {model: cell, script: cell.in, packing: packing400.csv, rotations: controlled}}\n"
        "regions: {all: sand}\n"
        "boundary:\n"
        "  - {on: bottom, fix: [u1, u2, w]}\n"
        "  - {on: top, fix: [w], move: {u1: 0.8 mm, u2: -0.8 mm}}\n"
        "  - {on: [left, right], pressure: 100 kPa}\n"
        "steps: {count: 2, tolerance: 5e-3}\n"
        "monitors: {top_force: {on: top, reaction: u1}, top_moment: {on: top, reaction: w}}\n");
  const Outcome one = run_in(scratch_.path(), POLARGRAIN " run case.yaml -o one -w 1");
  ASSERT_EQ(one.status, 0) << one.errors;
  const Outcome two = run_in(scratch_.path(), POLARGRAIN " run case.yaml -o two -w 2");
  ASSERT_EQ(two.status, 0) << two.errors;
  const std::string history = content(scratch_.path() / "one/history.csv");
  std::cout << "[figure] history:\n" << history;
  EXPECT_EQ(history, content(scratch_.path() / "two/history.csv"));
  ASSERT_EQ(std::count(history.begin(), history.end(), '\n'), 4);
  // A plate that holds the rotations of sheared grains feels a moment.
  EXPECT_GT(std::stod(history.substr(history.rfind(',') + 1)), 0.1);
}

coupler::PoolOptions pool_options(const std::filesystem::path& directory) {
  coupler::PoolOptions options;
  options.workers = 2;
  options.directory = directory;
  options.worker_command = {POLARGRAIN, "worker"};
  return options;
}

/// One element, every displacement and rotation given: a homogeneous displacement gradient, rotations of
/// given curvature that vanish at the origin.
fem::Problem<2> homogeneous(const Eigen::Matrix2d& gradient, std::shared_ptr<fem::Material<2>> material,
                            const Eigen::Vector2d& curvature = Eigen::Vector2d::Zero()) {
  fem::Problem<2> problem;
  problem.mesh = fem::rectangle({{0.4, 0.8}, {1, 1}});
  problem.materials["all"] = std::move(material);
  for (const int i : {0, 1}) {
    const Eigen::Vector2d row = gradient.row(i).transpose();
    problem.prescribed.push_back({"all", fem::node_dofs<2>()[static_cast<std::size_t>(i)],
                                  fem::TimeTable::ramp(1.0),
                                  [row](const Eigen::Vector2d& x) { return row.dot(x); }});
  }
  problem.prescribed.push_back({"all", fem::Dof::w, fem::TimeTable::ramp(1.0),
                                [curvature](const Eigen::Vector2d& x) { return curvature.dot(x); }});
  return problem;
}

TEST_F(EngineTest, AnElementOnAHomogeneousPathAnswersAsItsCellAlone) {
  constexpr int kSteps = 5;
  constexpr coupler::CosseratParameters kCosserat{37e6, 33e6, 0.02};
  coupler::Pool pool(pool_options(scratch_.path()));
  const std::uint32_t sand =
      pool.define({"sand", "hooke_radii.in", script_, read_packing(scratch_.path() / "packing400.csv"), {}});
  Eigen::Matrix2d gradient;  // over the whole path: compression with some shear
  gradient << 1e-3, 4e-4, 4e-4, -5e-3;

  const auto element = std::make_shared<coupler::CellMaterial<2>>(pool, sand, kCosserat);
  fem::SolverOptions options;
  fem::Solver<2> solver(homogeneous(gradient, element), options);
  ASSERT_TRUE(solver.equilibrate().converged);
  coupler::CellMaterial<2> alone(pool, sand, kCosserat);
  alone.allocate(1);
  Increment<2> increment;
  increment.displacement_gradient = gradient / kSteps;
  double largest = 0.0;
  for (int step = 1; step <= kSteps; ++step) {
    const fem::StepReport report = solver.advance(static_cast<double>(step) / kSteps);
    ASSERT_TRUE(report.converged) << report.message;
    Response<2> response;
    alone.evaluate({&increment, 1}, {&response, 1});
    alone.commit();
    for (std::size_t point = 0; point < solver.points(); ++point) {
      const Vector7 difference = solver.state().responses[point].stress - response.stress;
      largest = std::max(largest, difference.head<5>().cwiseAbs().maxCoeff() / kConfining);
    }
  }
  std::cout << "[figure] largest difference of stress over confining stress: " << largest << '\n';
  // The mesh adds the rounding of its displacement gradients, 1e-16, times a stiffness of 1e8 Pa, as
  // far as the grains let it grow in five increments.
  EXPECT_LT(largest, 1e-6);
}

TEST_F(EngineTest, AnElementWithControlledRotationsAnswersAsItsCellsAlone) {
  coupler::Pool pool(pool_options(scratch_.path()));
  CellControl control;
  control.rotations = CellRotations::controlled;
  const std::uint32_t sand = pool.define({"sand", "rolling.in", with_rolling(script_),
                                          read_packing(scratch_.path() / "packing400.csv"), control});
  Eigen::Matrix2d gradient;
  gradient << 1e-3, 4e-4, 4e-4, -2e-3;
  const Eigen::Vector2d curvature(2e-3, -5e-3);  // 1e-4 rad a grain

  const auto element = std::make_shared<coupler::CellMaterial<2>>(pool, sand, std::nullopt);
  fem::Solver<2> solver(homogeneous(gradient, element, curvature), {});
  ASSERT_TRUE(solver.equilibrate().converged);
  const fem::StepReport report = solver.advance(1.0);
  ASSERT_TRUE(report.converged) << report.message;
  coupler::CellMaterial<2> alone(pool, sand, std::nullopt);
  alone.allocate(solver.points());
  std::vector<Increment<2>> increments(solver.points());
  for (std::size_t point = 0; point < solver.points(); ++point) {
    increments[point].displacement_gradient = gradient;
    increments[point].curvature = curvature;
    increments[point].micro_rotation = curvature.dot(solver.position_of_point(point));
  }
  std::vector<Response<2>> responses(solver.points());
  alone.evaluate(increments, responses);
  double largest = 0.0;
  for (std::size_t point = 0; point < solver.points(); ++point) {
    const Vector7 difference = solver.state().responses[point].stress - responses[point].stress;
    largest = std::max(largest, difference.cwiseAbs().maxCoeff() / kConfining);
    EXPECT_GT(responses[point].stress.tail<2>().norm(), 1.0) << "no couple stress, N/m";
    EXPECT_GT(responses[point].tangent(kCurvature1, kCurvature1), 0.0);
  }
  std::cout << "[figure] largest difference of stress over confining stress: " << largest
            << ", couple stress " << responses[0].stress.tail<2>().transpose() << " N/m\n";
  EXPECT_LT(largest, 1e-6);  // rounding of the mesh's gradients, as above
}

}  // namespace
}  // namespace polargrain::testing
