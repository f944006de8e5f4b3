// SPDX-License-Identifier: GPL-2.0-or-later
// Scripts of cells that can do more than set up a cell: found before a run, refused by workers on their own.
#include <gtest/gtest.h>

#include "tests/faults/checkpoint_runs.hpp"
#include "tests/support/free_port.hpp"

namespace polargrain::testing {
namespace {

class ScriptTrust : public ::testing::Test {
 protected:
  ScriptTrust()
      : scratch_(std::string("trust_") + ::testing::UnitTest::GetInstance()->current_test_info()->name()) {
    folder_ = scratch_.path() / "case";
    std::filesystem::create_directories(folder_);
    write(folder_ / "good.in", "young 1e8\n");
    write(folder_ / "bad.in", "young 1e8\nshell touch was_here\n");
    write(scratch_.path() / "outside.in", "young 2e8\n");
    write(scratch_.path() / "grains.csv",
          "# cell xx=0.1 xy=0 yx=0 yy=0.1 z=0.1\nid,x,y,r,mass,Izz\n1,0.05,0.05,0.04,1.0,8e-4\n");
    set_script("good.in");
  }
  void set_script(const std::string& script) const {
    write(folder_ / "case.yaml",
          "title: Who may run what\n"
          "mesh: {rectangle: {size: [0.4 m, 0.8 m], elements: [1, 1]}}\n"
          "materials:\n"
          "  sand: {model: cell, packing: ../grains.csv, G: 40 MPa, Gc: 10 MPa, lc: 20 mm,\n"
          "         script: " +
              script +
              "}\n"
              "regions: {all: sand}\n"
              "boundary:\n"
              "  - {on: bottom, fix: [u1, u2]}\n"
              "  - {on: top, fix: [u1], move: {u2: -8 mm}}\n"
              "  - {on: [left, right], pressure: 100 kPa}\n"
              "steps: {count: 1, tolerance: 1e-8}\n");
  }
  [[nodiscard]] Outcome polargrain(const std::string& arguments) const {
    return run_in(folder_, POLARGRAIN " " + arguments);
  }
  Scratch scratch_;
  std::filesystem::path folder_;
};

TEST_F(ScriptTrust, CheckFindsWithFileAndLineWhatARunWouldDo) {
  set_script("bad.in");
  write(folder_ / "path.csv", "h22\n-1e-4\n");
  for (const char* const command :
       {"check case.yaml", "run case.yaml -o out", "point case.yaml sand path.csv"}) {
    const Outcome outcome = polargrain(command);
    EXPECT_EQ(outcome.status, 2);
    EXPECT_EQ(outcome.errors,
              "bad.in:2: the command 'shell' is not among those that set up a cell; remove it, or give "
              "--trust-scripts if you have read this script\n");
  }
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
  // The script is run then, to see what the packing resists with; the simulated engine does not know the command.
  EXPECT_NE(polargrain("check case.yaml --trust-scripts").status, 2);
}

TEST_F(ScriptTrust, IncludedFilesCountAndHaveTheirOwnLines) {
  write(folder_ / "top.in", "young 1e8\ninclude parts/part.in\nlog x\n");
  std::filesystem::create_directories(folder_ / "parts");
  write(folder_ / "parts/part.in", "young 1e8\n\ninclude inner.in\n");
  write(folder_ / "parts/inner.in", "shell touch was_here\n");
  set_script("top.in");
  const Outcome outcome = polargrain("check case.yaml");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.errors.find("parts/inner.in:1: the command 'shell'"), std::string::npos)
      << outcome.errors;
  EXPECT_NE(outcome.errors.find("top.in:3: the command 'log'"), std::string::npos) << outcome.errors;
  // An included file is run, and belongs to the case: a change of it is another case.
  write(folder_ / "top.in", "include parts/part.in\n");
  write(folder_ / "parts/inner.in", "young 1e8\n");
  EXPECT_EQ(polargrain("run case.yaml -o out -w 1 --quiet").status, 0);
  write(folder_ / "parts/inner.in", "young 2e8\n");
  const Outcome resumed = polargrain("run case.yaml -o out -w 1 --quiet --resume");
  EXPECT_EQ(resumed.status, 2);
  EXPECT_NE(resumed.errors.find("materials.sand.script: the file 'top.in' has another content"),
            std::string::npos)
      << resumed.errors;
  // One that includes itself ends somewhere.
  write(folder_ / "parts/inner.in", "include inner.in\n");
  EXPECT_EQ(polargrain("check case.yaml").status, 2);
}

TEST_F(ScriptTrust, ScriptsFromOutsideTheFolderNeedTheWord) {
  std::filesystem::create_symlink(scratch_.path() / "outside.in", folder_ / "link.in");
  for (const char* const script : {"../outside.in", "link.in"}) {
    set_script(script);
    const Outcome outcome = polargrain("check case.yaml");
    EXPECT_EQ(outcome.status, 2);
    EXPECT_NE(outcome.errors.find("lies outside the folder of the case, and a script is a program"),
              std::string::npos)
        << outcome.errors;
    EXPECT_EQ(polargrain("check case.yaml --trust-scripts").status, 0);
  }
  write(folder_ / "top.in", "young 1e8\ninclude ../outside.in\n");
  set_script("top.in");
  EXPECT_EQ(polargrain("check case.yaml").status, 2);
  EXPECT_EQ(polargrain("check case.yaml --trust-scripts").status, 0);
  // The user's own words, and what the program brings along, need none.
  EXPECT_EQ(polargrain("check case.yaml --set materials.sand.script=../outside.in").status, 0);
  // (the simulated engine knows none of the commands of the latter)
  EXPECT_NE(polargrain("check case.yaml --set materials.sand.script=cells/hooke_radii.in").status, 2);
}

TEST_F(ScriptTrust, WhatIsNoScriptIsNotRepeated) {
  write(scratch_.path() / "secret", "root:$6$hidden:19000:0:99999:7:::\nhidden too\n");
  set_script("../secret");
  for (const char* const trust : {"", " --trust-scripts", " --set materials.sand.script=../secret"}) {
    const Outcome outcome = polargrain(std::string("check case.yaml") + trust);
    EXPECT_EQ(outcome.status, 2);
    EXPECT_EQ((outcome.out + outcome.errors).find("hidden"), std::string::npos) << outcome.errors;
  }
}

TEST_F(ScriptTrust, SpecificationsOfPackingsAreHeldToTheSame) {
  const std::string head =
      "grains: 4\nsizes: {law: uniform, radius: [1 mm, 2 mm]}\ndensity: 2500\nthickness: 0.1 m\npressure: "
      "100 kPa\n"
      "friction: 0\nseed: 1\nscript: ";
  write(folder_ / "pack.yaml", head + "bad.in\n");
  const Outcome outcome = polargrain("pack pack.yaml -o packing.h5");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.errors.find("bad.in:2: the command 'shell'"), std::string::npos) << outcome.errors;
  write(folder_ / "pack.yaml", head + "../outside.in\n");
  EXPECT_EQ(polargrain("pack pack.yaml -o packing.h5").status, 2);
  const Outcome settled = polargrain("pack --settle ../grains.csv bad.in -o packing.h5 --set pressure=1e5");
  EXPECT_EQ(settled.status, 2);
  EXPECT_NE(settled.errors.find("bad.in:2: the command 'shell'"), std::string::npos) << settled.errors;
}

// The coordinator trusts the script, the guest does not: it is the guest's machine.
TEST_F(ScriptTrust, AGuestRefusesOnItsOwn) {
  set_script("bad.in");
  ASSERT_EQ(polargrain("keys keys").status, 0);
  const std::string url = "tcp://127.0.0.1:" + std::to_string(free_port());
  Beside guest("env -C '" + folder_.string() + "' " POLARGRAIN " worker --connect " + url +
               " --key keys/worker.key >/dev/null 2>&1");
  Beside second("env -C '" + folder_.string() + "' " POLARGRAIN " worker --connect " + url +
                " --key keys/worker.key >/dev/null 2>&1");
  const Outcome outcome =
      polargrain("run case.yaml -o out -w 0 --quiet --trust-scripts --listen " + url + " --keys keys");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.errors.find("this worker runs no such script (bad.in:2: the command 'shell'"),
            std::string::npos)
      << outcome.errors;
  EXPECT_NE(outcome.errors.find("start it with --trust-scripts"), std::string::npos) << outcome.errors;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "was_here"));
}

}  // namespace
}  // namespace polargrain::testing
