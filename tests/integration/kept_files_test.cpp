// SPDX-License-Identifier: GPL-2.0-or-later
// No command writes over a file that it reads: what a user types by mistake costs no work.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <unistd.h>

#include <future>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tests/integration/command.hpp"
#include "tests/support/eventually.hpp"

namespace polargrain::testing {
namespace {

class KeptFiles : public ::testing::Test {
 protected:
  KeptFiles() : scratch_(::testing::UnitTest::GetInstance()->current_test_info()->name()) {
    write(at("case.yaml"),
          "title: a block\n"
          "mesh: {rectangle: {size: [1 m, 1 m], elements: [1, 1]}}\n"
          "materials:\n"
          "  soil: {model: elastoplastic, E: 20 MPa, nu: 0.3, Gc: 10 MPa, lc: 5 mm, friction_angle: 30 deg,\n"
          "         dilatancy_angle: 0 deg, cohesion: 10 kPa}\n"
          "regions: {all: soil}\n"
          "boundary:\n"
          "  - {on: bottom, fix: [u1, u2]}\n"
          "  - {on: top, pressure: 1 kPa}\n"
          "steps: {count: 1}\n"
          "output: {every: 1}\n");
    write(at("path.csv"), "h22\n-1e-5\n");
    write(at("cell.in"), "young 100e6\n");
    write(at("packing.yaml"),
          "grains: 60\nsizes: {law: uniform, radius: [3 mm, 7 mm]}\ndensity: 2650\nthickness: 100 mm\n"
          "script: cell.in\npressure: 100 kPa\nfriction: 0\nseed: 5\n");
    write(at("grains.csv"), "# cell xx=1 xy=0 yx=0 yy=1 z=0.1\nid,x,y,r,mass,Izz\n1,0.5,0.5,0.4,1,0.08\n");
  }
  [[nodiscard]] std::filesystem::path at(const std::string& name) const { return scratch_.path() / name; }
  [[nodiscard]] Outcome polargrain(const std::string& arguments) const {
    return run_in(scratch_.path(), FAKE_POLARGRAIN " " + arguments);
  }
  /// Every file below the folder of the test with its content.
  [[nodiscard]] std::map<std::string, std::string> files() const {
    std::map<std::string, std::string> contents;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(scratch_.path()))
      if (entry.is_regular_file()) contents[entry.path().string()] = content(entry.path());
    return contents;
  }
  /// The command is refused with these words among others, and no file is touched.
  void expect_refused(const std::string& arguments, const std::string& words) const {
    const auto before = files();
    const Outcome outcome = polargrain(arguments);
    EXPECT_EQ(outcome.status, 2) << arguments << "\n" << outcome.errors;
    EXPECT_NE(outcome.errors.find(words), std::string::npos) << arguments << "\n" << outcome.errors;
    EXPECT_TRUE(files() == before) << arguments << " has changed a file";
  }
  Scratch scratch_;
};

TEST_F(KeptFiles, ATableIsNotWrittenOverTheCase) {
  expect_refused("safety case.yaml -o case.yaml", "-o case.yaml: the command reads this file");
  expect_refused("safety case.yaml -o .", "-o .: is a directory");
  expect_refused("point case.yaml soil path.csv -o case.yaml", "-o case.yaml: the command reads this file");
  expect_refused("point case.yaml soil path.csv -o ./path.csv", "-o ./path.csv: the command reads this file");
  std::filesystem::create_symlink("case.yaml", at("link.csv"));
  expect_refused("point case.yaml soil path.csv -o link.csv", "-o link.csv: the command reads case.yaml");
  expect_refused("check case.yaml --picture case.yaml", "--picture case.yaml: the command reads this file");
}

TEST_F(KeptFiles, ATableTakesThePlaceOfAnOlderOneAlone) {
  for (const std::string command : {"point case.yaml soil path.csv", "safety case.yaml"}) {
    write(at("out.csv"), "day,reading\n1,2\n");
    expect_refused(
        command + " -o out.csv",
        "-o out.csv: this file is there and is no table of this command; name another file to write");
    std::filesystem::remove(at("out.csv"));
    for (int times = 0; times < 2; ++times) {
      const Outcome outcome = polargrain(command + " -o out.csv");
      EXPECT_EQ(outcome.status, 0) << "an older table is replaced: " << outcome.errors;
    }
    EXPECT_EQ(content(at("out.csv")).find("day"), std::string::npos);
  }
}

TEST_F(KeptFiles, APackingIsNotWrittenOverWhatItIsMadeFrom) {
  ASSERT_EQ(polargrain("pack packing.yaml -o packing.h5 --quiet").status, 0);
  expect_refused(
      "pack --export packing.yaml packing.h5",
      "--export packing.yaml: this file is there and is no exported packing; name another file to write. "
      "The packing comes first: polargrain pack packing.h5 --export FILE.data");
  expect_refused("pack packing.h5 --export packing.h5", "the command reads this file");
  expect_refused("pack --settle packing.h5 cell.in -o packing.h5 --set pressure=100e3",
                 "-o packing.h5: the command reads this file");
  for (int times = 0; times < 2; ++times)
    EXPECT_EQ(polargrain("pack packing.h5 --export packing.data").status, 0) << "an older export is replaced";
}

TEST_F(KeptFiles, APackingTakesThePlaceOfAnOlderOneAlone) {
  write(at("images.h5"), "\x89HDF\r\n\x1a\nimages of a test");
  expect_refused("pack packing.yaml -o images.h5 --quiet",
                 "-o images.h5: this file is there and is no packing; name another file to write, or remove");
  for (int times = 0; times < 2; ++times)
    EXPECT_EQ(polargrain("pack packing.yaml -o packing.h5 --quiet").status, 0)
        << "an older packing is replaced";
}

TEST_F(KeptFiles, APageIsNotWrittenOverAResult) {
  ASSERT_EQ(polargrain("run case.yaml -o out --quiet").status, 0);
  for (const std::string name : {"history.csv", "summary.json", "fields/page.html"})
    expect_refused("report out -o out/" + name,
                   "-o out/" + name + ": this is the place of a result of the run");
  expect_refused("report out -o case.yaml", "the command reads ");
  write(at("other.yaml"), "title: another case\n");
  expect_refused("report out -o other.yaml", "of a kind that is written by hand");
  for (int times = 0; times < 2; ++times)
    EXPECT_EQ(polargrain("report out -o out/page.html").status, 0) << "an older page is replaced";
  EXPECT_EQ(polargrain("report out").status, 0);
}

TEST_F(KeptFiles, APageTakesThePlaceOfPagesAlone) {
  ASSERT_EQ(polargrain("run case.yaml -o out --quiet").status, 0);
  write(at("notes.html"), "<!DOCTYPE html>\n<html><body>my notes</body></html>\n");
  write(at("x"), "1");
  const std::string refusal = ": this file is there and is no page of polargrain; name another file to write";
  for (const std::string name : {"path.csv", "notes.html", "x"}) {
    expect_refused("report out -o " + name, "-o " + name + refusal);
    expect_refused("check case.yaml --picture " + name, "--picture " + name + refusal);
  }
  expect_refused("element --test biaxial --pressure 100kPa grains.csv cell.in -o notes",
                 "-o notes.html" + refusal);
  write(at("empty"), "");
  for (const std::string name : {"new.html", "empty"})
    for (int times = 0; times < 2; ++times) {
      EXPECT_EQ(polargrain("report out -o " + name).status, 0) << name;
      EXPECT_EQ(polargrain("check case.yaml --picture " + name).status, 0) << name;
    }
}

TEST_F(KeptFiles, TestsAreNotWrittenOverTheirPackings) {
  expect_refused("element --test biaxial --pressure 100kPa grains.csv cell.in -o grains",
                 "-o grains.csv: the command reads this file");
}

/// The remedy where a command writes files of usual names into a folder.
const std::string kOtherFolder = "; name another folder with -o, or remove it";

TEST_F(KeptFiles, TablesOfTestsTakeThePlaceOfSuchTablesAlone) {
  const std::string packing = POLARGRAIN_SOURCE_DIRECTORY "/cases/biaxial/packing400.csv";
  const std::string test =
      "element --test biaxial --pressure 100kPa --set axial_strain=0.1% --set rows=2 --quiet " + packing +
      " cell.in -o notes";
  for (const std::string name : {"notes.csv", "notes_mean.csv", "notes_envelope.csv"}) {
    write(at(name), "day,reading\n1,2\n");
    expect_refused(
        test,
        "-o " + name + ": this file is there and is no table of this command; name another file to write");
    std::filesystem::remove(at(name));
  }
  for (int times = 0; times < 2; ++times)
    EXPECT_EQ(polargrain(test).status, 0) << "an older table is replaced";
}

TEST_F(KeptFiles, ABenchTakesThePlaceOfAnOlderOneAlone) {
  std::string text = content(at("case.yaml"));
  write(at("case.yaml"),
        text + "monitors: {top: {on: top, displacement: u2}, force: {on: bottom, reaction: u2}}\n");
  for (const auto& [name, what] :
       {std::pair{"bench.html", "page of polargrain"}, {"bench.csv", "table of bench"}}) {
    std::filesystem::create_directories(at("out"));
    write(at(std::string("out/") + name), "my notes\n");
    expect_refused("bench case.yaml --quick --x top --y force -o out",
                   "out/" + std::string(name) + ": this file is there and is no " + what + kOtherFolder);
    std::filesystem::remove_all(at("out"));
  }
}

TEST_F(KeptFiles, ACalibrationTakesThePlaceOfAnOlderOneAlone) {
  write(at("soft.in"), "variable stiffness index 1e8\nyoung ${stiffness}\n");
  write(at("lab.csv"), "axial_strain,s22_Pa\n0,-100e3\n0.01,-900e3\n");
  write(
      at("spec.yaml"),
      "packing: grains.csv\nscript: soft.in\nparameters:\n  stiffness: {bounds: [5e7, 5e8], start: 9e7}\ntests:\n"
      "  one: {test: biaxial, pressure: 100 kPa, axial_strain: 1 %, rows: 5}\n"
      "targets:\n  - {column: s22_Pa, error: 500}\n");
  std::filesystem::create_directories(at("fit"));
  for (const auto& [name, what] : {std::pair{"calibration.html", "page of polargrain"},
                                   {"parameters.csv", "table of this command"},
                                   {"profile.csv", "table of this command"},
                                   {"record.csv", "table of this command"},
                                   {"best.in", "script of this command"}}) {
    write(at(std::string("fit/") + name), "my notes\n");
    expect_refused("calibrate lab.csv spec.yaml -o fit",
                   "fit/" + std::string(name) + ": this file is there and is no " + what + kOtherFolder);
    std::filesystem::remove(at(std::string("fit/") + name));
  }
}

TEST_F(KeptFiles, ACalibrationIsNotWrittenOverItsScript) {
  write(at("best.in"), "variable stiffness index 1e8\nyoung ${stiffness}\n");
  write(at("lab.csv"), "axial_strain,s22_Pa\n0,-100e3\n0.01,-900e3\n");
  write(
      at("spec.yaml"),
      "packing: grains.csv\nscript: best.in\nparameters:\n  stiffness: {bounds: [5e7, 5e8], start: 9e7}\ntests:\n"
      "  one: {test: biaxial, pressure: 100 kPa, axial_strain: 1 %, rows: 5}\n"
      "targets:\n  - {column: s22_Pa, error: 500}\n");
  expect_refused("calibrate lab.csv spec.yaml -o .", "best.in: the command reads ");
}

TEST_F(KeptFiles, AReplayIsNotWrittenIntoAFolderOfTheUsersOwn) {
  expect_refused("point case.yaml soil path.csv --replay .",
                 "--replay .: the folder has files in it and no earlier replay; name a new one");
}

TEST_F(KeptFiles, ARunDoesNotEraseAFileOfItsCase) {
  ASSERT_EQ(polargrain("run case.yaml -o out --quiet").status, 0);
  std::filesystem::create_directories(at("out/profiles"));
  write(at("out/profiles/quake.csv"), "time,acceleration\n0,0\n1,0\n");
  std::string text = content(at("case.yaml"));
  text.replace(text.find("a block"), 7, "out/profiles/quake.csv");  // any value that names a file
  write(at("case.yaml"), text);
  expect_refused("run case.yaml -o out",
                 "out/profiles/quake.csv lies in the result directory of this run, which would erase it");
}

TEST_F(KeptFiles, ARunErasesFilesOfAFormerOneAlone) {
  ASSERT_EQ(polargrain("run case.yaml -o out --quiet").status, 0);
  const std::vector<std::string> own{"fields/view.pvsm",
                                     "fields/view/step-00001.vtu",
                                     "fields/step-00001 copy.vtu",
                                     "profiles/lab-1.csv",
                                     "profiles/view/lab-00001.csv",
                                     "grains/user.txt",
                                     "grains/point-3/view.pvsm",
                                     "logs/user.txt",
                                     "cell_paths/user.txt",
                                     "replay/user.txt",
                                     "other/fields/step-00001.vtu",
                                     "report.html"};
  const std::vector<std::string> former{"fields/step-00007.vtu",
                                        "fields/points-123456.vtu",
                                        "fields/structures-00007.csv",
                                        "fields/step-00008.vtu.part",
                                        "profiles/axis-2-00007.csv",
                                        "grains/point-3.pvd",
                                        "grains/point-3/step-00007.vtu",
                                        "grains/point-4/step-00007.vtu",
                                        "logs/worker-12.log",
                                        "cell_paths/step-00007.h5",
                                        "replay/in.replay"};
  for (const auto* const files : {&own, &former})
    for (const std::string& name : *files) {
      std::filesystem::create_directories(at("out/" + name).parent_path());
      write(at("out/" + name), "mine: " + name);
    }
  const Outcome outcome = polargrain("run case.yaml -o out --quiet");
  EXPECT_EQ(outcome.status, 0) << outcome.errors;
  for (const std::string& name : own) EXPECT_EQ(content(at("out/" + name)), "mine: " + name);
  for (const std::string& name : former) EXPECT_FALSE(std::filesystem::exists(at("out/" + name))) << name;
  EXPECT_FALSE(std::filesystem::exists(at("out/grains/point-4"))) << "an empty folder of a run goes";
  EXPECT_TRUE(std::filesystem::exists(at("out/fields/step-00001.vtu")));
}

// Two runs that begin together: the one that comes later waits for the other, and would then erase what that has written.
TEST_F(KeptFiles, ARunDoesNotReplaceOneThatHasWorkedBesideIt) {
  ASSERT_EQ(polargrain("run case.yaml -o out --quiet").status, 0);
  const std::filesystem::path out = std::filesystem::canonical(at("out"));
  const int other = open(out.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  ASSERT_EQ(flock(other, LOCK_EX), 0);
  auto run = std::async(std::launch::async, [this] {
    return run_in(scratch_.path(), "echo $$ > pid.part && mv pid.part pid && exec " FAKE_POLARGRAIN
                                   " run case.yaml -o out --quiet");
  });
  const auto waits_for_its_turn = [&] {
    std::error_code error;  // of a process that does not run yet, or no more
    const std::string process = content(at("pid"));
    const std::filesystem::path files = "/proc/" + process.substr(0, process.find('\n')) + "/fd";
    for (auto file = std::filesystem::directory_iterator(files, error);
         file != std::filesystem::directory_iterator(); file.increment(error))
      if (std::filesystem::read_symlink(file->path(), error) == out) return true;
    return false;
  };
  EXPECT_TRUE(eventually(waits_for_its_turn));
  write(at("out/run.log"), "of the other run\n");
  close(other);
  const Outcome outcome = run.get();
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.errors.find("out: another run has been at work in this directory since this one began"),
            std::string::npos)
      << outcome.errors;
  EXPECT_EQ(content(at("out/run.log")), "of the other run\n");
  EXPECT_EQ(polargrain("run case.yaml -o out --quiet").status, 0) << "a run of before is replaced";
}

TEST_F(KeptFiles, ARunErasesThePageOfAFormerOne) {
  ASSERT_EQ(polargrain("run case.yaml -o out --quiet").status, 0);
  ASSERT_EQ(polargrain("report out").status, 0);
  std::filesystem::remove_all(at("out/fields"));
  std::filesystem::create_directories(at("large"));
  write(at("large/step-00007.vtu"), "fields on another disk");
  std::filesystem::create_directory_symlink("../large", at("out/fields"));
  ASSERT_EQ(polargrain("run case.yaml -o out --quiet").status, 0);
  EXPECT_FALSE(std::filesystem::exists(at("out/report.html")));
  EXPECT_EQ(content(at("large/step-00007.vtu")), "fields on another disk");
}

}  // namespace
}  // namespace polargrain::testing
