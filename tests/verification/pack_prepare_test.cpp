// SPDX-License-Identifier: GPL-2.0-or-later
// Packings made by the engine: at rest under the pressure asked for, isostatic without friction, the void
// ratio asked for or a clear word, and of use as cells.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <optional>

#include "common/error.hpp"
#include "dem/pack/prepare.hpp"
#include "tests/support/packings_to_make.hpp"

namespace polargrain::dem {
namespace {

void expect_at_rest(const PackingSpecification& asked, const PackingReached& reached) {
  EXPECT_NEAR(reached.pressure / asked.pressure, 1.0, asked.pressure_tolerance);
  EXPECT_LE(reached.anisotropy, asked.pressure_tolerance);
  EXPECT_LE(reached.unbalanced_force_ratio, asked.unbalanced_force_ratio);
  EXPECT_LE(reached.unbalanced_moment_ratio, asked.unbalanced_force_ratio);
}

/// Contacts a grain, of those that carry.
double coordination(const PackingReached& reached) {
  return reached.coordination_number / (1.0 - reached.rattlers);
}

TEST(PackPrepare, FrictionlessDiscsAreIsotropicAndNearlyIsostatic) {
  const PackingSpecification asked = specification(100, 0.0);
  const PackingReached reached = prepare_packing(asked, {}).reached;
  expect_at_rest(asked, reached);
  EXPECT_LE(std::abs(reached.shear), asked.pressure_tolerance);
  std::printf("[figure] discs: void ratio %.4f, contacts a carrying grain %.3f\n", reached.void_ratio,
              coordination(reached));
  // Isostatic discs have 4 less what the box itself takes up (some contacts in all); the pressure of 2e-4 of
  // the stiffness adds a few tenths.
  EXPECT_GT(coordination(reached), 3.9);
  EXPECT_LT(coordination(reached), 4.5);
}

TEST(PackPrepare, FrictionlessSpheresAreNearlyIsostatic) {
  const PackingSpecification asked = in_space(100, 0.0);
  const PreparedPacking made = prepare_packing(asked, {});
  expect_at_rest(asked, made.reached);
  std::printf("[figure] spheres: void ratio %.4f, contacts a carrying grain %.3f\n", made.reached.void_ratio,
              coordination(made.reached));
  // Isostatic: 6. Random close packing of spheres fills 0.64 of the space, somewhat more with mixed sizes.
  EXPECT_GT(coordination(made.reached), 5.8);
  EXPECT_LT(coordination(made.reached), 6.6);
  EXPECT_NEAR(1.0 / (1.0 + made.reached.void_ratio), 0.645, 0.015);
  EXPECT_EQ(made.packing.dimension, 3);
  for (const Grain& grain : made.packing.grains) {
    EXPECT_GE(grain.height, 0.0);
    EXPECT_LT(grain.height, made.packing.thickness);
  }
}

/// Mean stress of frictionless spheres from their places alone: every pair of grains and images that overlap,
/// with the contact law of the script, Pa.
Eigen::Matrix3d stress_of_places(const Packing& packing) {
  constexpr double kModulus = 6e8;  // contactModulus of spheres_hooke_radii.in
  Eigen::Matrix3d box = Eigen::Matrix3d::Zero();
  box.topLeftCorner<2, 2>() = packing.box;
  box.col(2) << packing.lean, packing.thickness;
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  const auto place = [](const Grain& grain) {
    return Eigen::Vector3d(grain.position.x(), grain.position.y(), grain.height);
  };
  for (const Grain& one : packing.grains)
    for (const Grain& other : packing.grains)
      for (int image = 0; image < 27; ++image) {
        const Eigen::Vector3d shift = box * Eigen::Vector3d(image % 3 - 1, image / 3 % 3 - 1, image / 9 - 1);
        const Eigen::Vector3d branch = place(other) + shift - place(one);
        const double overlap = one.radius + other.radius - branch.norm();
        if (!(overlap > 0.0) || branch.norm() == 0.0) continue;
        const double stiffness = kModulus * 2.0 * one.radius * other.radius / (one.radius + other.radius);
        sum -= 0.5 * stiffness * overlap / branch.norm() * branch * branch.transpose();  // each pair twice
      }
  return sum / (packing.box.determinant() * packing.thickness);
}

TEST(PackPrepare, SpheresEndWithoutShear) {
  PackingSpecification asked = in_space(60, 0.0);
  asked.unbalanced_force_ratio = 1e-4;
  const PreparedPacking made = prepare_packing(asked, {});
  expect_at_rest(asked, made.reached);
  EXPECT_LE(std::abs(made.reached.shear), asked.pressure_tolerance);
  const Packing& packing = made.packing;
  const Eigen::Matrix3d stress = stress_of_places(packing) / -asked.pressure;
  std::cout << "[figure] sixty spheres: stress over pressure, from their places\n"
            << stress << "\n[figure] tilts over lengths: " << packing.box(0, 1) / packing.box(0, 0) << " "
            << packing.lean.x() / packing.box(0, 0) << " " << packing.lean.y() / packing.box(1, 1) << "\n";
  // Forces of the last motion, up to the unbalanced ratio, are not in the places.
  EXPECT_LE((stress - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(),
            asked.pressure_tolerance + asked.unbalanced_force_ratio);
  // It took a tilt about each axis to get there: a right box of so few spheres keeps a shear of some per
  // cent.
  EXPECT_GT(std::abs(packing.box(0, 1)) / packing.box(0, 0), 1e-4);
  EXPECT_GT(packing.lean.cwiseAbs().minCoeff() / packing.box(0, 0), 1e-4);

  // With friction it ends alike, and the tilted box with its state is where the next one goes on from.
  PackingSpecification rough = in_space(60, 0.4);
  const PreparedPacking stuck = prepare_packing(rough, {});
  EXPECT_LE(std::abs(stuck.reached.shear), rough.pressure_tolerance);
  rough.most_steps = 200;
  const PackingReached again = settle_packing(rough, stuck, {}).reached;
  EXPECT_LE(std::abs(again.shear), rough.pressure_tolerance);
  EXPECT_NEAR(again.void_ratio, stuck.reached.void_ratio, 1e-5);
}

/// The stresses of a cell that starts from a packing: compressive stresses of the axes, Pa.
Eigen::Vector3d pressures(const PackingSpecification& asked, const PreparedPacking& made) {
  return -stress_in_a_cell(asked, made).diagonal();
}

TEST(PackPrepare, EachAxisCarriesTheStressAskedOfIt) {
  PackingSpecification asked = in_space(100, 0.5);
  asked.damping = kDampingInSpace;
  asked.share_of_axis = {0.8, 0.9, 1.3};
  const PreparedPacking made = prepare_packing(asked, {});
  const Eigen::Vector3d carried = pressures(asked, made);
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(carried(axis) / asked.pressure, asked.share_of_axis[static_cast<std::size_t>(axis)],
                1.5 * asked.pressure_tolerance)
        << axis;
  EXPECT_NEAR(made.packing.pressure / asked.pressure, 1.0, asked.pressure_tolerance);
}

TEST(PackPrepare, OneDimensionalCompressionKeepsTheWidth) {
  PackingSpecification asked = in_space(80, 0.5);
  asked.damping = kDampingInSpace;
  asked.one_dimensional_from = 2e4;
  const PreparedPacking made = prepare_packing(asked, {});
  const Eigen::Vector3d carried = pressures(asked, made);
  EXPECT_NEAR(carried.z() / asked.pressure, 1.0, 1.5 * asked.pressure_tolerance);
  const double at_rest = 0.5 * (carried.x() + carried.y()) / carried.z();
  std::printf("[figure] 80 spheres, friction 0.5, compressed in one dimension from 20 to 100 kPa: K0 %.3f\n",
              at_rest);
  // The lateral stresses stay behind, by little as long as so few and stiff spheres are hardly strained.
  EXPECT_GT(at_rest, 0.3);
  EXPECT_LT(at_rest, 0.97);
  // Before it, the packing is that of the isotropic pressure; from there it got lower and no narrower.
  PackingSpecification before = asked;
  before.one_dimensional_from = {};
  before.pressure = 2e4;
  const Packing start = prepare_packing(before, {}).packing;
  EXPECT_EQ(made.packing.box(0, 0), start.box(0, 0));
  EXPECT_EQ(made.packing.box(1, 1), start.box(1, 1));
  EXPECT_LT(made.packing.thickness, start.thickness);
}

TEST(PackPrepare, RollingFrictionWhileMadeWidensTheRange) {
  const double rough = prepare_packing(rolling_spheres(60, 0.5, 0.0), {}).reached.void_ratio;
  PackingSpecification asked = rolling_spheres(60, 0.5, 0.5);
  const double loose = prepare_packing(asked, {}).reached.void_ratio;
  std::printf(
      "[figure] 60 spheres, friction 0.5: void ratio %.3f, %.3f with as much rolling friction while they are made\n",
      rough, loose);
  EXPECT_GT(loose, rough + 0.05);
  // And what lies in between is found.
  asked.void_ratio = 0.5 * (rough + loose);
  asked.void_ratio_tolerance = 2e-2;
  const PackingReached found = prepare_packing(asked, {}).reached;
  EXPECT_NEAR(found.void_ratio, *asked.void_ratio, asked.void_ratio_tolerance);
  EXPECT_LE(found.anisotropy, asked.pressure_tolerance);
}

TEST(PackPrepare, SettlingKeepsTheTangentialSprings) {
  PackingSpecification asked = specification(100, 0.4);
  PreparedPacking made = prepare_packing(asked, {});
  ASSERT_TRUE(made.packing.state);
  const PackingReached kept = settle_packing(asked, made, {}).reached;
  made.packing.state = nullptr;
  const PackingReached anew = settle_packing(asked, made, {}).reached;
  std::printf("[figure] settled again: %g DEM steps, %g when springs start anew\n", kept.dem_steps,
              anew.dem_steps);
  EXPECT_LE(kept.dem_steps, 60.0);  // it is at rest as it is: a look or two
  EXPECT_GT(anew.dem_steps, 5.0 * kept.dem_steps);
  EXPECT_NEAR(kept.void_ratio, made.reached.void_ratio, 1e-5);
}

TEST(PackPrepare, SaysHowFarFromIsotropicItWas) {
  for (PackingSpecification asked : {specification(60, 0.0), in_space(40, 0.0)}) {
    asked.most_steps = 2000;
    try {
      prepare_packing(asked, {});
      FAIL() << "no packing is at rest so soon";
    } catch (const RunError& error) {
      EXPECT_NE(
          std::string(error.what()).find("did not come to rest under its stresses within 2000 DEM steps"),
          std::string::npos)
          << error.what();
      EXPECT_NE(std::string(error.what()).find("(asked 100), anisotropy "), std::string::npos)
          << error.what();
      EXPECT_NE(std::string(error.what()).find("(each within 1.0e-03)"), std::string::npos) << error.what();
    }
  }
}

TEST(PackPrepare, TheSameSpecificationGivesTheSameBits) {
  for (const PackingSpecification& asked : {specification(60, 0.3), in_space(40, 0.3)}) {
    const PreparedPacking once = prepare_packing(asked, {});
    const PreparedPacking again = prepare_packing(asked, {});
    EXPECT_EQ(once.packing.box, again.packing.box);
    for (std::size_t k = 0; k < once.packing.grains.size(); ++k) {
      EXPECT_EQ(once.packing.grains[k].position, again.packing.grains[k].position);
      EXPECT_EQ(once.packing.grains[k].height, again.packing.grains[k].height);
    }
    ASSERT_TRUE(once.packing.state && again.packing.state);
    EXPECT_EQ(once.packing.state->name(), again.packing.state->name());
  }
}

TEST(PackPrepare, FindsAVoidRatioBetweenTheDensestAndTheLoosest) {
  PackingSpecification asked = specification(100, 0.5);
  asked.unbalanced_force_ratio = 5e-3;
  asked.void_ratio = 0.22;
  asked.void_ratio_tolerance = 5e-3;  // packings of so few grains jump
  const PackingReached reached = prepare_packing(asked, {}).reached;
  expect_at_rest(asked, reached);
  EXPECT_NEAR(reached.void_ratio, 0.22, asked.void_ratio_tolerance);
  EXPECT_GT(reached.friction, 0.0);
}

TEST(PackPrepare, SaysWhatCanBeReached) {
  PackingSpecification asked = specification(100, 0.3);
  asked.unbalanced_force_ratio = 5e-3;
  asked.void_ratio = 0.5;
  try {
    prepare_packing(asked, {});
    FAIL() << "a void ratio of 0.5 cannot be had";
  } catch (const RunError& error) {
    EXPECT_NE(std::string(error.what()).find("out of reach: friction from 0 to 0.3 gives 0.1"),
              std::string::npos)
        << error.what();
  }
}

TEST(PackPrepare, APackingIsACellUnderItsPressure) {
  for (const double friction : {0.0, 0.4}) {
    const PackingSpecification asked = specification(100, friction);
    CellDefinition cell = test::demo_cell();
    cell.packing = prepare_packing(asked, {}).packing;
    EXPECT_EQ(cell.packing.state != nullptr, friction > 0.0);
    const Vector7 stress = make_plane_cell(cell)->initial().response.stress;
    // The state travels to the bit, positions with the digits of the data file.
    EXPECT_NEAR(stress(k11) / -1e5, 1.0, 1.5 * asked.pressure_tolerance) << friction;
    EXPECT_NEAR(stress(k22) / -1e5, 1.0, 1.5 * asked.pressure_tolerance) << friction;
    EXPECT_NEAR(0.5 * (stress(k12) + stress(k21)) / -1e5, 0.0, 1.5 * asked.pressure_tolerance) << friction;
  }
}

TEST(PackPrepare, SpheresInASingleLayerHaveTheMassOfSpheres) {
  PackingSpecification asked = specification(60, 0.0);
  asked.spheres = true;
  asked.unbalanced_force_ratio = 5e-3;
  const PreparedPacking made = prepare_packing(asked, {});
  expect_at_rest(asked, made.reached);
  for (const Grain& grain : made.packing.grains)
    EXPECT_NEAR(grain.mass / (2650.0 * 4.0 / 3.0 * M_PI * std::pow(grain.radius, 3)), 1.0, 1e-14);
}

}  // namespace
}  // namespace polargrain::dem
