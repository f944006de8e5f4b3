// SPDX-License-Identifier: GPL-2.0-or-later
// A cell of spheres is a value, it does not care how its box is described, and a rotation turns its stress.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdio>
#include <cstring>

#include "common/error.hpp"
#include "dem/cell/cell_service.hpp"
#include "dem/cell/state_fault.hpp"
#include "tests/support/sphere_cells.hpp"

namespace polargrain::dem {
namespace {

CellRequest request(StatePointer state, const Eigen::Matrix3d& gradient) {
  CellRequest made;
  made.state = std::move(state);
  made.increment.displacement_gradient = gradient;
  return made;
}

/// A strain with all nine components.
Eigen::Matrix3d some_strain() {
  Eigen::Matrix3d h;
  h << 3e-4, 1e-4, -2e-4, 5e-5, -4e-4, 1e-4, 1.5e-4, -1e-4, 2e-4;
  return h;
}

/// Coarse and quick: these tests compare runs that must agree, not runs with the truth.
CellDefinition quick_spheres() {
  CellDefinition definition = test::hertz_spheres();
  definition.control.inertial_number = 2e-3;
  definition.control.tangent = CellTangent::none;
  return definition;
}

bool same_bits_of_sphere_cell(const CellReply& a, const CellReply& b) {
  return std::memcmp(a.response.stress.data(), b.response.stress.data(), sizeof(Eigen::Matrix3d)) == 0 &&
         std::memcmp(a.response.tangent.data(), b.response.tangent.data(), sizeof(Matrix18)) == 0 &&
         std::ranges::equal(a.state->bytes(), b.state->bytes());
}

TEST(SphereCell, SameRequestGivesTheSameBitsWhateverCameBetween) {
  CellDefinition definition = quick_spheres();
  definition.control.tangent = CellTangent::condensed;
  const auto cell = make_cell_service(definition);
  const CellReply once = cell->evaluate(request(nullptr, some_strain()));
  cell->evaluate(request(once.state, -some_strain().transpose()));
  EXPECT_TRUE(same_bits_of_sphere_cell(once, cell->evaluate(request(nullptr, some_strain()))));

  // Another engine, and a state that went through bytes.
  const auto other = make_cell_service(definition);
  const auto copy = std::make_shared<const State>(
      std::vector<std::byte>(once.state->bytes().begin(), once.state->bytes().end()));
  EXPECT_EQ(state_fault(definition, *copy), "");
  const CellReply here = cell->evaluate(request(once.state, some_strain()));
  EXPECT_TRUE(same_bits_of_sphere_cell(here, other->evaluate(request(copy, some_strain()))));
  EXPECT_FALSE(same_bits_of_sphere_cell(here, once));
  std::printf("[figure] state of 500 spheres: %.0f bytes a sphere\n",
              static_cast<double>(once.state->bytes().size()) / 500.0);
}

TEST(SphereCell, ContactsThatStiffenGetAShorterTimeStep) {
  CellDefinition definition = quick_spheres();
  const auto cell = make_cell_service(definition);
  const CellReply small = cell->evaluate(request(nullptr, some_strain()));
  // The same with a time step that is short enough from the start.
  definition.script += "timestep 5e-6\n";
  const auto slow = make_cell_service(definition);
  CellReply reply = cell->initial();
  CellReply reference = slow->initial();
  const double at_rest = -reply.response.stress.trace() / 3.0;
  for (int step = 0; step < 5; ++step) {
    const Eigen::Matrix3d press = -3e-3 * Eigen::Matrix3d::Identity();
    reply = cell->evaluate(request(reply.state, press));
    ASSERT_EQ(reply.response.quality, Quality::good) << reply.response.message;
    reference = slow->evaluate(request(reference.state, press));
    ASSERT_EQ(reference.response.quality, Quality::good) << reference.response.message;
  }
  const double risen = -reply.response.stress.trace() / 3.0 / at_rest;
  const double error =
      (reply.response.stress - reference.response.stress).norm() / reference.response.stress.norm();
  std::printf(
      "[figure] pressure %.1f times as high: stress differs by %.1e from that with a short time step\n",
      risen, error);
  EXPECT_GT(risen, 10.0);  // the frequencies by 1.5, beyond the room of a quarter that the step has
  EXPECT_LT(
      error,
      3e-3);  // pressed evenly, grains are led affinely and slide little: steps of either length suffice
  EXPECT_GT(reference.diagnostics.dem_steps, 1.5 * reply.diagnostics.dem_steps);
  // Other answers know nothing of it.
  EXPECT_TRUE(same_bits_of_sphere_cell(small, cell->evaluate(request(nullptr, some_strain()))));
}

TEST(SphereCell, ARotationOnTopOfAStrainTurnsTheStress) {
  const auto cell = make_cell_service(quick_spheres());
  const CellReply strained = cell->evaluate(request(nullptr, some_strain()));
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.25, Eigen::Vector3d(1.0, 2.0, 3.0).normalized()).toRotationMatrix();
  const Eigen::Matrix3d one = Eigen::Matrix3d::Identity();
  const CellReply turned = cell->evaluate(request(nullptr, turn * (one + some_strain()) - one));
  const Eigen::Matrix3d expected = turn * strained.response.stress * turn.transpose();
  const double error = (turned.response.stress - expected).norm() / expected.norm();
  std::printf("[figure] strain with a rotation of 0.25 rad on top: stress differs by %.1e of its norm\n",
              error);
  // Box and grains take the same steps in the frame of the box; what is left is the growth of round-off.
  EXPECT_LT(error, 1e-9);
  EXPECT_EQ(turned.diagnostics.dem_steps, strained.diagnostics.dem_steps);
  // And on from there, in the turned frame.
  const CellReply further = cell->evaluate(request(strained.state, some_strain()));
  const CellReply further_turned =
      cell->evaluate(request(turned.state, turn * some_strain() * turn.transpose()));
  const Eigen::Matrix3d second = turn * further.response.stress * turn.transpose();
  EXPECT_LT((further_turned.response.stress - second).norm() / second.norm(), 1e-9);
}

/// With springs that turn with the contact; stock `history` leaves them where they were when the pair turns about its
/// normal, and the frame of the box counts as such a turn.
CellDefinition with_turning_springs(CellDefinition definition) {
  const std::string stock = "tangential history";
  definition.script.replace(definition.script.find(stock), stock.size(), "tangential li_chu");
  return definition;
}

TEST(SphereCell, APureSpinTurnsTheStress) {
  CellDefinition definition = with_turning_springs(quick_spheres());
  definition.control.unbalanced_force_ratio = definition.control.unbalanced_moment_ratio = 1e-3;
  const auto cell = make_cell_service(definition);
  CellReply reply = cell->evaluate(request(nullptr, some_strain()));
  const Eigen::Matrix3d before = reply.response.stress;
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.2, Eigen::Vector3d(3.0, -1.0, 2.0).normalized()).toRotationMatrix();
  Eigen::Matrix3d whole = Eigen::Matrix3d::Identity();
  for (int step = 0; step < 4; ++step) {
    reply = cell->evaluate(request(reply.state, turn - Eigen::Matrix3d::Identity()));
    whole = turn * whole;
  }
  const Eigen::Matrix3d expected = whole * before * whole.transpose();
  const double error = (reply.response.stress - expected).norm() / before.norm();
  std::printf("[figure] a spin of 0.8 rad: stress differs by %.1e of its norm\n", error);
  EXPECT_LT(error, 2e-3);  // the box does nothing but turn; what was left unbalanced creeps on
}

