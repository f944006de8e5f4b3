// SPDX-License-Identifier: GPL-2.0-or-later
// Packings of spheres are made by the loop over spheres. LIGGGHTS's own loop is the reference.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>
#include <vector>

#include "common/stepping_note.hpp"
#include "dem/pack/placement.hpp"
#include "dem/pack/prepare.hpp"
#include "dem/pack/pressed_box.hpp"
#include "tests/support/packings_to_make.hpp"

namespace polargrain::dem {
namespace {

/// A box whose packing is strained and sheared, damped, and held.
struct Moved {
  PressedBox::Look look;
  Packing packing;
};
Moved moved(PackingSpecification asked, const Packing& start, CellLoop loop) {
  asked.loop = loop;
  const auto box = make_pressed_box(asked, start, std::nullopt);
  box->renew_time_step(0.0);
  constexpr int kSteps = 150;
  constexpr double kRate = 500.0;
  box->move({-4e-4, 2e-4, -3e-4}, {2e-4, -1e-4, 1e-4}, kSteps, kRate);
  box->move({1e-4, -2e-4, 1e-4}, {-1e-4, 2e-4, 0.0}, kSteps, kRate);
  box->move(Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), kSteps, kRate);
  return {box->look(), box->packing(true)};
}

void expect_the_same(const Moved& fast, const Moved& engine, double pressure) {
  // Both add the same numbers in another order, over 450 steps; sphere_loop_test takes 1e-10 over 1,000.
  constexpr double kRounding = 1e-9;
  EXPECT_EQ(fast.look.contacts, engine.look.contacts);
  EXPECT_LE((fast.look.stress - engine.look.stress).cwiseAbs().maxCoeff(), kRounding * pressure);
  EXPECT_LE((fast.look.shear - engine.look.shear).cwiseAbs().maxCoeff(), kRounding * pressure);
  EXPECT_NEAR(fast.look.unbalanced_force_ratio, engine.look.unbalanced_force_ratio, kRounding);
  EXPECT_NEAR(fast.look.unbalanced_moment_ratio, engine.look.unbalanced_moment_ratio, kRounding);
  EXPECT_LE((fast.look.stiffness - engine.look.stiffness).norm(), kRounding * engine.look.stiffness.norm());
  double farthest = 0.0;
  for (std::size_t k = 0; k < fast.packing.grains.size(); ++k) {
    const Grain& one = fast.packing.grains[k];
    const Grain& other = engine.packing.grains[k];
    farthest =
        std::max({farthest, (one.position - other.position).norm(), std::abs(one.height - other.height)});
  }
  EXPECT_LE(farthest, 1e-12);  // m; spheres of 3 to 7 mm
}

TEST(PackLoop, StepsAreThoseOfLiggghtsUpToRounding) {
  for (const bool rolls : {false, true}) {
    const PackingSpecification asked = rolls ? rolling_spheres(80, 0.4) : in_space(80, 0.4);
    const Packing start = prepare_packing(asked, {}).packing;
    ASSERT_TRUE(start.state);
    const Moved engine = moved(asked, start, CellLoop::engine);
    EXPECT_GT(engine.look.contacts, 100);
    for (const CellLoop loop : {CellLoop::automatic, CellLoop::plain}) {
      const Moved fast = moved(asked, start, loop);
      std::printf("[figure] stress of the two loops apart by %.1e of the pressure\n",
                  (fast.look.stress - engine.look.stress).cwiseAbs().maxCoeff() / asked.pressure);
      expect_the_same(fast, engine, asked.pressure);
    }
    // The springs of the contacts go along: settled under the friction that it was made with, it takes a look or two.
    if (rolls) continue;
    PackingSpecification again = asked;
    PreparedPacking made;
    made.packing = start;
    for (const CellLoop loop : {CellLoop::automatic, CellLoop::engine}) {
      again.loop = loop;
      EXPECT_LE(settle_packing(again, made, {}).reached.dem_steps, 60.0);
    }
  }
}

TEST(PackLoop, GrainsFallAsInLiggghts) {
  PackingSpecification asked = in_space(60, 0.4);
  asked.deposition.emplace();
  const Packing rain = place_rain(asked);
  std::vector<Packing> beds;
  std::vector<double> unrest;
  for (const CellLoop loop : {CellLoop::engine, CellLoop::automatic}) {
    asked.loop = loop;
    const auto box = make_pressed_box(asked, rain, MakingFriction{0.4, {}}, Fall::yes);
    box->renew_time_step(0.0);
    // Until the lowest grains have bounced on the floor and on each other. Without the local damping: it turns by the sign
    // of a speed, also where that is nothing but rounding.
    const double time = 3000.0 * box->time_step();
    box->begin_fall(0.06 / (time * time), 1e4, 0.0);
    box->move(Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), 3000, 0.0);
    EXPECT_GT(box->look().contacts, 0);
    unrest.push_back(box->unrest());
    beds.push_back(box->packing(false));
  }
  double farthest = 0.0, fallen = 0.0;
  for (std::size_t k = 0; k < rain.grains.size(); ++k) {
    farthest = std::max(farthest, (beds[0].grains[k].position - beds[1].grains[k].position).norm());
    fallen = std::max(fallen, rain.grains[k].position.y() - beds[1].grains[k].position.y());
  }
  std::printf("[figure] grains that fell by %.3g m: places apart by %.1e m\n", fallen, farthest);
  EXPECT_GT(fallen, 0.005);
  EXPECT_LE(farthest, 1e-10);  // rounding, enlarged by collisions
  EXPECT_NEAR(unrest[0], unrest[1], 1e-6);
}

