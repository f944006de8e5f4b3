// SPDX-License-Identifier: GPL-2.0-or-later
// Disks that are full or may not be written to.
#include <gtest/gtest.h>
#include <sys/mount.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "app/commands/csv_file.hpp"
#include "common/error.hpp"
#include "coupler/checkpoint/checkpoint.hpp"
#include "fem/output/write_file.hpp"
#include "tests/integration/command.hpp"

namespace polargrain::testing {
namespace {

/// A small disk of its own; needs the right to mount.
class SmallDisk {
 public:
  SmallDisk(std::filesystem::path place, const std::string& size) : place_(std::move(place)) {
    std::filesystem::create_directories(place_);
    mounted_ = mount("tmpfs", place_.c_str(), "tmpfs", 0, ("size=" + size).c_str()) == 0;
  }
  ~SmallDisk() {
    if (mounted_) umount2(place_.c_str(), MNT_DETACH);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;
  [[nodiscard]] bool mounted() const { return mounted_; }
  void make_read_only() const { mount("tmpfs", place_.c_str(), "tmpfs", MS_REMOUNT | MS_RDONLY, nullptr); }
  void make_larger() const { mount("tmpfs", place_.c_str(), "tmpfs", MS_REMOUNT, "size=20M"); }
  /// Leaves so many bytes, in whole pages.
  void fill_up_to(std::size_t bytes_left) const {
    const auto space = std::filesystem::space(place_).available;
    if (space > bytes_left) write(place_ / "filler", std::string(space - bytes_left, 'x'));
  }

 private:
  std::filesystem::path place_;
  bool mounted_ = false;
};

#define MOUNT_OR_SKIP(disk) \
  if (!(disk).mounted()) GTEST_SKIP() << "not allowed to mount a small disk: " << std::strerror(errno)

class Disk : public ::testing::Test {
 protected:
  Disk() : scratch_("checkpoint_disk") {
    write(scratch_.path() / "case.yaml",
          "title: A run on a small disk\n"
          "mesh: {rectangle: {size: [0.4 m, 0.8 m], elements: [4, 8]}}\n"
          "materials: {sand: {model: elastic, E: 100 MPa, nu: 0.25, Gc: 10 MPa, lc: 20 mm, "
          "confining: 100 kPa}}\n"
          "regions: {all: sand}\n"
          "boundary:\n"
          "  - {on: bottom, fix: [u1, u2]}\n"
          "  - {on: top, fix: [u1], move: {u2: -8 mm}}\n"
          "  - {on: [left, right], pressure: 100 kPa}\n"
          "steps: {count: 20, tolerance: 1e-8}\n"
          "monitors: {top_force: {on: top, reaction: u2}}\n");
  }
  [[nodiscard]] Outcome polargrain(const std::string& arguments) const {
    return run_in(scratch_.path(), POLARGRAIN " " + arguments);
  }
  [[nodiscard]] std::string result(const std::string& file) const { return content(scratch_.path() / file); }
  Scratch scratch_;
};

TEST_F(Disk, FullForTheOutputEndsTheRunAndLosesNothing) {
  ASSERT_EQ(polargrain("run case.yaml -o whole --quiet").status, 0);
  // Room for the fields of some steps, not of all.
  const SmallDisk disk(scratch_.path() / "small", "400k");
  MOUNT_OR_SKIP(disk);
  const Outcome full = polargrain("run case.yaml -o small/out --quiet --checkpoint-minutes 0");
  EXPECT_EQ(full.status, 1);
  EXPECT_NE(full.errors.find("cannot be written: No space left on device"), std::string::npos) << full.errors;
  EXPECT_NE(full.errors.find("to go on:\n  polargrain run case.yaml -o small/out --resume"),
            std::string::npos)
      << full.errors;
  // The file is whole: rows of the undisturbed run.
  const std::string rows = result("small/out/history.csv");
  EXPECT_GT(std::count(rows.begin(), rows.end(), '\n'), 2);
  EXPECT_EQ(result("whole/history.csv").substr(0, rows.size()), rows);
  EXPECT_EQ(rows.back(), '\n');
  disk.make_larger();
  const Outcome rest = polargrain("run case.yaml -o small/out --quiet --resume");
  EXPECT_EQ(rest.status, 0) << rest.errors;
  EXPECT_TRUE(result("small/out/history.csv") == result("whole/history.csv"));
  EXPECT_TRUE(result("small/out/fields.pvd") == result("whole/fields.pvd"));
  for (int step = 0; step <= 20; ++step) {
    const std::string file =
        "/fields/step-000" + std::string(step < 10 ? "0" : "") + std::to_string(step) + ".vtu";
    EXPECT_TRUE(result("small/out" + file) == result("whole" + file)) << file;
  }
}

TEST_F(Disk, FullForTheCheckpointKeepsTheLastGoodOne) {
  const SmallDisk disk(scratch_.path() / "small", "2M");
  MOUNT_OR_SKIP(disk);
  const std::filesystem::path file = scratch_.path() / "small/checkpoint.h5";
  coupler::Checkpoint checkpoint;
  checkpoint.step = 3;
  const std::vector<double> values(1000, 1.5);
  checkpoint.state.write("values", std::span<const double>(values));
  coupler::write_checkpoint(file, checkpoint);
  coupler::Checkpoint larger;
  larger.step = 4;
  const std::vector<double> many(400000, 2.5);
  larger.state.write("values", std::span<const double>(many));
  try {
    coupler::write_checkpoint(file, larger);
    FAIL() << "3 MB on a disk of 2 MB";
  } catch (const RunError& error) {
    EXPECT_EQ(std::string(error.what()),
              "the checkpoint " + file.string() + " cannot be written: No space left on device");
  }
  EXPECT_FALSE(std::filesystem::exists(file.string() + ".part"));
  coupler::Checkpoint read = coupler::read_checkpoint(file);
  EXPECT_EQ(read.step, 3);
  EXPECT_EQ(read.state.doubles("values"), values);
}

TEST_F(Disk, FullForTheCheckpointDoesNotEndTheRun) {
  const SmallDisk disk(scratch_.path() / "small", "1M");
  MOUNT_OR_SKIP(disk);
  // A checkpoint of 128 points takes 115 kB, the fields of the first and of the last step 38 kB each: room for one of the
  // first kind.
  disk.fill_up_to(250 << 10);
  const Outcome outcome = polargrain(
      "run case.yaml -o small/out --set output.every=100 --set output.points=no --set mesh.element=Q4 "
      "--checkpoint-minutes 0");
  EXPECT_EQ(outcome.status, 0) << outcome.errors;
  EXPECT_NE(outcome.errors.find("warning: the checkpoint small/out/checkpoint.h5 cannot be written: No space "
                                "left on device; the last one is of step 0 of 20; the run goes on\n"),
            std::string::npos)
      << outcome.errors;
}

TEST_F(Disk, ThatMayOnlyBeReadIsRefusedBeforeAnythingRuns) {
  const SmallDisk disk(scratch_.path() / "small", "1M");
  MOUNT_OR_SKIP(disk);
  std::filesystem::create_directories(scratch_.path() / "small/out");
  disk.make_read_only();
  for (const char* directory : {"small/out", "small/new"}) {
    const Outcome outcome = polargrain(std::string("run case.yaml --quiet -o ") + directory);
    EXPECT_EQ(outcome.status, 1);
    EXPECT_EQ(outcome.errors, std::string("error: the result directory ") + directory +
                                  " cannot be made ready: Read-only file system\n");
  }
}

TEST_F(Disk, AFileThatCannotBeWrittenIsNamed) {
  // A directory in the place of the file: not even root can write it.
  std::filesystem::create_directories(scratch_.path() / "taken");
  EXPECT_THROW(app::CsvFile(scratch_.path() / "taken", std::vector<std::string>{"a"}), RunError);
  try {
    fem::write_file(scratch_.path() / "taken" / "none" / "file", "text");
    FAIL();
  } catch (const RunError& error) {
    EXPECT_EQ(std::string(error.what()), (scratch_.path() / "taken/none/file").string() +
                                             " cannot be written: No such file or directory");
  }
  try {
    fem::write_file(scratch_.path() / "taken", "text");
    FAIL();
  } catch (const RunError& error) {
    EXPECT_EQ(std::string(error.what()),
              (scratch_.path() / "taken").string() + " cannot be put in place: Is a directory");
  }
}

TEST_F(Disk, FullForARowLeavesWholeRows) {
  const SmallDisk disk(scratch_.path() / "small", "16k");
  MOUNT_OR_SKIP(disk);
  app::CsvFile file(scratch_.path() / "small/rows.csv", std::vector<std::string>{"name", "value"});
  disk.fill_up_to(0);
  const std::string wide(1000, '7');
  long good = 0;
  std::string message;
  for (; good < 100 && message.empty(); ++good) try {
      file.row({std::to_string(good), wide});
    } catch (const RunError& error) {
      message = error.what();
      --good;
    }
  EXPECT_EQ(message,
            (scratch_.path() / "small/rows.csv").string() + " cannot be written: No space left on device");
  const std::string text = result("small/rows.csv");
  EXPECT_EQ(text.back(), '\n');
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), good + 1);
  // When there is room again, nothing is missing.
  std::filesystem::remove(scratch_.path() / "small/filler");
  disk.make_larger();
  file.write();
  EXPECT_EQ(result("small/rows.csv"), file.text());
}

}  // namespace
}  // namespace polargrain::testing