TEST(SphereCell, OtherBaseVectorsOfTheSameLatticeGiveTheSameStress) {
  // (a, b, c) as (b, -a, c + a): turned by a right angle in the engine, with another tilt, in a frame that turns in
  // another way while the box is strained. Inertia does not feel the turning of its frame, hence a difference that goes
  // with the rate of loading.
  const auto difference = [](double inertial_number) {
    CellDefinition definition = with_turning_springs(quick_spheres());
    definition.control.inertial_number = inertial_number;
    const CellReply reply = make_cell_service(definition)->evaluate(request(nullptr, some_strain()));
    const Eigen::Matrix2d box = definition.packing.box;
    definition.packing.box << box.col(1), -box.col(0);
    definition.packing.lean += box.col(0);
    const CellReply other = make_cell_service(definition)->evaluate(request(nullptr, some_strain()));
    return (other.response.stress - reply.response.stress).norm() / reply.response.stress.norm();
  };
  const double fast = difference(2e-3);
  const double slow = difference(2e-4);
  std::printf(
      "[figure] another description of the lattice: stress differs by %.1e of its norm, ten times slower %.1e\n",
      fast, slow);
  EXPECT_LT(fast, 1e-5);
  EXPECT_LT(slow, 0.2 * fast);
}

TEST(SphereCell, ALargeShearPassesTheReductionsOfTheBox) {
  CellDefinition definition = test::linear_spheres();
  definition.control.inertial_number = 1e-2;
  definition.control.tangent = CellTangent::none;
  const auto cell = make_cell_service(definition);
  StatePointer state;
  Eigen::Matrix3d shear = Eigen::Matrix3d::Zero();
  shear(0, 2) = shear(1, 2) = 0.16;
  shear(2, 2) = 0.03;  // room to dilate
  // To 0.64: tilts are taken back beyond a half.
  for (int step = 1; step <= 4; ++step) {
    const CellReply reply = cell->evaluate(request(state, shear));
    ASSERT_EQ(reply.response.quality, Quality::good) << step << ": " << reply.response.message;
    const Eigen::Matrix3d& stress = reply.response.stress;
    const double ratio = std::hypot(stress(2, 0), stress(2, 1)) / -stress(2, 2);
    // Sand in shear: friction angles of 10 to 40 degrees, on both sides of a new description of the box.
    EXPECT_GT(ratio, 0.17) << step;
    EXPECT_LT(ratio, 0.84) << step;
    EXPECT_EQ(state_fault(definition, *reply.state), "") << step;
    state = reply.state;
  }
}

TEST(SphereCell, RefusesWhatItCannotFollow) {
  CellDefinition definition = quick_spheres();
  const auto cell = make_cell_service(definition);
  const auto garbage = std::make_shared<const State>(std::vector<std::byte>(1000, std::byte{7}));
  EXPECT_THROW(cell->evaluate(request(garbage, Eigen::Matrix3d::Zero())), RunError);
  const CellReply folded = cell->evaluate(request(nullptr, -2.0 * Eigen::Matrix3d::Identity()));
  EXPECT_EQ(folded.response.quality, Quality::failed);
  // A state of discs.
  const CellReply discs = make_cell_service(test::demo_cell())->initial();
  EXPECT_THROW(cell->evaluate(request(discs.state, Eigen::Matrix3d::Zero())), RunError);
  EXPECT_NE(state_fault(definition, *discs.state), "");
}

}  // namespace
}  // namespace polargrain::dem