/// Void ratio and contacts a grain of packings with these seeds.
struct Made {
  std::vector<double> void_ratios, contacts;
};
Made made_by(CellLoop loop, double friction, int count) {
  Made made;
  for (int seed = 1; seed <= count; ++seed) {
    PackingSpecification asked = in_space(40, friction);
    asked.damping = kDampingInSpace;
    asked.loop = loop;
    asked.seed = static_cast<std::uint64_t>(seed);
    const PackingReached reached = prepare_packing(asked, {}).reached;
    made.void_ratios.push_back(reached.void_ratio);
    made.contacts.push_back(reached.coordination_number);
  }
  return made;
}

/// The mean difference of pairs, and half its interval of 95 %.
std::pair<double, double> difference(const std::vector<double>& one, const std::vector<double>& other) {
  const auto n = static_cast<double>(one.size());
  double mean = 0.0, square = 0.0;
  for (std::size_t k = 0; k < one.size(); ++k) mean += (one[k] - other[k]) / n;
  for (std::size_t k = 0; k < one.size(); ++k) square += std::pow(one[k] - other[k] - mean, 2) / (n - 1.0);
  constexpr double kStudent = 2.57;  // of 5 degrees of freedom
  return {mean, kStudent * std::sqrt(square / n)};
}

TEST(PackLoop, PackingsFromALooseStartAreStatisticallyThose) {
  // Rounding grows until two packings are two draws, so only means can agree.
  constexpr int kPackings = 6;
  for (const double friction : {0.0, 0.5}) {
    const Made fast = made_by(CellLoop::automatic, friction, kPackings);
    const Made engine = made_by(CellLoop::engine, friction, kPackings);
    const auto [voids, within] = difference(fast.void_ratios, engine.void_ratios);
    const auto [contacts, contacts_within] = difference(fast.contacts, engine.contacts);
    std::printf(
        "[figure] friction %g, %d packings: void ratio apart by %.4f +- %.4f, contacts a grain by %.3f +- %.3f\n",
        friction, kPackings, voids, within, contacts, contacts_within);
    // Twice the interval of 95 %: one in a thousand.
    EXPECT_LE(std::abs(voids), 2.0 * within);
    EXPECT_LE(std::abs(contacts), 2.0 * contacts_within);
  }
}

TEST(PackLoop, SaysWhichLoopStepsTheGrains) {
  PackingSpecification asked = in_space(40, 0.5);
  const auto note = [](const PackingSpecification& specification) {
    return prepare_packing(specification, {}).stepping;
  };
  EXPECT_TRUE(
      note(asked).starts_with(std::string(kSteppingNote) + "the loop over spheres (hooke/radii, history"))
      << note(asked);
  asked.loop = CellLoop::engine;
  EXPECT_EQ(note(asked), std::string(kSteppingNote) + "LIGGGHTS's own loop, as `loop: engine` asks");
  EXPECT_EQ(note(specification(60, 0.3)),
            std::string(kSteppingNote) + "LIGGGHTS's own loop, as all packings of discs");
}

}  // namespace
}  // namespace polargrain::dem
