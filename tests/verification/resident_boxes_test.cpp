// SPDX-License-Identifier: GPL-2.0-or-later
// Boxes that stay and go on against cells that are brought to rest at every increment.
#include <gtest/gtest.h>

#include "common/error.hpp"
#include "common/resident_boxes.hpp"
#include "dem/cell/cell_service.hpp"
#include "tests/support/cell_fixture.hpp"
#include "tests/support/sphere_cells.hpp"

namespace polargrain::dem {
namespace {

/// A step of an isochoric compression along e_2 with a turn, as an explicit step of a mesh brings it.
CellIncrement step_of(double strain) {
  CellIncrement increment;
  increment.displacement_gradient(0, 0) = strain;
  increment.displacement_gradient(1, 1) = -strain;
  increment.displacement_gradient(0, 1) = -0.3 * strain;
  increment.displacement_gradient(1, 0) = 0.3 * strain;
  increment.rotation.z() = 0.3 * strain;  // that of the continuum
  return increment;
}

struct Scene {
  const char* name;
  CellDefinition (*definition)();
  CellRotations rotations;
};
void PrintTo(const Scene& scene, std::ostream* stream) {
  *stream << scene.name;
}

class ResidentBoxesTest : public ::testing::TestWithParam<Scene> {
 protected:
  ResidentBoxesTest() {
    definition_ = GetParam().definition();
    definition_.control.rotations = GetParam().rotations;
    definition_.control.tangent = CellTangent::none;
    definition_.control.damping = 0.03;
    service_ = make_cell_service(definition_);
  }
  CellDefinition definition_;
  std::unique_ptr<CellService> service_;
};

// In steps of 1e-5 of 20 DEM steps the drag of the damping and the inertia of the grains leave less than 2 % of the deviator.
TEST_P(ResidentBoxesTest, SlowStepsGiveTheStressOfCellsAtRest) {
  constexpr int kSteps = 100;
  const auto boxes = service_->residents();
  boxes->move_in(std::vector<ResidentStart>(1));
  ResidentAnswer answer;
  for (int step = 0; step < kSteps; ++step)
    answer = boxes->go_on(20, std::vector<CellIncrement>{step_of(1e-5)}).front();
  CellDefinition careful = definition_;
  careful.control.damping = 0.12;
  careful.control.inertial_number = 1e-4;
  const auto cell = make_cell_service(careful);
  StatePointer state;
  CellReply reply;
  for (int part = 0; part < 10; ++part) {
    reply = cell->evaluate({state, step_of(1e-4)});
    state = reply.state;
  }
  const Eigen::Matrix3d& expected = reply.response.stress;
  const double deviator = expected(0, 0) - expected(1, 1);
  EXPECT_LT((answer.stress - expected).topLeftCorner(2, 2).cwiseAbs().maxCoeff(), 0.02 * deviator)
      << answer.stress << "\n\n"
      << expected;
}

// The answer of a box depends on its own way alone, and a read-out changes nothing that a restart would not.
TEST_P(ResidentBoxesTest, AMoveChangesNoBit) {
  const auto here = service_->residents();
  here->move_in(std::vector<ResidentStart>(2));
  const auto go = [](ResidentBoxes& boxes, int steps) {
    std::vector<ResidentAnswer> answers;
    for (int step = 0; step < steps; ++step) {
      std::vector<CellIncrement> increments(boxes.count(), step_of(4e-5));
      if (increments.size() > 1) increments.front() = step_of(-1e-5);
      answers = boxes.go_on(3, increments);
    }
    return answers.back();
  };
  go(*here, 300);
  const ResidentReadOut read = here->read_out(1, 1).front();
  const auto there = service_->residents();
  there->move_in(std::vector<ResidentStart>{{read.reply.state, read.motion}});
  const ResidentAnswer stayed = go(*here, 200);
  const ResidentAnswer moved = go(*there, 200);
  EXPECT_EQ(stayed.stress, moved.stress);
  EXPECT_EQ(stayed.couple_stress, moved.couple_stress);
  EXPECT_EQ(stayed.unbalanced_force_ratio, moved.unbalanced_force_ratio);
  EXPECT_EQ(here->read_out(1, 1).front().reply.state->name(),
            there->read_out(0, 1).front().reply.state->name());
}

// Boxes share the account of their last pass (BoxRecords): one that is read out makes its own again. Its stress is of the end of
// the step, an answer's of the last DEM step, half of which is still to come: they differ by what dashpots carry.
TEST_P(ResidentBoxesTest, AReadOutTellsOfItsOwnBox) {
  const auto boxes = service_->residents();
  boxes->move_in(std::vector<ResidentStart>(2));
  std::vector<ResidentAnswer> answers;
  for (int step = 0; step < 100; ++step)
    answers = boxes->go_on(3, std::vector<CellIncrement>{step_of(-1e-5), step_of(4e-5)});
  const std::vector<ResidentReadOut> read = boxes->read_out(0, 2);
  const double pressure = -answers[0].stress.trace() / 3.0;
  EXPECT_GT((answers[0].stress - answers[1].stress).cwiseAbs().maxCoeff(), 0.5 * pressure);
  for (int box = 0; box < 2; ++box) {
    const Eigen::Matrix3d& stress = read[box].reply.response.stress;
    const int known = read[box].reply.response.known == KnownComponents::all ? 3 : 2;
    EXPECT_LT((stress - answers[box].stress).topLeftCorner(known, known).cwiseAbs().maxCoeff(),
              1e-3 * pressure)
        << stress << "\n\n"
        << answers[box].stress;
    EXPECT_EQ(read[box].reply.diagnostics.coordination_number, answers[box].coordination_number);
  }
}

// A box that is sheared by more than its own length is folded at a read-out, and grains keep their relative velocities.
TEST_P(ResidentBoxesTest, FoldingMovesNoStress) {
  const auto boxes = service_->residents();
  const auto folded = service_->residents();
  boxes->move_in(std::vector<ResidentStart>(1));
  folded->move_in(std::vector<ResidentStart>(1));
  CellIncrement shear;
  shear.displacement_gradient(0, 1) = 2e-4;
  ResidentAnswer plain, read;
  for (int step = 1; step <= 40; ++step) {
    plain = boxes->go_on(5, std::vector<CellIncrement>{shear}).front();
    if (step == 39) folded->read_out(0, 1);
    read = folded->go_on(5, std::vector<CellIncrement>{shear}).front();
  }
  const double pressure = -plain.stress.trace() / 3.0;
  EXPECT_LT((plain.stress - read.stress).cwiseAbs().maxCoeff(), 1e-3 * pressure);
}

CellDefinition discs() {
  return test::demo_cell();
}
CellDefinition spheres_in_space() {
  return test::linear_spheres();
}

INSTANTIATE_TEST_SUITE_P(Grains, ResidentBoxesTest,
                         ::testing::Values(Scene{"discs", discs, CellRotations::free},
                                           Scene{"turned_discs", discs, CellRotations::controlled},
                                           Scene{"spheres", spheres_in_space, CellRotations::free},
                                           Scene{"turned_spheres", spheres_in_space,
                                                 CellRotations::controlled}),
                         [](const auto& scene) { return std::string(scene.param.name); });

// Who asks for the engine's own models gets a message that says what to do.
TEST(ResidentBoxes, RefuseModelsThatOnlyTheEngineSteps) {
  CellDefinition definition = test::demo_cell();
  const std::size_t at = definition.script.find("tangential history");
  ASSERT_NE(at, std::string::npos);
  definition.script.replace(at, std::string("tangential history").size(), "tangential no_history");
  try {
    make_cell_service(definition)->residents();
    FAIL();
  } catch (const RunError& error) {
    EXPECT_NE(std::string(error.what()).find("method: newton"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace polargrain::dem
