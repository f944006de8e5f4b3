// SPDX-License-Identifier: GPL-2.0-or-later
// The command of the biaxial study: going on, and runs that fail. Its results are held in study_long.cpp.
#include <gtest/gtest.h>

#include "tests/integration/study_run.hpp"

namespace {

using namespace polargrain::testing;

TEST(StudyCommand, GoesOnWhereItWasBrokenOffWithTheSameBytes) {
  const Scratch scratch("study_resumed");
  const std::string small = study("--only informed-2x4-lc15 --strain 0.004 -w 2");
  std::filesystem::create_directories(scratch.path() / "whole");
  const Outcome whole = run_in(scratch.path() / "whole", small);
  ASSERT_EQ(whole.status, 0) << whole.out << whole.errors;

  // A time limit, as soon as there is something to go on from: four steps of half a second and more follow.
  const Outcome stopped =
      run_in(scratch.path(), "{ " + small +
                                 " & until [ -e out/informed-2x4-lc15/checkpoint.h5 ]; do sleep 0.02; done; "
                                 "kill -TERM $!; wait $!; }");
  EXPECT_EQ(stopped.status, 3) << stopped.out << stopped.errors;
  EXPECT_NE(stopped.errors.find("the same command goes on"), std::string::npos) << stopped.errors;
  EXPECT_FALSE(std::filesystem::exists(scratch.path() / "out/table.md"));

  // The results may lie elsewhere by then.
  std::filesystem::create_directories(scratch.path() / "moved");
  std::filesystem::rename(scratch.path() / "out", scratch.path() / "moved/out");
  const Outcome rest = run_in(scratch.path() / "moved", small);
  ASSERT_EQ(rest.status, 0) << rest.out << rest.errors;
  const std::string log = content(scratch.path() / "moved/out/informed-2x4-lc15.log");
  EXPECT_NE(log.find("going on behind step"), std::string::npos) << log;
  for (const char* file : {"out/informed-2x4-lc15/history.csv", "out/informed-2x4-lc15/band.json",
                           "out/informed-2x4-lc15.samples.csv"}) {
    EXPECT_FALSE(content(scratch.path() / "whole" / file).empty()) << file;
    EXPECT_EQ(content(scratch.path() / "whole" / file), content(scratch.path() / "moved" / file)) << file;
  }
  EXPECT_NE(content(scratch.path() / "moved/out/table.md").find("| informed-2x4-lc15 |"), std::string::npos);
}

TEST(StudyCommand, NamesARunThatFailsWithItsLogAndCarriesOutTheOthers) {
  const Scratch scratch("study_broken");
  std::filesystem::create_directories(scratch.path() / "out/packings");
  write(scratch.path() / "out/packings/1600-seed1.h5", "no packing");
  const Outcome outcome = run_in(scratch.path(), study("--only grains-800-seed1,law-8x16-lc3 --jobs 1"));
  EXPECT_EQ(outcome.status, 1) << outcome.out;
  EXPECT_NE(outcome.errors.find("1 of 2 runs failed"), std::string::npos) << outcome.errors;
  EXPECT_NE(outcome.errors.find("grains-800-seed1: specimen.py ended with status 1; the end of "
                                "out/grains-800-seed1.log"),
            std::string::npos)
      << outcome.errors;
  EXPECT_NE(outcome.errors.find("1600-seed1.h5"), std::string::npos) << outcome.errors;
  const std::string table = content(scratch.path() / "out/table.md");
  EXPECT_NE(table.find("| law-8x16-lc3 |"), std::string::npos) << table;
  EXPECT_EQ(table.find("grains-800-seed1"), std::string::npos) << table;
  // The peak of docs/studies/biaxial_two_scale.md, 4.2494 at 1.9 %.
  EXPECT_NE(table.find("**4.25** (1.9 %)"), std::string::npos) << table;
}

TEST(StudyCommand, KnowsItsRuns) {
  const Scratch scratch("study_names");
  const Outcome unknown = run_in(scratch.path(), study("--only nothing"));
  EXPECT_EQ(unknown.status, 1);
  EXPECT_NE(unknown.errors.find("no run is called nothing"), std::string::npos) << unknown.errors;
  const Outcome list = run_in(scratch.path(), study("--list"));
  EXPECT_EQ(list.status, 0) << list.errors;
  EXPECT_EQ(std::count(list.out.begin(), list.out.end(), '\n'), 8) << list.out;  // the reduced size
}

}  // namespace
