// SPDX-License-Identifier: GPL-2.0-or-later
// The loop over spheres without an engine: the same bits from every instruction set that this processor has and from the
// plain twin, for laws with all settings; forces that balance; lists that miss no pair.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "common/error.hpp"
#include "common/packing.hpp"
#include "dem/sphere_loop/sphere_box.hpp"
#include "tests/support/sums_of_contacts.hpp"

namespace polargrain::dem {
namespace {

constexpr double kTimeStep = 3e-6;  // s

PairParameters parameters(NormalLaw normal, double factor) {
  PairParameters p;
  p.normal = normal == NormalLaw::hooke_radii ? 1.2e9 : normal == NormalLaw::hooke_stiffness ? 3e6 : 3e10;
  p.tangential = normal == NormalLaw::hooke_radii ? 0.8 : normal == NormalLaw::hooke_stiffness ? 2e6 : 3e10;
  p.normal_damping = normal == NormalLaw::hooke_radii       ? 0.05
                     : normal == NormalLaw::hooke_stiffness ? 3000.0
                                                            : 1e4;
  p.tangential_damping = p.normal_damping;
  p.friction = 0.4 * factor;
  p.rolling_friction = 0.1 * factor;
  p.rolling_stiffness = 1.0;
  p.rolling_force_friction = 0.1;
  p.rolling_force_stiffness = 0.2;
  p.rolling_damping = p.rolling_force_damping = 0.05;
  return p;
}

struct Laws {
  std::string name;
  NormalLaw normal;
  TangentialLaw tangential;
  RollingLaw rolling;
  LawSettings settings;
};

/// damped, absolute, limit, rolling force, its damping, symmetric, rolling damped, mean radius, torsion
const std::vector<Laws> kLaws{
    {"history", NormalLaw::hooke_radii, TangentialLaw::history, RollingLaw::off, {}},
    {"history_damped",
     NormalLaw::hooke_stiffness,
     TangentialLaw::history,
     RollingLaw::off,
     {true, false, true, false, false, false, false, false, false}},
    {"epsd2",
     NormalLaw::hooke_radii,
     TangentialLaw::history,
     RollingLaw::epsd2,
     {false, false, false, false, false, false, false, false, true}},
    {"li_chu_torsion",
     NormalLaw::hooke_radii,
     TangentialLaw::li_chu,
     RollingLaw::li_chu,
     {false, false, false, false, false, false, false, false, true}},
    {"full",
     NormalLaw::hooke_radii,
     TangentialLaw::li_chu,
     RollingLaw::li_chu,
     {true, false, false, true, false, false, false, true, true}},
    {"all_dashpots",
     NormalLaw::hooke_radii,
     TangentialLaw::li_chu,
     RollingLaw::li_chu,
     {true, false, false, true, true, false, true, false, true}},
    {"symmetric",
     NormalLaw::hooke_radii,
     TangentialLaw::li_chu,
     RollingLaw::li_chu,
     {false, false, false, true, false, true, false, false, false}},
    {"hertz", NormalLaw::hertz, TangentialLaw::history, RollingLaw::li_chu, {}},
    {"hertz_full",
     NormalLaw::hertz,
     TangentialLaw::li_chu,
     RollingLaw::li_chu,
     {true, false, true, true, true, false, true, false, true}}};

Packing packing() {
  return read_packing("cases/spheres/packing1000.csv");
}

/// Two types of grains, which rub differently.
Spheres spheres_of(const Packing& packing, const Laws& laws) {
  Spheres spheres;
  LawCombination& made = spheres.combination;
  made.normal = laws.normal;
  made.tangential = laws.tangential;
  made.rolling = laws.rolling;
  made.settings = laws.settings;
  made.types = 2;
  made.pairs = {parameters(laws.normal, 1.0), parameters(laws.normal, 0.5), parameters(laws.normal, 0.5),
                parameters(laws.normal, 0.25)};
  for (const Grain& grain : packing.grains) {
    spheres.radii.push_back(grain.radius);
    spheres.masses.push_back(grain.mass);
    spheres.inertias.push_back(sphere_inertia(grain.mass, grain.radius));
    spheres.types.push_back(grain.id % 3 == 0 ? 1 : 0);
  }
  return spheres;
}

Snapshot<3> at_rest(const Packing& packing, const Spheres& spheres) {
  Snapshot<3> snapshot;
  snapshot.box = Box<3>::from_base_vectors(packing.base_vectors());
  snapshot.code = spheres.combination.code();
  snapshot.springs = sphere_spring_count(spheres.combination);
  for (const Grain& grain : packing.grains)
    snapshot.grains.push_back({{grain.position.x(), grain.position.y(), grain.height}, {}, {}, {}});
  return snapshot;
}

/// A strain with all components, with prescribed rotations and a curvature, large enough for some lists to be made anew.
void run(SphereBox& box, int steps) {
  Eigen::Matrix3d strain;
  strain << 2e-3, 1e-3, -5e-4, 3e-4, 1e-3, 4e-4, -2e-4, 5e-4, -4e-3;
  RotationLoading<3> rotation;
  rotation.rotation << 3e-4, -2e-4, 5e-4;
  rotation.curvature << 0.02, -0.01, 0.01, 0.0, 0.015, -0.02, 0.01, 0.0, -0.01;
  box.begin(BoxPath<3>(box.box(), strain, steps), 3000.0, rotation, kTimeStep);
  box.set_up();
  const std::size_t count = box.places().size() / 3;
  box.set_rotation_weights(std::vector<double>(count, 1.0 / static_cast<double>(count)));
  box.hold_rotation();
  box.run(steps / 2);
  box.run(steps - steps / 2 + 10);
}

class SphereKernelsOf : public ::testing::TestWithParam<Laws> {};

TEST_P(SphereKernelsOf, GiveTheSameBitsWithEveryInstructionSet) {
  const Packing made = packing();
  const Spheres spheres = spheres_of(made, GetParam());
  const Snapshot<3> start = at_rest(made, spheres);
  SphereBox plain(spheres, sphere_kernels(InstructionSet::baseline, true));
  plain.restore(start);
  run(plain, 300);
  const StatePointer expected = plain.save();
  for (const InstructionSet set : {InstructionSet::baseline, InstructionSet::avx2, InstructionSet::avx512}) {
    if (!is_supported(set)) continue;
    SphereBox box(spheres, sphere_kernels(set));
    box.restore(start);
    run(box, 300);
    EXPECT_TRUE(std::ranges::equal(box.save()->bytes(), expected->bytes())) << name_of(set);
    ASSERT_EQ(box.contacts().size(), plain.contacts().size());
    for (std::size_t c = 0; c < box.contacts().size(); ++c) {
      EXPECT_EQ(box.contacts()[c].force, plain.contacts()[c].force);
      EXPECT_EQ(box.contacts()[c].moment, plain.contacts()[c].moment);
      EXPECT_EQ(box.contacts()[c].rolling_limit, plain.contacts()[c].rolling_limit);
    }
  }
}

// Bits that are all alike could be those of grains that never touched.
TEST_P(SphereKernelsOf, SlideAndRollInTheTestOfTheirBits) {
  const Packing made = packing();
  const Spheres spheres = spheres_of(made, GetParam());
  SphereBox box(spheres, sphere_kernels(best_instruction_set()));
  box.restore(at_rest(made, spheres));
  run(box, 300);
  const Snapshot<3> end = decode_snapshot<3>(*box.save());
  EXPECT_GT(box.contacts().size(), 1500U);
  EXPECT_GT(end.contacts.size(), 1500U);
  EXPECT_TRUE(
      std::ranges::any_of(end.contacts, [](const auto& c) { return c.image[0] != 0 || c.image[2] != 0; }));
  const auto rolling =
      std::ranges::count_if(box.contacts(), [](const Contact& c) { return c.rolling_at_limit; });
  if (GetParam().rolling != RollingLaw::off) {
    EXPECT_GT(rolling, 10);
    EXPECT_LT(rolling, static_cast<std::ptrdiff_t>(box.contacts().size()) - 10);
  }
}

INSTANTIATE_TEST_SUITE_P(Laws, SphereKernelsOf, ::testing::ValuesIn(kLaws),
                         [](const auto& tested) { return tested.param.name; });

// Against a search over all pairs and images.
TEST(SphereLists, HoldEveryPairOnceAndTouchingOnesFirst) {
  const Packing made = packing();
  const Eigen::Matrix3d base = Box<3>::from_base_vectors(made.base_vectors()).base;
  const int n =
      300;  // in a box where they lie far apart, and in one where some see several images of each other
  for (const double shrunk : {1.0, 0.15}) {
    std::vector<double> rows(n * kGrainStride, 0.0);
    std::vector<Eigen::Vector3d> places;
    for (int k = 0; k < n; ++k) {
      const Grain& grain = made.grains[static_cast<std::size_t>(k)];
      places.emplace_back(shrunk * Eigen::Vector3d(grain.position.x(), grain.position.y(), grain.height));
      // Some lie in other copies of the box.
      places.back() += shrunk * (base * Eigen::Vector3d(k % 3 - 1, k % 5 == 0 ? 2 : 0, k % 7 == 0 ? -1 : 0));
      std::copy_n(places.back().data(), 3, &rows[static_cast<std::size_t>(k) * kGrainStride]);
      rows[static_cast<std::size_t>(k) * kGrainStride + 3] = grain.radius;
    }
    const Eigen::Matrix3d box = shrunk * base;
    const double skin = 4e-4;
    SphereList list;
    list.spring_count = 3;
    list.find(rows.data(), n, box, skin);
    std::set<std::tuple<int, int, int, int, int>> found;
    for (int c = 0; c < list.count; ++c) {
      if (list.first[c] >= n) continue;
      const SpaceLattice& image = list.images[list.image[c]];
      EXPECT_TRUE(found.insert({list.first[c], list.second[c], image.p, image.q, image.r}).second);
      const double gap = (places[list.first[c]] - places[list.second[c]] - image.of(box)).norm() -
                         made.grains[list.first[c]].radius - made.grains[list.second[c]].radius;
      const bool touches = c < list.touching || (c >= list.interior && c < list.touching_across);
      EXPECT_EQ(touches, gap <= 0.0);
      EXPECT_GE(gap, touches ? -1.0 : list.gaps[c / kBlock] - 1e-15);
      EXPECT_EQ(image.is_home(), c < list.interior);
    }
    std::size_t pairs = 0;
    for (int i = 0; i < n; ++i)
      for (int j = i; j < n; ++j)
        for (int p = -5; p <= 5; ++p)
          for (int q = -5; q <= 5; ++q)
            for (int r = -5; r <= 5; ++r) {
              const SpaceLattice image{p, q, r};
              if (i == j && (r < 0 || (r == 0 && (q < 0 || (q == 0 && p <= 0))))) continue;
              const double gap = (places[i] - places[j] - image.of(box)).norm() - made.grains[i].radius -
                                 made.grains[j].radius;
              if (gap < skin) ++pairs;
            }
    EXPECT_EQ(found.size(), pairs);
  }
}

// Newton's third law, and a torque that the forces on the arms and the rolling moments explain.
TEST(SphereBoxes, ForcesOfContactsBalance) {
  const Packing made = packing();
  const Spheres spheres = spheres_of(made, kLaws[4]);
  SphereBox box(spheres, sphere_kernels(best_instruction_set()));
  box.restore(at_rest(made, spheres));
  run(box, 200);
  std::vector<Eigen::Vector3d> forces(made.grains.size(), Eigen::Vector3d::Zero());
  double mean = 0.0;
  for (const Contact& contact : box.contacts()) {
    const Eigen::Vector3d force(contact.force.x(), contact.force.y(), contact.force.z());
    forces[static_cast<std::size_t>(contact.first)] += force;
    forces[static_cast<std::size_t>(contact.second)] -= force;
    mean += force.norm();
  }
  double unbalanced = 0.0;
  for (const Eigen::Vector3d& force : forces) unbalanced += force.norm();
  EXPECT_NEAR(box.imbalance().force, unbalanced, 1e-10 * mean);
}

// A dashpot of rolling is that of its spring: where the spring bears nothing, it is silent.
TEST(SphereBoxes, HaveNoDashpotsOfRollingWithoutALimit) {
  const Packing made = packing();
  const auto state = [&made](bool damped) {
    Laws laws{"li_chu", NormalLaw::hooke_radii, TangentialLaw::li_chu, RollingLaw::li_chu, {}};
    laws.settings.torsion = laws.settings.rolling_force = true;
    laws.settings.rolling_damped = laws.settings.rolling_force_damped = damped;
    Spheres spheres = spheres_of(made, laws);
    for (PairParameters& pair : spheres.combination.pairs)
      pair.rolling_friction = pair.rolling_force_friction = 0.0;
    SphereBox box(spheres, sphere_kernels(best_instruction_set()));
    box.restore(at_rest(made, spheres));
    run(box, 200);
    return std::vector<double>(box.places().begin(), box.places().end());
  };
  const std::vector<double> with = state(true);
  const std::vector<double> without = state(false);
  double apart = 0.0;
  for (std::size_t k = 0; k < with.size(); ++k) apart = std::max(apart, std::abs(with[k] - without[k]));
  EXPECT_LT(apart, 1e-12);  // m: forces at their limits are cut once more, to round-off
}

TEST(SphereBoxes, SumContactsWithoutAList) {
  const Packing made = packing();
  const Spheres spheres = spheres_of(made, kLaws[4]);
  SphereBox box(spheres, sphere_kernels(best_instruction_set()));
  box.restore(at_rest(made, spheres));
  testing::expect_sums_without_a_list<3>(box, [](SphereBox& tested, int steps) { run(tested, steps); });
}

TEST(SphereBoxes, RefuseStatesThatAreNotTheirs) {
  const Packing made = packing();
  const Spheres spheres = spheres_of(made, kLaws[0]);
  SphereBox box(spheres, sphere_kernels(best_instruction_set()));
  box.restore(at_rest(made, spheres));
  run(box, 50);
  const StatePointer good = box.save();
  const std::vector<std::byte> bytes(good->bytes().begin(), good->bytes().end());
  EXPECT_NO_THROW(box.restore(*good));
  const auto refused = [&box](std::vector<std::byte> changed) {
    EXPECT_THROW(box.restore(State(std::move(changed))), RunError);
  };
  refused({});
  refused(std::vector<std::byte>(bytes.begin(), bytes.begin() + 100));
  refused(std::vector<std::byte>(bytes.begin(), bytes.end() - 8));
  // Every byte of the head and some of the rest, with all bits turned: refused, or taken; never a crash.
  for (std::size_t place = 0; place < bytes.size(); place += place < 144 ? 1 : 997) {
    std::vector<std::byte> changed = bytes;
    changed[place] = ~changed[place];
    try {
      box.restore(State(std::move(changed)));
      run(box, 4);
    } catch (const RunError&) {
    }
  }
  SphereBox other(spheres_of(made, kLaws[3]), sphere_kernels(best_instruction_set()));
  EXPECT_THROW(other.restore(*good), RunError);
}

}  // namespace
}  // namespace polargrain::dem
