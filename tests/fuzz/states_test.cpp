// SPDX-License-Identifier: GPL-2.0-or-later
// States whose bits were flipped, with a fixed seed: refused in words, or harmless to what goes on from them.
// Under the sanitizers too. POLARGRAIN_FUZZ_RUNS asks for more than the few of every day.
#include <gtest/gtest.h>

#include <bit>
#include <cstdlib>
#include <iostream>

#include "common/error.hpp"
#include "dem/cell/packed_grains.hpp"
#include "dem/cell/state_fault.hpp"
#include "dem/discs/disc_box.hpp"
#include "dem/laws/law_settings.hpp"
#include "tests/support/flipped_bytes.hpp"
#include "tests/support/lattice_fixture.hpp"

namespace polargrain::dem {
namespace {

constexpr double kTimeStep = 1e-5;  // s

constexpr int kSide = 6;

long runs() {
  const char* const asked = std::getenv("POLARGRAIN_FUZZ_RUNS");
  return asked != nullptr ? std::atol(asked) : 4000;
}

/// The cell of the lattice, stepped without an engine.
DiscBox::Definition discs_of(const Packing& packing) {
  DiscBox::Definition definition;
  LawCombination& laws = definition.combination;
  laws.normal = NormalLaw::hooke_stiffness;
  laws.tangential = TangentialLaw::history;
  laws.rolling = RollingLaw::li_chu;
  laws.types = 1;
  PairParameters& pair = laws.pairs.emplace_back();
  pair.normal = test::kNormal;
  pair.tangential = test::kTangential;
  pair.friction = 0.5;
  pair.rolling_friction = 0.2;
  pair.rolling_stiffness = 0.8;
  for (const Grain& grain : packing.grains) {
    definition.radii.push_back(grain.radius);
    definition.masses.push_back(grain.mass);
    definition.types.push_back(0);
  }
  definition.thickness = packing.thickness;
  definition.time_step = kTimeStep;
  return definition;
}

Snapshot<2> at_rest(const Packing& packing, const LawCombination& laws) {
  Snapshot<2> snapshot;
  snapshot.box = Box<2>::from_base_vectors(packing.box);
  snapshot.code = laws.code();
  snapshot.springs = spring_count(laws.rolling);
  for (const Grain& grain : packing.grains)
    snapshot.grains.push_back({{grain.position.x(), grain.position.y()}, {}, {}, {}});
  return snapshot;
}

/// Some steps along a shear. @returns the state behind them
StatePointer sheared(DiscBox& box, int steps) {
  Eigen::Matrix2d h;
  h << -1e-4, 2e-4, 0.0, -1e-4;
  box.begin(BoxPath<2>(box.box(), h, steps), 100.0, std::nullopt, kTimeStep);
  box.set_up();
  box.run(steps);
  return box.save();
}

TEST(FlippedStates, OfDiscsAreRefusedOrGoneOnFrom) {
  const CellDefinition cell = test::lattice(kSide, kSide, CellRotations::free);
  const DiscBox::Definition discs = discs_of(cell.packing);
  DiscBox box(discs);
  box.restore(at_rest(cell.packing, discs.combination));
  const StatePointer good = sheared(box, 40);
  ASSERT_EQ(state_fault(cell, *good), "");
  ASSERT_GT(decode_snapshot<2>(*good).contacts.size(), 50u);

  testing::Spoiler spoiled(20260117);
  long accepted = 0;
  for (long run = 0; run < runs(); ++run) {
    const StatePointer bad = spoiled(*good);
    const bool is_plausible = state_fault(cell, *bad).empty();
    try {
      box.restore(*bad);
      sheared(box, 3);
      // A state that an engine takes up has been let through before: there are more checks here, not fewer.
      EXPECT_TRUE(is_plausible) << run;
      ++accepted;
    } catch (const RunError&) {  // refused, as it should be
    }
  }
  std::cout << "[figure] " << runs() << " spoiled states of discs, of which " << accepted
            << " gone on from\n";
  EXPECT_GT(accepted, runs() / 100);  // bits of places: the search reaches beyond the checks
  EXPECT_LT(accepted, runs());
  box.restore(*good);
  EXPECT_NO_THROW(sheared(box, 3));
}

// A disc flung away has no place in a list of neighbours: that is said, and no memory is written outside of it.
TEST(FlippedStates, OfDiscsThatFlingGrainsAwayEndInWords) {
  const CellDefinition cell = test::lattice(kSide, kSide, CellRotations::free);
  const DiscBox::Definition discs = discs_of(cell.packing);
  DiscBox box(discs);
  box.restore(at_rest(cell.packing, discs.combination));
  Snapshot<2> snapshot = decode_snapshot<2>(*sheared(box, 40));
  snapshot.grains[1].place = snapshot.grains[0].place;  // at one point: no direction to push them apart in
  try {
    box.restore(snapshot);
    sheared(box, 40);
    FAIL();
  } catch (const RunError& error) {
    EXPECT_EQ(std::string(error.what()).find("Lost grains"), 0u) << error.what();
  }
}

TEST(FlippedStates, OfDiscsAreNoneOfTheEnginesLoop) {
  CellDefinition cell = test::lattice(kSide, kSide, CellRotations::free);
  const DiscBox::Definition discs = discs_of(cell.packing);
  DiscBox box(discs);
  box.restore(at_rest(cell.packing, discs.combination));
  const StatePointer state = sheared(box, 3);
  EXPECT_EQ(state_fault(cell, *state), "");
  cell.control.loop = CellLoop::engine;
  EXPECT_NE(state_fault(cell, *state).find("engine's loop"), std::string::npos);
}

/// As LIGGGHTS packs a lattice of discs with li_chu rolling: four partners each, three springs a contact.
struct Packed {
  PackedGrains state;
  GrainLayout layout;
};

double hidden(std::int64_t whole) {
  return std::bit_cast<double>(whole);
}

Packed packed_lattice(const Packing& packing) {
  constexpr int kPartners = 4;
  constexpr std::size_t kSprings = 3;
  Packed made;
  made.layout.head = 17;
  made.layout.history_values = made.state.history_values = kSprings;
  made.layout.spin = 14;
  made.layout.fixed = {8, 9, 11};
  made.layout.time_step = kTimeStep;
  made.state.box = Box<2>::from_base_vectors(packing.box);
  const auto count = static_cast<std::int64_t>(packing.grains.size());
  for (std::int64_t k = 0; k < count; ++k) {
    const Grain& grain = packing.grains[static_cast<std::size_t>(k)];
    const std::vector<double> head{17.0 + 1 + kPartners * (1 + kSprings),
                                   grain.position.x(),
                                   grain.position.y(),
                                   0.0,
                                   1e-3,
                                   -1e-3,
                                   0.0,
                                   hidden(k + 1),
                                   hidden(1),
                                   hidden(1),
                                   hidden(0x20080200),
                                   grain.radius,
                                   2650.0,
                                   grain.mass,
                                   0.0,
                                   0.0,
                                   0.1};
    made.layout.heads.push_back(head);
    made.layout.radii.push_back(grain.radius);
    std::vector<double>& values = made.state.values;
    values.insert(values.end(), head.begin(), head.end());
    values.push_back(hidden(kPartners));
    for (std::int64_t p = 1; p <= kPartners; ++p) {
      values.push_back(hidden((k + p) % count + 1));
      values.insert(values.end(), {1e-6, -1e-6, 0.0});
    }
    made.state.rotations.push_back(1e-3);
  }
  return made;
}

/// The engine's reading of a record: it believes all of it.
double unpacked(const PackedGrains& state, const GrainLayout& layout) {
  std::vector<double> of_grain(layout.heads.size(), 0.0);
  double sum = 0.0;
  for (std::size_t k = 0; k < state.grains(); ++k) {
    const double* record = &state.values[state.starts[k]];
    const auto partners = std::bit_cast<std::int64_t>(record[layout.head]);
    const double* value = record + layout.head + 1;
    for (std::int64_t p = 0; p < partners; ++p) {
      sum += of_grain.data()[std::bit_cast<std::int64_t>(*value++) - 1];
      for (std::size_t s = 0; s < layout.history_values; ++s) sum += *value++;
    }
    of_grain.data()[std::bit_cast<std::int64_t>(record[GrainLayout::kTag]) - 1] = record[1];
  }
  return sum;
}

TEST(FlippedStates, OfTheGeneralLoopNeverReachIt) {
  const CellDefinition cell = test::lattice(kSide, kSide, CellRotations::free);
  const Packed packed = packed_lattice(cell.packing);
  const StatePointer good = encode(packed.state, cell.packing.grains.size());
  ASSERT_EQ(state_fault(cell, *good), "");
  ASSERT_NO_THROW(check_records(decode_grains(*good), packed.layout));

  testing::Spoiler spoiled(20260118);
  long accepted = 0;
  double sum = 0.0;
  for (long run = 0; run < runs(); ++run) {
    const StatePointer bad = spoiled(*good);
    const bool is_plausible = state_fault(cell, *bad).empty();
    try {
      const PackedGrains state = decode_grains(*bad);
      check_records(state, packed.layout);
      sum += unpacked(state, packed.layout);
      EXPECT_TRUE(is_plausible) << run;
      ++accepted;
    } catch (const RunError&) {
    }
  }
  std::cout << "[figure] " << runs() << " spoiled states of the general loop, of which " << accepted
            << " let through (sum " << sum << ")\n";
  EXPECT_GT(accepted, runs() / 100);
  EXPECT_LT(accepted, runs());
}

StatePointer bytes_of(std::size_t count) {
  return std::make_shared<const State>(std::vector<std::byte>(count));
}

TEST(StateFault, NamesWhatIsWrong) {
  const CellDefinition cell = test::lattice(kSide, kSide, CellRotations::free);
  const Packed packed = packed_lattice(cell.packing);
  for (const std::size_t size : {std::size_t{0}, std::size_t{100}, std::size_t{200'000'000}}) {
    const State by_name_alone({1, 2}, size);
    EXPECT_EQ(
        state_fault(cell, by_name_alone).find("a state has " + std::to_string(size) + " bytes; one of 36"),
        0u)
        << state_fault(cell, by_name_alone);
  }
  EXPECT_EQ(state_fault(cell, *bytes_of(5000)), "this is not the state of a cell");
  const CellDefinition other = test::lattice(kSide, kSide + 2, CellRotations::free);
  EXPECT_EQ(state_fault(other, *encode(packed.state, 36)), "this state is of 36 grains; the cell has 48");
}

/// A change of one value, and what is said of it.
void expect_refused(const Packed& packed, std::size_t value, double now, const std::string& words) {
  PackedGrains state = packed.state;
  state.values[value] = now;
  try {
    check_records(decode_grains(*encode(state, packed.layout.heads.size())), packed.layout);
    FAIL() << value;
  } catch (const RunError& error) {
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  }
}

TEST(PackedGrains, BelieveNoLengthNoPartnerAndNoPlace) {
  const Packed packed = packed_lattice(test::lattice(kSide, kSide, CellRotations::free).packing);
  constexpr std::size_t kRecord = 34;
  constexpr std::size_t kPartners = 17;
  const std::string damaged = "this state of a cell is damaged";
  const std::string other = "another packing or another input script";
  for (const double length : {0.0, -1.0, 33.0, 33.5, 35.0, 1e18}) expect_refused(packed, 0, length, damaged);
  for (const std::int64_t count : {-1, 0, 3, 5, INT32_MAX})
    expect_refused(packed, kPartners, hidden(count), damaged);
  for (const std::int64_t partner : {0, 37, INT32_MAX})
    expect_refused(packed, kPartners + 1, hidden(partner), damaged);
  expect_refused(packed, GrainLayout::kTag, hidden(0), damaged);
  expect_refused(packed, GrainLayout::kTag, hidden(37), damaged);
  expect_refused(packed, kRecord + GrainLayout::kTag, hidden(1), damaged);  // that of the first grain
  expect_refused(packed, 8, hidden(2), other);                              // type
  expect_refused(packed, 11, 0.02, other);                                  // radius
  expect_refused(packed, 1, 1e6, "grain 0 lies at (1e+06");
  expect_refused(packed, 4, 1e9, "moves at (1e+09");
  expect_refused(packed, 3, 1.0, damaged);
  expect_refused(packed, 5, std::nan(""), "it holds a number that is not finite");
}

}  // namespace
}  // namespace polargrain::dem
