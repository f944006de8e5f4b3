// SPDX-License-Identifier: GPL-2.0-or-later
// The time step that the program takes: the largest eigenfrequency against closed forms, and the stable step
// against what the engine bears.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdio>
#include <numbers>

#include "dem/cell/driver.hpp"
#include "dem/cell/time_step.hpp"
#include "dem/engine/liggghts.hpp"
#include "dem/lanes/instruction_set.hpp"
#include "tests/support/cell_fixture.hpp"
#include "tests/support/lattice_fixture.hpp"
#include "tests/support/plane_cells.hpp"

namespace polargrain::dem {
namespace {

Contact contact_of(int first, int second, const Eigen::Vector2d& branch, double kn, double kt,
                   double arm_first, double arm_second) {
  Contact contact;
  contact.first = first;
  contact.second = second;
  contact.branch.head<2>() = branch;
  contact.normal_stiffness = kn;
  contact.tangential_stiffness = kt;
  contact.arm_first = arm_first;
  contact.arm_second = arm_second;
  return contact;
}

Inertia discs(const std::vector<double>& masses, const std::vector<double>& radii) {
  Inertia inertia{masses, {}, radii, false};
  for (std::size_t k = 0; k < masses.size(); ++k)
    inertia.moments.push_back(0.5 * masses[k] * radii[k] * radii[k]);
  return inertia;
}

TEST(TimeStep, TwoGrainsOnOneContact) {
  // Along the contact k_n (1/m + 1/m); across it k_t with what turns: 1/m + r^2 / I of both. Discs and
  // spheres.
  const double kn = 2e6;
  const double kt = 1.6e6;
  for (const double shape : {0.5, 0.4}) {
    Inertia inertia = discs({0.01, 0.03}, {0.004, 0.006});
    inertia.space = shape == 0.4;
    for (double& moment : inertia.moments) moment *= shape / 0.5;
    const Eigen::Vector2d branch = Eigen::Vector2d(3.0, 4.0).normalized() * 0.01;
    const double translation = 1.0 / 0.01 + 1.0 / 0.03;
    const double across = kt * translation * (1.0 + 1.0 / shape);
    for (const double part :
         {1.0, 0.01}) {  // of k_t: once the tangential mode is the fastest, once the normal one
      const std::vector<Contact> contacts{contact_of(0, 1, branch, kn, part * kt, 0.004, 0.006)};
      const double exact = std::sqrt(std::max(kn * translation, part * across));
      EXPECT_NEAR(largest_frequency(contacts, inertia) / exact, 1.0, 1e-9);
      EXPECT_GE(frequency_bound(contacts, inertia), exact * (1.0 - 1e-12));
      EXPECT_LE(frequency_bound(contacts, inertia), exact * (inertia.space ? 2.0 : 1.42));
      EXPECT_NEAR(stable_time_step(exact, 0.0, 0.0), 2.0 / exact, 1e-12 / exact);
    }
  }
}

/// The largest eigenfrequency of a lattice of columns x rows equal discs, from its waves: three motions a
/// disc, so a 3 x 3 Hermitian matrix for each wave that fits into the box.
double lattice_frequency(int columns, int rows, double kn, double kt, double kr, double mass, double arm) {
  const double inertia = 0.5 * mass * std::pow(0.5 * test::kDiameter, 2);
  double largest = 0.0;
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < rows; ++j) {
      Eigen::Matrix3cd dynamic = Eigen::Matrix3cd::Zero();
      for (int neighbour = 0; neighbour < 6; ++neighbour) {
        const double angle = neighbour * std::numbers::pi / 3.0;
        const Eigen::Vector2d n(std::cos(angle), std::sin(angle));
        const Eigen::Vector2d t(-n.y(), n.x());
        // Phase from a disc to its neighbour: columns count by 1, rows by sqrt(3) / 2.
        const double phase =
            2.0 * std::numbers::pi * (i * n.x() / columns + j * n.y() / (std::sqrt(3.0) / 2.0 * rows));
        const std::complex<double> wave(std::cos(phase), std::sin(phase));
        const Eigen::Matrix2d k = kn * n * n.transpose() + kt * t * t.transpose();
        dynamic.topLeftCorner<2, 2>() += (1.0 - wave) * k;
        dynamic.topRightCorner<2, 1>() += (kt * arm * (1.0 + wave)) * t.cast<std::complex<double>>();
        dynamic.bottomLeftCorner<1, 2>() +=
            (kt * arm * (1.0 - wave)) * t.transpose().cast<std::complex<double>>();
        dynamic(2, 2) += kt * arm * arm * (1.0 + wave) + kr * (1.0 - wave);
      }
      const Eigen::Vector3d root(1.0 / std::sqrt(mass), 1.0 / std::sqrt(mass), 1.0 / std::sqrt(inertia));
      const Eigen::Matrix3cd scaled = root.asDiagonal() * dynamic * root.asDiagonal();
      largest = std::max(largest,
                         Eigen::ComplexEigenSolver<Eigen::Matrix3cd>(scaled).eigenvalues().real().maxCoeff());
    }
  return std::sqrt(largest);
}

TEST(TimeStep, WavesOfTheHexagonalLattice) {
  for (const int size : {4, 8}) {
    const CellDefinition cell = test::lattice(size, size, CellRotations::free);
    Driver<2> driver(cell.packing, cell.script, cell.script_file);
    driver.set_up();
    ASSERT_EQ(driver.contacts().size(), 3U * size * size);
    const double arm = driver.contacts().front().arm_first;
    const double mass = cell.packing.grains.front().mass;
    const double exact =
        lattice_frequency(size, size, test::kNormal, test::kTangential, test::kRolling, mass, arm);
    const double found = largest_frequency(driver.contacts(), inertia_of(driver.lammps()));
    std::printf(
        "[figure] lattice of %d x %d: largest frequency %.5f of the exact, bound %.4f; all discs turning "
        "alike %.5f\n",
        size, size, found / exact, frequency_bound(driver.contacts(), inertia_of(driver.lammps())) / exact,
        std::sqrt(24.0 * test::kTangential / mass) / exact);
    EXPECT_NEAR(found / exact, 1.0, 1e-3);
    EXPECT_LE(found, exact * (1.0 + 1e-9));
    EXPECT_GE(frequency_bound(driver.contacts(), inertia_of(driver.lammps())), exact);
    EXPECT_LE(frequency_bound(driver.contacts(), inertia_of(driver.lammps())), 1.42 * exact);
  }
}

/// Largest unbalanced ratio within some thousand steps of `share` of the stable step, from a packing at rest.
double unrest(const CellDefinition& cell, double share, double damping) {
  Driver<2> driver(cell.packing, cell.script, cell.script_file);
  driver.set_up();
  const double rate = driver.damping_rate(damping);
  const double stable = stable_time_step(largest_frequency(driver.contacts(), inertia_of(driver.lammps())),
                                         longest_viscous_time(driver.contacts()), rate);
  set_time_step(driver.lammps(), share * stable);
  driver.strain().begin(BoxPath<2>(driver.strain().box()), rate);
  driver.set_up();
  // A push that no mode escapes, small enough that contacts stay.
  LAMMPS_NS::Atom& atom = *driver.lammps().atom;
  for (int k = 0; k < atom.nlocal; ++k) atom.omega[k][2] = 1e-4 * std::sin(1.0 + 1.7 * k * k);
  driver.run(1);
  const double before = driver.equilibrium().unbalanced_moment_ratio;
  driver.run(3000);
  return driver.equilibrium().unbalanced_moment_ratio / before;
}

TEST(TimeStep, TheStableStepIsWhereTheEngineBlowsUp) {
  CellDefinition lattice = test::lattice(8, 8, CellRotations::free);
  const double below = unrest(lattice, 0.98, 0.0);
  const double above = unrest(lattice, 1.02, 0.0);
  std::printf(
      "[figure] unbalanced moments after 3000 steps of 0.98 and 1.02 of the stable step: %.2e and %.2e of "
      "those at the start\n",
      below, above);
  EXPECT_LT(below, 10.0);
  EXPECT_GT(above, 100.0);
}

TEST(TimeStep, DampingShortensTheStableStepOfThePacking) {
  for (const double damping : {0.0, 0.24, 0.9}) {
    const double below = unrest(test::demo_cell(), 0.97, damping);
    std::printf(
        "[figure] packing400, damping %.2f: unbalanced moments after 3000 steps of 0.97 of the stable step: "
        "%.2e of those at the start\n",
        damping, below);
    EXPECT_LT(below, 10.0) << damping;
  }
}

TEST(TimeStep, OfACellFollowsFromItsContacts) {
  const CellDefinition cell = test::demo_cell();
  Driver<2> driver(cell.packing, cell.script, cell.script_file);
  driver.set_up();
  EXPECT_FALSE(driver.script_sets_time_step());
  EXPECT_EQ(driver.settle_time_step(cell.control.damping), "");
  const double taken = driver.strain().time_step();
  const double frequency = largest_frequency(driver.contacts(), inertia_of(driver.lammps()));
  std::printf("[figure] packing400: 2 / omega %.3e s, time step %.3e s\n", 2.0 / frequency, taken);
  EXPECT_LT(taken, kStepShare * 2.0 / frequency);
  EXPECT_GT(taken, 0.9 * kStepShare * 2.0 / frequency);
}

TEST(TimeStep, ASmallStepOfAScriptIsHonouredWithAWord) {
  CellDefinition cell = test::demo_cell();
  cell.script += "\ntimestep 2e-6\n";
  const PlaneReply reply = make_plane_cell(cell)->initial();
  EXPECT_EQ(reply.response.quality, Quality::good);
  EXPECT_NE(
      reply.response.message.find("times as many DEM steps as are needed: leave the line 'timestep' out"),
      std::string::npos)
      << reply.response.message;
  cell.script += "\ntimestep 1.5e-5\n";
  EXPECT_EQ(make_plane_cell(cell)->initial().response.message,
            "grains are stepped by the loop over discs (hooke/radii, history, off; " +
                std::string(name_of(best_instruction_set())) + ")");
}

}  // namespace
}  // namespace polargrain::dem
