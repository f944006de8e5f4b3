// SPDX-License-Identifier: GPL-2.0-or-later
// Rules for a cell with controlled rotations beyond elasticity (docs/theory/grains.md): limits of the
// skew stress and the couple stress (C.6), virtual work of any motion of the grains (C.2 to C.4), work and
// stored energy, covariance (E.7 f).
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>

#include "dem/cell/linear_contact.hpp"
#include "tests/support/cell_fixture.hpp"
#include "tests/support/plane_cells.hpp"

namespace polargrain::dem {
namespace {

double pressure(const PlaneReply& reply) {
  return -0.5 * (reply.response.stress(k11) + reply.response.stress(k22));
}

double volume(const Packing& packing) {
  return packing.volume();
}

TEST(CellLimits, SkewStressIsTwiceFrictionTimesPressure) {
  // Grains turned against a box at rest: at the limit all contacts slide.
  CellDefinition definition = test::demo_cell();
  definition.control.rotations = CellRotations::controlled;
  // Where every contact slides, grains that ring let go in turns: at a damping of 0.24 and less the ratio is
  // 0.5 to 0.97, with the rate and the time step; at 0.5 it is the same for any.
  definition.control.damping = 0.5;
  const auto cell = make_plane_cell(definition);
  PlaneRequest turn;
  turn.increment.micro_rotation = 2e-3;
  const double mu = std::tan(0.5);
  double ratio = 0.0;
  double difference = 0.0;
  for (int step = 1; step <= 20; ++step) {
    const PlaneReply reply = cell->evaluate(turn);
    ASSERT_EQ(reply.response.quality, Quality::good) << reply.response.message;
    turn.state = reply.state;
    const double skew = reply.response.stress(k21) - reply.response.stress(k12);
    ratio = skew / (2.0 * mu * pressure(reply));
    // Moments are balanced to the tolerance of the cell, so the multiplier is the skew stress (C.4).
    difference = std::max(difference, std::abs(reply.diagnostics.multiplier - skew) / pressure(reply));
  }
  std::printf(
      "[figure] skew stress over 2 mu p at a relative rotation of 0.04: %.3f; multiplier against skew "
      "stress: %.1e of the pressure\n",
      ratio, difference);
  EXPECT_NEAR(ratio, 1.0, 0.03);
  // The mean unbalanced moment is below 5e-3 of force times radius, and those of grains cancel.
  EXPECT_LT(difference, 5e-3);
}

TEST(CellLimits, CoupleStressIsThatOfContactsAtTheirRollingLimit) {
  // A curvature alone: at the limit the moments give m = (4/pi) mu_th r_c p (C.6); r_c = R* is half a radius for equal
  // discs. The rest of the couple stress is the polar part of the tangential forces (C.8).
  constexpr double kFriction = 0.2;
  CellDefinition definition = test::rolling_cell(1.0, kFriction);
  definition.control.rotations = CellRotations::controlled;
  definition.control.loop = CellLoop::engine;
  const auto cell = make_plane_cell(definition);
  PlaneRequest bend;
  bend.increment.curvature << 0.3, 0.0;
  double couple_stress = 0.0;
  double pressure_now = 0.0;
  double rolling = 0.0;
  for (int step = 1; step <= 20; ++step) {
    const PlaneReply reply = cell->evaluate(bend);
    ASSERT_EQ(reply.response.quality, Quality::good) << reply.response.message;
    bend.state = reply.state;
    couple_stress = reply.response.stress(kCurvature1);
    pressure_now = pressure(reply);
    rolling = reply.diagnostics.rolling_fraction;
  }
  // Mean R* over the contacts, weighted as the limit weights it.
  double sum = 0.0;
  double weights = 0.0;
  double of_moments = 0.0;
  double polar_limit = 0.0;
  for (const Contact& contact : cell->contacts()) {
    of_moments += contact.branch.x() * contact.moment.z() / volume(definition.packing);
    polar_limit += std::abs(0.5 * (contact.arm_second - contact.arm_first) * contact.branch.x()) *
                   contact.friction * contact.normal_force() / volume(definition.packing);
    const double weight = contact.branch.norm() * contact.normal_force();
    sum += weight * contact.arm_first * contact.arm_second / (contact.arm_first + contact.arm_second);
    weights += weight;
  }
  const double limit = 4.0 / std::numbers::pi * kFriction * (sum / weights) * pressure_now;
  std::printf(
      "[figure] couple stress of the moments over (4/pi) mu_th r_c p at a curvature of 6 rad/m: %.3f, %.0f "
      "%% of the contacts at the limit; polar part %.3f, %.2f of what sliding contacts could carry\n",
      of_moments / limit, 100.0 * rolling, couple_stress / limit - of_moments / limit,
      (couple_stress - of_moments) / polar_limit);
  EXPECT_NEAR(of_moments / limit, 1.0, 0.1);
  EXPECT_GT(couple_stress, of_moments);
  EXPECT_LT(couple_stress - of_moments, polar_limit);
}

TEST(CellIdentities, VirtualWorkOfAnyMotionIsThatOfTheStress) {
  // Hill-Mandel (C.4): for any strain E and any fluctuation of the grains whose weighted mean rotation
  // vanishes, sum over contacts of force . opening = V S . E, as exactly as the grains are balanced.
  CellDefinition definition = test::rolling_cell(1.0, 0.4);
  definition.control.rotations = CellRotations::controlled;
  definition.control.unbalanced_force_ratio = definition.control.unbalanced_moment_ratio = 1e-6;
  definition.control.damping = 0.5;
  definition.control.loop = CellLoop::engine;
  const auto cell = make_plane_cell(definition);
  PlaneRequest request;
  request.increment.displacement_gradient << 1e-3, 5e-4, 0.0, -2e-3;
  request.increment.micro_rotation = 1e-3;
  request.increment.curvature << 0.02, -0.05;
  const PlaneReply reply = cell->evaluate(request);
  ASSERT_EQ(reply.response.quality, Quality::good) << reply.response.message;
  const std::span<const Contact> contacts = cell->contacts();
  const double box_volume =
      volume(definition.packing) *
      (Eigen::Matrix2d::Identity() + request.increment.displacement_gradient).determinant();

  std::vector<double> capacities(definition.packing.grains.size(), 0.0);
  std::vector<int> count(capacities.size(), 0);
  double sum = 0.0;
  for (const Contact& contact : contacts) {
    capacities[contact.first] += contact.arm_first * contact.normal_force();
    capacities[contact.second] += contact.arm_second * contact.normal_force();
    ++count[contact.first];
    ++count[contact.second];
  }
  for (std::size_t k = 0; k < capacities.size(); ++k)
    sum += capacities[k] = count[k] < 2 ? 0.0 : capacities[k];

  std::mt19937 numbers(1);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<Eigen::Vector3d> motion(capacities.size());
  double mean_rotation = 0.0;
  for (std::size_t k = 0; k < motion.size(); ++k) {
    motion[k] = {1e-2 * uniform(numbers), 1e-2 * uniform(numbers), uniform(numbers)};
    mean_rotation += motion[k].z() * capacities[k] / sum;
  }
  for (Eigen::Vector3d& m : motion) m.z() -= mean_rotation;
  Vector7 strain;
  strain << 0.3, -0.7, 0.0, 0.4, -0.2, 30.0, -50.0;
  double work = 0.0;
  double size = 0.0;
  for (const Contact& contact : contacts) {
    const LinearContact law(contact, Eigen::Matrix2d::Identity());
    Eigen::Matrix<double, 6, 1> both;
    both << motion[contact.first], motion[contact.second];
    const Eigen::Vector3d opening = law.motions * both + law.affine * strain;
    const double done = contact.force.head<2>().dot(opening.head<2>()) + contact.moment.z() * opening.z();
    work += done;
    size += std::abs(done);
  }
  const double of_stress = box_volume * reply.response.stress.dot(strain);
  std::printf(
      "[figure] virtual work of the contacts against that of the stress: %.1e of the sum of magnitudes; skew "
      "stress %.3f of the pressure, couple stress %.2e N/m\n",
      std::abs(work - of_stress) / size,
      (reply.response.stress(k21) - reply.response.stress(k12)) / pressure(reply),
      reply.response.stress.tail<2>().norm());
  EXPECT_LT(std::abs(work - of_stress), 1e-6 * size);
}

TEST(CellIdentities, WorkIsTheStoredEnergyWhenNothingSlips) {
  CellDefinition definition = test::rolling_cell(4.0, 1e3);
  const std::string friction = "0.5463024898437905";
  definition.script.replace(definition.script.find(friction), friction.size(), "1e3");
  definition.control.rotations = CellRotations::controlled;
  definition.control.inertial_number = 2.4e-4;
  definition.control.loop = CellLoop::engine;
  definition.control.unbalanced_force_ratio = definition.control.unbalanced_moment_ratio = 1e-4;
  const auto cell = make_plane_cell(definition);
  const auto energy = [&cell] {
    double sum = 0.0;
    for (const Contact& contact : cell->contacts()) {
      sum += 0.5 * contact.normal_force() * contact.normal_force() / contact.normal_stiffness +
             0.5 * contact.tangential_force() * contact.tangential_force() / contact.tangential_stiffness +
             0.5 * contact.moment.z() * contact.moment.z() / contact.rolling_stiffness;
    }
    return sum;
  };
  PlaneRequest request;
  request.increment.displacement_gradient << -1e-5, 4e-5, 0.0, -3e-5;
  request.increment.micro_rotation = 4e-5;
  request.increment.curvature << 15e-3, -6e-3;
  Vector7 stress = cell->initial().response.stress;
  double start = 0.0;
  double work = 0.0;
  double couple_work = 0.0;
  double now = volume(definition.packing);
  {
    PlaneRequest rest;  // records the contacts of the start
    start = (cell->evaluate(rest), energy());
  }
  for (int step = 0; step < 10; ++step) {
    const PlaneReply reply = cell->evaluate(request);
    ASSERT_EQ(reply.response.quality, Quality::good) << reply.response.message;
    const Vector7 mean = 0.5 * (stress + reply.response.stress);
    const double middle = now * (1.0 + 0.5 * request.increment.displacement_gradient.trace());
    work += middle * mean.dot(request.increment.strain());
    couple_work += middle * mean.tail<2>().dot(request.increment.curvature);
    now *= (Eigen::Matrix2d::Identity() + request.increment.displacement_gradient).determinant();
    stress = reply.response.stress;
    request.state = reply.state;
  }
  const double stored = energy() - start;
  std::printf(
      "[figure] work of the stresses over the energy that the contacts stored: %.4f, couple stresses' share "
      "%.3f\n",
      work / stored, couple_work / work);
  EXPECT_NEAR(work / stored, 1.0, 0.01);
  EXPECT_GT(couple_work / work, 0.05);
}

TEST(CellIdentities, TurningPackingAndPathTurnsTheAnswer) {
  // The grains turned by 90 degrees in a box whose base vectors change places: another grid, another order of
  // the contacts, other signs (E.7 f).
  CellDefinition straight = test::rolling_cell(1.0, 0.4);
  straight.control.rotations = CellRotations::controlled;
  straight.control.unbalanced_force_ratio = straight.control.unbalanced_moment_ratio = 1e-5;
  CellDefinition turned = straight;
  Eigen::Matrix2d quarter;
  quarter << 0.0, -1.0, 1.0, 0.0;
  turned.packing.box.col(0) = -quarter * straight.packing.box.col(1);
  turned.packing.box.col(1) = quarter * straight.packing.box.col(0);
  for (Grain& grain : turned.packing.grains)
    grain.position = quarter * grain.position + turned.packing.box.col(0);
  PlaneRequest request;
  request.increment.displacement_gradient << 2e-4, 1e-4, 0.0, -3e-4;
  request.increment.micro_rotation = 1e-4;
  request.increment.curvature << 0.01, -0.02;
  const PlaneReply one = make_plane_cell(straight)->evaluate(request);
  request.increment.displacement_gradient =
      quarter * request.increment.displacement_gradient * quarter.transpose();
  request.increment.curvature = quarter * request.increment.curvature;
  const PlaneReply other = make_plane_cell(turned)->evaluate(request);
  const auto turn_back = [](const Vector7& s) {
    Vector7 back;
    back << s(k22), s(k11), s(k33), -s(k21), -s(k12), s(kCurvature2), -s(kCurvature1);
    return back;
  };
  const Vector7 difference = turn_back(other.response.stress) - one.response.stress;
  std::printf(
      "[figure] stress of the cell turned by 90 degrees: %.1e of the pressure away, couple stress %.1e of "
      "itself\n",
      difference.head<5>().norm() / pressure(one),
      difference.tail<2>().norm() / one.response.stress.tail<2>().norm());
  EXPECT_LT(difference.head<5>().norm(), 1e-3 * pressure(one));
  EXPECT_LT(difference.tail<2>().norm(), 1e-3 * one.response.stress.tail<2>().norm());
}

}  // namespace
}  // namespace polargrain::dem
