// SPDX-License-Identifier: GPL-2.0-or-later
// States whose bits were flipped, given to LIGGGHTS itself: it refuses them, goes on from them, or ends in
// its own words, and never by a signal; and what it went on from leaves nothing behind. One process evaluates
// many, until the engine ends it. POLARGRAIN_FUZZ_RUNS asks for more than the few of every day.
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

#include "common/error.hpp"
#include "dem/box/snapshot.hpp"
#include "dem/cell/cell_service.hpp"
#include "dem/cell/state_fault.hpp"
#include "tests/support/flipped_bytes.hpp"
#include "tests/support/lattice_fixture.hpp"
#include "tests/support/sphere_cells.hpp"

// Findings of sanitizers must not look like an engine that ended in its own words. Such an engine leaves all of its
// memory, so that nothing can be said of leaks here.
extern "C" const char* __asan_default_options() {  // NOLINT(bugprone-reserved-identifier)
  return "exitcode=99:detect_leaks=0";
}
// LIGGGHTS's last words are now and then a phrase of its own (its class SpecialMessages), printed after it was freed.
extern "C" const char* __asan_default_suppressions() {  // NOLINT(bugprone-reserved-identifier)
  return "interceptor_via_fun:LAMMPS_NS::Error::all\n";
}
extern "C" const char* __ubsan_default_options() {  // NOLINT(bugprone-reserved-identifier)
  return "exitcode=99:print_stacktrace=1";
}

namespace polargrain::dem {
namespace {

constexpr int kDone = 0;
constexpr int kEndedByTheEngine = 1;
constexpr int kImplausibleTakenUp = 42;
constexpr int kTraceLeft = 43;
constexpr long kGoodOneEvery = 500;  ///< between spoiled ones the good one, which answers as at first
constexpr long kSaidEvery = 20000;

long runs() {
  const char* const asked = std::getenv("POLARGRAIN_FUZZ_RUNS");
  return asked != nullptr ? std::atol(asked) : 400;
}

/// The same state for the same number, in whichever process.
StatePointer spoiled_state(const State& good, long run) {
  return testing::Spoiler(static_cast<unsigned>(20260119 + run))(good);
}

/// The tally of the evaluating process; in memory that it shares with the test.
struct Tally {
  long run = 0;  ///< at work on
  long refused = 0;
  long answered = 0;
};

class SharedTally {
 public:
  SharedTally()
      : place_(mmap(nullptr, sizeof(Tally), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0)),
        tally_(new (place_) Tally) {}
  ~SharedTally() { munmap(place_, sizeof(Tally)); }
  SharedTally(const SharedTally&) = delete;
  SharedTally& operator=(const SharedTally&) = delete;
  Tally* operator->() { return tally_; }

 private:
  void* place_;
  Tally* tally_;
};

/// Who made the state, and who goes on from it.
struct Pair {
  CellLoop maker;
  CellLoop taker;
  bool spheres = false;
};

/// Evaluates from tally.run on. @returns the exit status of the process, if the engine does not end it before
int evaluate_spoiled(CellService& cell, const CellDefinition& maker, const State& good, CellRequest request,
                     SharedTally& tally, bool leaves_no_trace) {
  const StatePointer whole = std::make_shared<const State>(good);
  request.state = whole;
  const ContentName expected = cell.evaluate(request).state->name();
  for (; tally->run < runs(); ++tally->run) {
    alarm(60);
    request.state = spoiled_state(good, tally->run);
    try {
      (void)cell.evaluate(request);
      ++tally->answered;
      if (!state_fault(maker, *request.state).empty()) return kImplausibleTakenUp;
    } catch (const RunError&) {
      ++tally->refused;
    }
    if (tally->run % kSaidEvery == 0) std::printf("spoiled state %ld\n", tally->run);
    if (!leaves_no_trace || tally->run % kGoodOneEvery != 0) continue;
    request.state = whole;
    if (!(cell.evaluate(request).state->name() == expected)) return kTraceLeft;
  }
  return kDone;
}

class SpoiledStates : public ::testing::TestWithParam<Pair> {};

TEST_P(SpoiledStates, EndNoEngineByASignal) {
  CellDefinition definition =
      GetParam().spheres ? test::hertz_spheres() : test::lattice(4, 4, CellRotations::free);
  if (GetParam().spheres) definition.control.tangent = CellTangent::none;  // ten times as dear as the rest
  definition.control.loop = GetParam().taker;
  // Few steps: what is wrong with a state shows in the first ones.
  definition.control.inertial_number = 2.4e-2;
  definition.control.most_relaxation_steps = 20;
  CellDefinition maker = definition;
  maker.control.loop = GetParam().maker;
  // The general loop takes up states of both kinds, though the coordinator lets it have its own kind alone: discs are
  // then put where the engine has them, in an order that is that of the evaluation before, and so are the last bits.
  const bool leaves_no_trace = GetParam().maker == GetParam().taker;
  CellRequest request;
  request.increment.displacement_gradient(0, 1) = 2e-4;
  request.increment.displacement_gradient(1, 1) = -1e-4;
  const StatePointer good = make_cell_service(maker)->evaluate(request).state;
  ASSERT_EQ(is_snapshot<2>(*good) || is_snapshot<3>(*good), GetParam().maker == CellLoop::automatic);
  ASSERT_EQ(state_fault(maker, *good), "");

  const auto cell = make_cell_service(definition);
  SharedTally tally;
  long ended = 0;
  while (tally->run < runs()) {
    const pid_t child = fork();
    if (child == 0) _exit(evaluate_spoiled(*cell, maker, *good, request, tally, leaves_no_trace));
    int status = 0;
    waitpid(child, &status, 0);
    ASSERT_TRUE(WIFEXITED(status)) << "signal " << WTERMSIG(status) << " at run " << tally->run;
    if (WEXITSTATUS(status) == kDone) break;
    ASSERT_EQ(WEXITSTATUS(status), kEndedByTheEngine) << "at run " << tally->run;
    EXPECT_EQ(state_fault(maker, *spoiled_state(*good, tally->run)), "") << tally->run;
    ++ended;
    ++tally->run;
  }
  std::printf("[figure] %ld spoiled states: %ld refused, %ld gone on from, %ld ended by the engine\n", runs(),
              tally->refused, tally->answered, ended);
  EXPECT_EQ(tally->refused + tally->answered + ended, runs());
  EXPECT_GT(tally->refused, runs() / 2);
  EXPECT_GT(tally->answered, 0);
}

INSTANTIATE_TEST_SUITE_P(Kinds, SpoiledStates,
                         ::testing::Values(Pair{CellLoop::engine, CellLoop::engine},
                                           Pair{CellLoop::automatic, CellLoop::engine},
                                           Pair{CellLoop::automatic, CellLoop::automatic},
                                           Pair{CellLoop::engine, CellLoop::engine, true},
                                           Pair{CellLoop::automatic, CellLoop::engine, true},
                                           Pair{CellLoop::automatic, CellLoop::automatic, true}),
                         [](const auto& each) {
                           const std::string of =
                               each.param.maker == CellLoop::engine
                                   ? (each.param.spheres ? "OfSpheresOfTheGeneralLoop" : "OfTheGeneralLoop")
                                   : (each.param.spheres ? "OfSpheres" : "OfDiscs");
                           return of +
                                  (each.param.taker == CellLoop::engine ? "InTheGeneralLoop" : "InTheirLoop");
                         });

}  // namespace
}  // namespace polargrain::dem
