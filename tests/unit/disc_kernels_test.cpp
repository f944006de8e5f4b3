// SPDX-License-Identifier: GPL-2.0-or-later
// The loop over discs without an engine: every instruction set that this processor has gives the bits of the plain twin, for
// laws with all settings, one type of grains or two, numbers of grains that fill no whole block.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "common/packing.hpp"
#include "dem/discs/disc_box.hpp"
#include "tests/support/sums_of_contacts.hpp"

namespace polargrain::dem {
namespace {

constexpr double kDiscStep = 1e-5;  // s

PairParameters disc_parameters(NormalLaw normal, double factor) {
  PairParameters p;
  p.normal = normal == NormalLaw::hooke_radii ? 1.2e9 : normal == NormalLaw::hooke_stiffness ? 3e6 : 4e7;
  p.tangential = normal == NormalLaw::hooke_radii ? 0.8 : normal == NormalLaw::hooke_stiffness ? 2e6 : 3e7;
  p.normal_damping = normal == NormalLaw::hooke_radii       ? 0.05
                     : normal == NormalLaw::hooke_stiffness ? 300.0
                                                            : 1e3;
  p.tangential_damping = p.normal_damping;
  p.friction = 0.4 * factor;
  p.rolling_friction = 0.1 * factor;
  p.rolling_stiffness = 1.0;
  p.rolling_damping = 0.05;
  p.rolling_force_friction = 0.1;
  p.rolling_force_stiffness = 0.2;
  p.rolling_force_damping = 0.05;
  return p;
}

struct DiscLaws {
  std::string name;
  NormalLaw normal;
  TangentialLaw tangential;
  RollingLaw rolling;
  LawSettings settings;
};

void PrintTo(const DiscLaws& laws, std::ostream* stream) {
  *stream << laws.name;
}

LawSettings with(bool LawSettings::*one, bool LawSettings::*other = nullptr) {
  LawSettings on;
  on.*one = true;
  if (other) on.*other = true;
  return on;
}

/// All models, bare, and with every setting alone or with those that it needs.
std::vector<DiscLaws> all_laws() {
  std::vector<DiscLaws> made;
  const char* const normals[] = {"radii", "stiffness", "hertz"};
  const char* const tangentials[] = {"history", "li_chu"};
  const char* const rollings[] = {"off", "epsd2", "li_chu"};
  for (int n = 0; n < 3; ++n)
    for (int t = 0; t < 2; ++t)
      for (int r = 0; r < 3; ++r) {
        const auto add = [&](const std::string& name, const LawSettings& settings) {
          made.push_back({std::string(normals[n]) + "_" + tangentials[t] + "_" + rollings[r] + "_" + name,
                          NormalLaw{n}, TangentialLaw{t}, RollingLaw{r}, settings});
        };
        add("bare", {});
        add("damped", with(&LawSettings::damped, &LawSettings::limit_force));
        if (t == 1)
          add("rolling_force", with(&LawSettings::rolling_force, &LawSettings::rolling_force_damped));
        if (r == 2) add("rolling_damped", with(&LawSettings::rolling_damped, &LawSettings::mean_radius));
        if (t == 1 && r == 2) add("symmetric", with(&LawSettings::rolling_force, &LawSettings::symmetric));
        if (n == 1) add("absolute", with(&LawSettings::damped, &LawSettings::absolute_damping));
      }
  return made;
}

Packing disc_packing() {
  return read_packing("cases/biaxial/packing400.csv");
}

DiscBox::Definition definition_of(const Packing& packing, const DiscLaws& laws, int types) {
  DiscBox::Definition made;
  made.combination.normal = laws.normal;
  made.combination.tangential = laws.tangential;
  made.combination.rolling = laws.rolling;
  made.combination.settings = laws.settings;
  made.combination.types = types;
  for (int a = 0; a < types; ++a)
    for (int b = 0; b < types; ++b)
      made.combination.pairs.push_back(disc_parameters(laws.normal, a == 0 && b == 0 ? 1.0 : 0.5));
  for (const Grain& grain : packing.grains) {
    made.radii.push_back(grain.radius);
    made.masses.push_back(grain.mass);
    made.types.push_back(grain.id % 3 == 0 ? types - 1 : 0);
  }
  made.thickness = packing.thickness;
  made.time_step = kDiscStep;
  return made;
}

Snapshot<2> at_rest(const Packing& packing, const DiscBox::Definition& discs) {
  Snapshot<2> snapshot;
  snapshot.box = Box<2>::from_base_vectors(packing.base_vectors().topLeftCorner<2, 2>());
  snapshot.code = discs.combination.code();
  snapshot.springs = spring_count(discs.combination.rolling);
  for (const Grain& grain : packing.grains)
    snapshot.grains.push_back({{grain.position.x(), grain.position.y()}, {}, {}, {}});
  return snapshot;
}

/// A strain with all components, with prescribed rotations and a curvature, large enough for some lists to be made anew.
void run(DiscBox& box, int steps) {
  Eigen::Matrix2d strain;
  strain << 2e-3, 4e-3, -1e-3, -5e-3;
  RotationLoading<2> rotation;
  rotation.rotation << 5e-4;
  rotation.curvature << 0.2, -0.1;
  box.begin(BoxPath<2>(box.box(), strain, steps), 300.0, rotation, kDiscStep);
  box.set_up();
  const std::size_t count = box.places().size() / 2;
  box.set_rotation_weights(std::vector<double>(count, 1.0 / static_cast<double>(count)));
  box.hold_rotation();
  box.run(steps / 2);
  box.run(steps - steps / 2 + 10);
}

class DiscKernelsOf : public ::testing::TestWithParam<DiscLaws> {};

TEST_P(DiscKernelsOf, GiveTheBitsOfThePlainTwin) {
  for (const int types : {1, 2}) {
    Packing made = disc_packing();
    if (types == 2) made.grains.resize(made.grains.size() - 3);  // a hole
    DiscBox::Definition discs = definition_of(made, GetParam(), types);
    const Snapshot<2> start = at_rest(made, discs);
    discs.plain = true;
    DiscBox plain(discs);
    plain.restore(start);
    run(plain, 300);
    const StatePointer expected = plain.save();
    // Bits that are all alike could be those of grains that never touched.
    EXPECT_GT(decode_snapshot<2>(*expected).contacts.size(), 400U);
    discs.plain = false;
    for (const InstructionSet set :
         {InstructionSet::baseline, InstructionSet::avx2, InstructionSet::avx512}) {
      if (!is_supported(set)) continue;
      discs.instructions = set;
      DiscBox box(discs);
      box.restore(start);
      run(box, 300);
      EXPECT_TRUE(std::ranges::equal(box.save()->bytes(), expected->bytes())) << name_of(set) << types;
    }
  }
}

TEST(DiscBoxes, SumContactsWithoutAList) {
  const Packing made = disc_packing();
  const DiscBox::Definition discs = definition_of(made, all_laws().front(), 1);
  DiscBox box(discs);
  box.restore(at_rest(made, discs));
  testing::expect_sums_without_a_list<2>(box, [](DiscBox& tested, int steps) { run(tested, steps); });
}

INSTANTIATE_TEST_SUITE_P(Laws, DiscKernelsOf, ::testing::ValuesIn(all_laws()),
                         [](const auto& tested) { return tested.param.name; });

// Friction must be at its limit at some contacts and not at others, or the test of bits would miss a branch.
TEST(DiscKernels, SlideAndRollInTheTestOfTheirBits) {
  const Packing made = disc_packing();
  const DiscLaws full{"full", NormalLaw::hooke_radii, TangentialLaw::li_chu, RollingLaw::li_chu, {}};
  const DiscBox::Definition discs = definition_of(made, full, 1);
  DiscBox box(discs);
  box.restore(at_rest(made, discs));
  run(box, 300);
  const auto rolling =
      std::ranges::count_if(box.contacts(), [](const Contact& c) { return c.rolling_at_limit; });
  EXPECT_GT(rolling, 10);
  EXPECT_LT(rolling, static_cast<std::ptrdiff_t>(box.contacts().size()) - 10);
}

}  // namespace
}  // namespace polargrain::dem
