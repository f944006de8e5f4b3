// SPDX-License-Identifier: GPL-2.0-or-later
// An engine that somebody has got the better of can still compute, and nothing else.
#include "tests/faults/fake_case.hpp"

namespace polargrain::testing {
namespace {

class ConfinementTest : public FakeCaseTest {
 protected:
  ConfinementTest() { write(scratch_.path() / "fake.in", "tries 1\n"); }

  void run(const std::string& more = "") const {
    const Outcome outcome = run_in(scratch_.path(), "TMPDIR=$PWD " + command(1, " -o out -w 1 " + more));
    ASSERT_EQ(outcome.status, 0) << outcome.errors;
  }
  [[nodiscard]] std::string outcome_of(const std::string& attempt) const {
    const std::string log = result("out/logs/worker-1.log");
    const std::string line = "tried " + attempt + ": ";
    const std::size_t at = log.find(line);
    return at == std::string::npos ? "not tried" : log.substr(at + line.size(), 7);
  }
  /// Whether the system has what this takes; the run says when it has not.
  [[nodiscard]] bool has(const std::string& what) const {
    return result("out/run.log").find(what) == std::string::npos;
  }
};

TEST_F(ConfinementTest, AWorkerComputesAndDoesNothingElse) {
  run();
  if (has("seccomp")) {
    EXPECT_EQ(outcome_of("to start a program"), "refused");
    EXPECT_EQ(outcome_of("a socket of the network"), "refused");
    EXPECT_EQ(outcome_of("to trace its coordinator"), "refused");
    EXPECT_EQ(outcome_of("to signal its coordinator"), "refused");
    EXPECT_EQ(outcome_of("to make namespaces"), "refused");
  }
  if (has("landlock")) {
    EXPECT_EQ(outcome_of("to write elsewhere"), "refused");
  }
  EXPECT_EQ(outcome_of("to write in its folder"), "allowed");
  EXPECT_EQ(outcome_of("to start another process of its own"), "allowed");
  // Nothing of the folder is left behind.
  for (const auto& entry : std::filesystem::directory_iterator(scratch_.path()))
    EXPECT_EQ(entry.path().filename().string().find("polargrain-"), std::string::npos) << entry.path();
}

TEST_F(ConfinementTest, TrustedScriptsMayDoWhatTheUserMay) {
  run("--trust-scripts");
  for (const char* attempt :
       {"to start a program", "a socket of the network", "to write elsewhere", "to signal its coordinator"})
    EXPECT_EQ(outcome_of(attempt), "allowed") << attempt;
  EXPECT_TRUE(has("more rights than it needs"));
}

// Confined to its directory, a guest may change nothing beside it; yet the directory itself goes.
TEST_F(ConfinementTest, AGuestLeavesNoDirectoryBehind) {
  write(scratch_.path() / "fake.in", "\n");
  const std::filesystem::path place = scratch_.path() / "tmp";
  std::filesystem::create_directories(place);
  ASSERT_EQ(run_in(scratch_.path(), FAKE_POLARGRAIN " keys keys").status, 0);
  const Outcome outcome =
      run_in(scratch_.path(), "{ " + command(2) +
                                  " -o out -w 0 --keys keys --listen 'tcp://127.0.0.1:*' & run=$!; " +
                                  await_url("out") + "TMPDIR='" + place.string() +
                                  "' " FAKE_POLARGRAIN
                                  " worker --key keys/worker.key --connect $url >/dev/null 2>&1 & "
                                  "wait $run; status=$?; wait; exit $status; }");
  EXPECT_EQ(outcome.status, 0) << outcome.errors;
  EXPECT_TRUE(std::filesystem::is_empty(place));
}

}  // namespace
}  // namespace polargrain::testing
