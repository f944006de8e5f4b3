// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "tests/integration/command.hpp"

namespace polargrain::testing {

/// Whole runs of the program with the fake engine: an undisturbed one to compare with, in a directory of the test's own.
class FakeCaseTest : public ::testing::Test {
 protected:
  FakeCaseTest() : scratch_(::testing::UnitTest::GetInstance()->current_test_info()->name()) {
    write(scratch_.path() / "grains.csv",
          "# cell xx=0.1 xy=0 yx=0 yy=0.1 z=0.1\nid,x,y,r,mass,Izz\n1,0.05,0.05,0.04,1.0,8e-4\n");
    write(scratch_.path() / "case.yaml",
          "title: Compression of a fake\n"
          "mesh: {rectangle: {size: [0.4 m, 0.8 m], elements: [2, 4]}}\n"
          "materials:\n"
          "  sand: {model: cell, script: fake.in, packing: grains.csv, G: 40 MPa, Gc: 10 MPa, lc: 20 mm}\n"
          "regions: {all: sand}\n"
          "boundary:\n"
          "  - {on: bottom, fix: [u2]}\n"
          "  - {on: bottom_left, fix: [u1, w]}\n"
          "  - {on: top, move: {u2: -8 mm}}\n"
          "  - {on: [left, right], pressure: 100 kPa}\n"
          "steps: {count: 30, tolerance: 1e-10}\n"
          "workers: {silence: 2 s}\n"
          "monitors: {top_force: {on: top, reaction: u2}}\n");
    write(scratch_.path() / "fake.in", "\n");
  }

  [[nodiscard]] static std::string command(int steps, const std::string& settings = "") {
    return FAKE_POLARGRAIN " run case.yaml --quiet --set steps.count=" + std::to_string(steps) + settings;
  }
  /// Runs the case undisturbed. @returns the command that runs it slowly, to be disturbed
  [[nodiscard]] std::string prepare(int steps, const std::string& settings = "") {
    for (const char* const former : {"quiet", "disturbed"})
      std::filesystem::remove_all(scratch_.path() / former);
    write(scratch_.path() / "fake.in", "\n");
    const Outcome quiet = run_in(scratch_.path(), command(steps, settings) + " -o quiet -w 1");
    EXPECT_EQ(quiet.status, 0) << quiet.errors;
    write(scratch_.path() / "fake.in", "sleep_milliseconds 10\n");  // time to be disturbed in
    return "env -C '" + scratch_.path().string() + "' " + command(steps, settings) + " -o disturbed -w 3";
  }
  [[nodiscard]] std::filesystem::path disturbed() const { return scratch_.path() / "disturbed"; }
  [[nodiscard]] std::string result(const std::string& file) const { return content(scratch_.path() / file); }

  Scratch scratch_;
};

}  // namespace polargrain::testing
