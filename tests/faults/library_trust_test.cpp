// SPDX-License-Identifier: GPL-2.0-or-later
// Libraries of contact laws are programs: nobody loads one unless told that it is trusted. The fake engine stands for the
// real one and loads none (tests/integration/install.sh loads real ones).
#include <gtest/gtest.h>

#include "tests/faults/checkpoint_runs.hpp"
#include "tests/support/free_port.hpp"

namespace polargrain::testing {
namespace {

const std::string kRefused =
    "contact_library: 'laws.so' is a program, and would run with your rights; say --trust-scripts when you "
    "trust it, or remove the key\n";

class LibraryTrust : public ::testing::Test {
 protected:
  LibraryTrust()
      : scratch_(std::string("library_") + ::testing::UnitTest::GetInstance()->current_test_info()->name()) {
    FakeCase fake{"softening 0.1", "[1, 2]", "count: 4, tolerance: 1e-6"};
    fake.model = "cell, contact_library: laws.so";
    write_case(scratch_.path(), fake);
    write(scratch_.path() / "laws.so",
          "\x7f"
          "ELF and so on");
    write(scratch_.path() / "path.csv", "h22\n-1e-4\n");
  }
  [[nodiscard]] Outcome polargrain(const std::string& arguments) const {
    return run_in(scratch_.path(), POLARGRAIN " " + arguments);
  }
  Scratch scratch_;
};

TEST_F(LibraryTrust, EveryCommandThatReadsTheCaseNeedsTheWord) {
  for (const char* const command : {"check case.yaml", "run case.yaml -o out",
                                    "point case.yaml sand path.csv", "bench case.yaml --quick -o bench"}) {
    const Outcome outcome = polargrain(command);
    EXPECT_EQ(outcome.status, 2) << command;
    EXPECT_EQ(outcome.errors, "case.yaml:3: material 'sand': " + kRefused) << command;
  }
  EXPECT_FALSE(std::filesystem::exists(scratch_.path() / "out"));
  EXPECT_EQ(polargrain("check case.yaml --trust-scripts").status, 0);
  // Unlike a script, which is read before it is run, one named with --set needs the word too.
  write(scratch_.path() / "other.so",
        "\x7f"
        "ELF");
  EXPECT_EQ(polargrain("check case.yaml --set materials.sand.contact_library=other.so").status, 2);
}

TEST_F(LibraryTrust, SpecificationsOfPackingsAreHeldToTheSame) {
  write(scratch_.path() / "pack.yaml",
        "grains: 4\nsizes: {law: uniform, radius: [1 mm, 2 mm]}\ndensity: 2500\nthickness: 0.1 m\npressure: "
        "100 kPa\n"
        "friction: 0\nseed: 1\nscript: fake.in\ncontact_library: laws.so\n");
  const Outcome outcome = polargrain("pack pack.yaml -o packing.h5");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.errors, "pack.yaml:9: packing: " + kRefused);
  const Outcome settled = polargrain(
      "pack --settle grains.csv fake.in -o packing.h5 --set pressure=1e5 --set contact_library=laws.so");
  EXPECT_EQ(settled.status, 2);
  EXPECT_NE(settled.errors.find(kRefused), std::string::npos) << settled.errors;
}

TEST_F(LibraryTrust, OnlyLibrariesAreTaken) {
  const Outcome missing =
      polargrain("check case.yaml --trust-scripts --set materials.sand.contact_library=missing.so");
  EXPECT_EQ(missing.status, 2);
  EXPECT_NE(missing.errors.find("contact_library: there is no file 'missing.so'; give the path"),
            std::string::npos)
      << missing.errors;
  const Outcome script =
      polargrain("check case.yaml --trust-scripts --set materials.sand.contact_library=fake.in");
  EXPECT_EQ(script.status, 2);
  EXPECT_NE(script.errors.find("is no shared library; build one as docs/own_contact_law says"),
            std::string::npos)
      << script.errors;
}

// The coordinator's own workers have its word; the library is among the files that make the case what it is.
TEST_F(LibraryTrust, LocalWorkersTrustWhatTheCoordinatorDoesAndItsContentIsPartOfTheCase) {
  const Outcome run = polargrain("run case.yaml -o out -w 1 --quiet --trust-scripts");
  ASSERT_EQ(run.status, 0) << run.errors;
  EXPECT_NE(content(scratch_.path() / "out/summary.json").find("\"materials.sand.contact_library\": \""),
            std::string::npos);
  const Outcome distrusted = polargrain("verify out -w 1");
  EXPECT_EQ(distrusted.status, 2);
  EXPECT_EQ(distrusted.errors, "case.yaml:3: material 'sand': " + kRefused);
  const Outcome good = polargrain("verify out -w 1 --trust-scripts");
  EXPECT_EQ(good.status, 0) << good.out << good.errors;
  write(scratch_.path() / "laws.so",
        "\x7f"
        "ELF and so on, changed");
  const Outcome changed = polargrain("verify out -w 1 --trust-scripts");
  EXPECT_EQ(changed.status, 1);
  EXPECT_NE(
      changed.out.find("  DIFFERS   materials.sand.contact_library: the file 'laws.so' has another content"),
      std::string::npos)
      << changed.out;
  const Outcome resumed = polargrain("run case.yaml -o out -w 1 --quiet --trust-scripts --resume");
  EXPECT_EQ(resumed.status, 2);
  EXPECT_NE(resumed.errors.find("contact_library: the file 'laws.so' has another content"), std::string::npos)
      << resumed.errors;
}

// The coordinator trusts the library, the guest does not: it is the guest's machine.
TEST_F(LibraryTrust, AGuestRefusesOnItsOwn) {
  ASSERT_EQ(polargrain("keys keys").status, 0);
  const std::string url = "tcp://127.0.0.1:" + std::to_string(free_port());
  const std::string worker = "env -C '" + scratch_.path().string() + "' " POLARGRAIN " worker --connect " +
                             url + " --key keys/worker.key";
  const std::string run = "run case.yaml -w 0 --quiet --trust-scripts --listen " + url + " --keys keys -o ";
  {
    Beside first(worker + " >/dev/null 2>&1");
    Beside second(worker + " >/dev/null 2>&1");
    const Outcome outcome = polargrain(run + "refused");
    EXPECT_EQ(outcome.status, 1);
    EXPECT_NE(outcome.errors.find("this worker loads no library of contact laws ("), std::string::npos)
        << outcome.errors;
    EXPECT_NE(outcome.errors.find("start it with --trust-scripts when you trust it"), std::string::npos)
        << outcome.errors;
  }
  Beside trusting(worker + " --trust-scripts >/dev/null 2>&1");
  const Outcome outcome = polargrain(run + "taken");
  EXPECT_EQ(outcome.status, 0) << outcome.errors;
}

}  // namespace
}  // namespace polargrain::testing
