// SPDX-License-Identifier: GPL-2.0-or-later
// States whose bits were flipped, given to LIGGGHTS itself: it refuses them, goes on from them, or ends in
// its own words, and never by a signal. A process for each. POLARGRAIN_FUZZ_RUNS asks for more than the few
// of every day.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

#include "common/error.hpp"
#include "dem/cell/cell_service.hpp"
#include "dem/cell/state_fault.hpp"
#include "dem/discs/disc_state.hpp"
#include "tests/support/flipped_bytes.hpp"
#include "tests/support/lattice_fixture.hpp"

namespace polargrain::dem {
namespace {

constexpr int kAnswered = 0;
constexpr int kRefused = 42;

long runs() {
  const char* const asked = std::getenv("POLARGRAIN_FUZZ_RUNS");
  return asked != nullptr ? std::atol(asked) : 400;
}

/// How a process that evaluates the request ends. @returns the status as waitpid gives it
int end_of(CellService& cell, const CellRequest& request) {
  const pid_t child = fork();
  if (child == 0) {
    alarm(60);
    try {
      (void)cell.evaluate(request);
    } catch (const RunError&) {
      _exit(kRefused);
    }
    _exit(kAnswered);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return status;
}

class SpoiledStates : public ::testing::TestWithParam<CellLoop> {};

TEST_P(SpoiledStates, EndNoEngineByASignal) {
  CellDefinition definition = test::lattice(4, 4, CellRotations::free);
  definition.control.loop = CellLoop::engine;
  definition.control.most_relaxation_steps = 100;
  // The general loop takes up states of both kinds, though the coordinator lets it have its own kind alone.
  CellDefinition maker = definition;
  maker.control.loop = GetParam();
  CellRequest request;
  request.increment.displacement_gradient << 0.0, 2e-4, 0.0, -1e-4;
  const StatePointer good = make_cell_service(maker)->evaluate(request).state;
  ASSERT_EQ(is_disc_state(*good), GetParam() == CellLoop::automatic);
  ASSERT_EQ(state_fault(maker, *good), "");

  const auto cell = make_cell_service(definition);
  testing::Spoiler spoiled(20260119);
  long refused = 0;
  long answered = 0;
  long ended = 0;
  for (long run = 0; run < runs(); ++run) {
    request.state = spoiled(*good);
    const bool is_plausible = state_fault(maker, *request.state).empty();
    const int status = end_of(*cell, request);
    ASSERT_TRUE(WIFEXITED(status)) << "signal " << WTERMSIG(status) << " at run " << run;
    if (WEXITSTATUS(status) == kRefused)
      ++refused;
    else
      EXPECT_TRUE(is_plausible) << run;
    answered += WEXITSTATUS(status) == kAnswered ? 1 : 0;
    ended += WEXITSTATUS(status) != kAnswered && WEXITSTATUS(status) != kRefused ? 1 : 0;
  }
  std::printf("[figure] %ld spoiled states: %ld refused, %ld gone on from, %ld ended by the engine\n", runs(),
              refused, answered, ended);
  EXPECT_GT(refused, runs() / 2);
  EXPECT_GT(answered, 0);
}

INSTANTIATE_TEST_SUITE_P(Kinds, SpoiledStates, ::testing::Values(CellLoop::engine, CellLoop::automatic),
                         [](const auto& each) {
                           return each.param == CellLoop::engine ? "OfTheGeneralLoop" : "OfDiscs";
                         });

}  // namespace
}  // namespace polargrain::dem
