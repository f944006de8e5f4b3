// SPDX-License-Identifier: GPL-2.0-or-later
// Cases of the model informed, with the fake engine in the workers.
#include <gtest/gtest.h>

#include "tests/integration/command.hpp"

namespace polargrain::testing {
namespace {

class InformedCaseTest : public ::testing::Test {
 protected:
  InformedCaseTest() : scratch_(::testing::UnitTest::GetInstance()->current_test_info()->name()) {
    write(directory() / "fake.in", "\n");
    write(directory() / "grains.csv",
          "# cell xx=0.1 xy=0 yx=0 yy=0.1 z=0.1\nid,x,y,r,mass,Izz\n1,0.05,0.05,0.04,1.0,8e-4\n");
    write(directory() / "case.yaml",
          "title: Compression of a fake\n"
          "mesh: {rectangle: {size: [0.4 m, 0.8 m], elements: [2, 4]}}\n"
          "materials:\n"
          "  sand:\n"
          "    model: informed\n"
          "    script: fake.in\n"
          "    packing: grains.csv\n"
          "    G: 40 MPa\n"
          "    Gc: 10 MPa\n"
          "    lc: 20 mm\n"
          "    informed:\n"
          "      nu: 0.25\n"
          "      update: frozen\n"
          "      mismatch_limit: 40 %\n"
          "      beyond_mismatch: tell\n"
          "      drift_shear: 0.02\n"
          "      cohesion: 50 Pa\n"
          "regions: {all: sand}\n"
          "boundary:\n"
          "  - {on: bottom, fix: [u2]}\n"
          "  - {on: bottom_left, fix: [u1, w]}\n"
          "  - {on: top, move: {u2: -0.8 mm}}\n"
          "  - {on: [left, right], pressure: 100 kPa}\n"
          "steps: {count: 4, tolerance: 1e-6}\n"
          "monitors: {top_force: {on: top, reaction: u2}}\n");
  }
  [[nodiscard]] const std::filesystem::path& directory() const { return scratch_.path(); }
  [[nodiscard]] Outcome polargrain(const std::string& arguments) const {
    return run_in(directory(), FAKE_POLARGRAIN " " + arguments);
  }
  Scratch scratch_;
};

TEST_F(InformedCaseTest, OneWordChangesTheScheme) {
  EXPECT_EQ(polargrain("check case.yaml").errors, "");
  EXPECT_EQ(polargrain("check case.yaml").status, 0);
  EXPECT_EQ(polargrain("check case.yaml --set materials.sand.model=cell").errors, "");
  EXPECT_EQ(polargrain("check case.yaml --set materials.sand.model=cell").status, 0);
  EXPECT_EQ(polargrain("check case.yaml --set materials.sand.informed.update=fixed_point").status, 0);
}

TEST_F(InformedCaseTest, EveryFaultOfItsKeysHasItsLine) {
  std::string text = content(directory() / "case.yaml");
  for (const auto& [good, bad] :
       std::vector<std::pair<std::string, std::string>>{{"nu: 0.25", "nu: 0.5"},
                                                        {"update: frozen", "update: froze"},
                                                        {"mismatch_limit: 40 %", "window: 4"},
                                                        {"beyond_mismatch: tell", "beyond_mismatch: stop"},
                                                        {"drift_shear: 0.02", "initial_friction: 5 deg"},
                                                        {"50 Pa", "0 Pa"}}) {
    text.replace(text.find(good), good.size(), bad);
  }
  write(directory() / "case.yaml", text);
  for (const char* model : {"informed", "cell"}) {
    const Outcome outcome = polargrain(std::string("check case.yaml --set materials.sand.model=") + model);
    EXPECT_EQ(outcome.status, 2);
    for (
        const char* fault :
        {"case.yaml:12: material 'sand': informed: nu: must be above -1 and below 0.5",
         "case.yaml:13: material 'sand': informed: update: expected one of frozen, fixed_point, found 'froze'; did "
         "you mean 'frozen'?",
         "case.yaml:14: material 'sand': informed: window: is no key any more, its value is always 5 increments; leave it out",
         "case.yaml:15: material 'sand': informed: beyond_mismatch: 'stop' is no choice any more; write tell",
         "case.yaml:16: material 'sand': informed: initial_friction: is no key any more, its value is always 5 deg; leave it out",
         "case.yaml:17: material 'sand': informed: cohesion: "}) {
      EXPECT_NE(outcome.errors.find(fault), std::string::npos) << fault << "\n" << outcome.errors;
    }
  }
}

TEST_F(InformedCaseTest, AnyNumberOfWorkersWritesTheSameHistory) {
  for (const char* update : {"frozen", "fixed_point"}) {
    const std::string options = std::string("--quiet --set materials.sand.informed.update=") + update;
    const Outcome one = polargrain("run case.yaml -o one -w 1 " + options);
    ASSERT_EQ(one.status, 0) << one.errors;
    const Outcome three = polargrain("run case.yaml -o three -w 3 " + options);
    ASSERT_EQ(three.status, 0) << three.errors;
    EXPECT_EQ(content(directory() / "one/history.csv"), content(directory() / "three/history.csv"));
    EXPECT_EQ(content(directory() / "one/fields/step-00004.vtu"),
              content(directory() / "three/fields/step-00004.vtu"));
    const std::string summary = content(directory() / "one/summary.json");
    for (const char* figure : {"stress_mismatch_mean", "stress_mismatch_percentile_95",
                               "stress_mismatch_largest", "dilatancy_limited"}) {
      EXPECT_NE(summary.find(figure), std::string::npos) << summary;
    }
  }
}

TEST_F(InformedCaseTest, APointTellsThatTheLawHasLeftItsCell) {
  write(directory() / "path.csv", "h22\n-1e-3\n-1e-3\n");
  const std::string left = "note: the law has left its cell at 1 of 1 points";
  const std::string point = "point case.yaml sand path.csv -o out.csv";
  const Outcome near = polargrain(point);
  EXPECT_EQ(near.status, 0) << near.errors;
  EXPECT_EQ(near.errors.find(left), std::string::npos) << near.errors;
  // A law ten times as soft as its cell.
  const Outcome far =
      polargrain(point + " --set materials.sand.informed.cohesion='1 MPa' --set materials.sand.G='4 MPa'");
  EXPECT_EQ(far.status, 0) << far.errors;
  const std::size_t told = far.errors.find(left);
  EXPECT_NE(told, std::string::npos) << far.errors;
  EXPECT_EQ(far.errors.rfind(left), told) << "once: " << far.errors;
}

TEST_F(InformedCaseTest, AKeyOfASchemeStandsInTheMapOfItsName) {
  for (const char* model : {"informed", "cell"}) {
    const Outcome outcome =
        polargrain(std::string("check case.yaml --set materials.sand.model=") + model +
                   " --set materials.sand.update=frozen --set materials.sand.tolerance='3 %'");
    EXPECT_EQ(outcome.status, 2);
    for (const char* fault :
         {"update: is a key of the scheme 'informed'; write informed: {update: frozen}",
          "tolerance: is a key of the scheme 'adaptive'; write adaptive: {tolerance: 3 %}"})
      EXPECT_NE(outcome.errors.find(fault), std::string::npos) << outcome.errors;
  }
  const Outcome unknown = polargrain("check case.yaml --set materials.sand.adaptive.tolerence='3 %'");
  EXPECT_EQ(unknown.status, 2);
  EXPECT_NE(unknown.errors.find("did you mean 'tolerance'"), std::string::npos) << unknown.errors;
}

TEST_F(InformedCaseTest, PointsThatGoByTheirCellsWriteTheSameWithAnyNumberOfWorkers) {
  for (const char* update : {"frozen", "fixed_point"}) {
    const std::string options =
        std::string("--set materials.sand.informed.update=") + update +
        // A law that does not yield, and softer than it is ever taken to be (unloading.hpp).
        " --set materials.sand.informed.cohesion='1 MPa' --set materials.sand.G='4 MPa'"
        " --set materials.sand.informed.beyond_mismatch=cell --set materials.sand.informed.mismatch_limit='1 %'";
    const Outcome one = polargrain("run case.yaml -o one -w 1 " + options);
    ASSERT_EQ(one.status, 0) << one.errors;
    EXPECT_NE((one.out + one.errors).find("go by the stress of their cells"), std::string::npos)
        << one.out << one.errors;
    const Outcome three = polargrain("run case.yaml -o three -w 3 " + options);
    ASSERT_EQ(three.status, 0) << three.errors;
    for (const char* file : {"history.csv", "fields/step-00004.vtu", "fields/points-00004.vtu"})
      EXPECT_TRUE(content(directory() / "one" / file) == content(directory() / "three" / file)) << file;
    EXPECT_NE(content(directory() / "one/fields/points-00004.vtu").find("stress_of_cell"), std::string::npos);
    EXPECT_NE(content(directory() / "one/summary.json").find("\"stress_of_cell\": 1.0"), std::string::npos)
        << content(directory() / "one/summary.json");
  }
}

TEST_F(InformedCaseTest, WhatFollowsAMismatchIsCheckedBeforeTheRun) {
  const std::string check = "check case.yaml --set materials.sand.informed.";
  EXPECT_EQ(polargrain(check + "beyond_mismatch=cell").status, 0);
  const Outcome word = polargrain(check + "beyond_mismatch=cells");
  EXPECT_EQ(word.status, 2);
  EXPECT_NE(word.errors.find("beyond_mismatch: expected one of tell, cell, found 'cells'"), std::string::npos)
      << word.errors;
  for (const char* limit : {"-10 %", "0"}) {
    const Outcome outcome = polargrain(check + "mismatch_limit='" + limit + "'");
    EXPECT_EQ(outcome.status, 2);
    EXPECT_NE(outcome.errors.find("mismatch_limit: "), std::string::npos) << outcome.errors;
  }
}

TEST_F(InformedCaseTest, APatchOfARectangleIsARegion) {
  std::string text = content(directory() / "case.yaml");
  const std::string all = "regions: {all: sand}";
  text.replace(text.find(all), all.size(), "regions: {patch: sand, rest: sand}");
  write(directory() / "case.yaml", text);
  EXPECT_EQ(polargrain("check case.yaml --set mesh.rectangle.patch='[0.2 m, 0.2 m]'").errors, "");
  EXPECT_EQ(polargrain("check case.yaml --set mesh.rectangle.patch='[0.2 m, 9 m]'").errors, "");
  EXPECT_EQ(
      polargrain(
          "check case.yaml --set mesh.rectangle.elements='[3, 6]' --set mesh.rectangle.patch='[133.3 mm, 0.4 m]'")
          .errors,
      "");
  // The centres of a second column lie at 0.3 m: it would be 0.4 m wide.
  const Outcome wider = polargrain("check case.yaml --set mesh.rectangle.patch='[0.31 m, 0.2 m]'");
  EXPECT_EQ(wider.status, 2);
  EXPECT_NE(wider.errors.find(
                "patch: its size number 1, 0.31 m, ends within an element of 0.2 m; give 0.2 m or 0.4 m, or "
                "change the number of elements"),
            std::string::npos)
      << wider.errors;
  const Outcome none = polargrain("check case.yaml --set mesh.rectangle.patch='[0.01 m, 0.01 m]'");
  EXPECT_EQ(none.status, 2);
  EXPECT_NE(none.errors.find("patch: holds no element, or all of them"), std::string::npos) << none.errors;
}

}  // namespace
}  // namespace polargrain::testing
