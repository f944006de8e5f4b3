// SPDX-License-Identifier: GPL-2.0-or-later
// Bad input is refused before anything waits for it, and output harms nothing.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <array>
#include <memory>

#include "tests/faults/checkpoint_runs.hpp"

namespace polargrain::testing {
namespace {

namespace fs = std::filesystem;

class Doors : public ::testing::Test {
 protected:
  Doors()
      : scratch_(std::string("doors_") + ::testing::UnitTest::GetInstance()->current_test_info()->name()) {
    write_case(scratch_.path(), {"softening 0.1", "[1, 2]", "count: 2, tolerance: 1e-6"});
  }
  /// Within a limit that only what hangs comes to: it ends with status 124 then.
  [[nodiscard]] Outcome polargrain(const std::string& arguments, const std::string& before = "") const {
    return run_in(scratch_.path(), before + "timeout 600 " POLARGRAIN " " + arguments + " < /dev/null");
  }
  void expect_refused(const std::string& arguments, const std::string& message, int status = 2) const {
    const Outcome outcome = polargrain(arguments);
    EXPECT_EQ(outcome.status, status) << arguments << '\n' << outcome.out << outcome.errors;
    EXPECT_NE((outcome.errors + outcome.out).find(message), std::string::npos)
        << arguments << '\n'
        << outcome.out << outcome.errors;
  }
  [[nodiscard]] fs::path at(const std::string& name) const { return scratch_.path() / name; }
  [[nodiscard]] std::string text(const std::string& name) const { return content(at(name)); }
  /// Waits until a file holds words.
  void await(const std::string& name, const std::string& words) const {
    while (text(name).find(words) == std::string::npos) sleep_for(0.005);
  }
  Scratch scratch_;
};

// ---- signals

TEST_F(Doors, ARunThatWaitsForItsFirstGuestHeedsSignals) {
  ASSERT_EQ(polargrain("keys keys").status, 0);
  for (const int signal : {SIGTERM, SIGHUP, SIGINT}) {
    fs::remove_all(at("out"));
    RunningProgram program(scratch_.path(),
                           "run case.yaml -o out -w 0 --listen tcp://127.0.0.1:* --keys keys");
    await("out/run.log", "workers may join at");
    EXPECT_EQ(program.end(signal), 3) << text("program.out");
    EXPECT_NE(text("out/summary.json").find("\"status\": \"stopped\""), std::string::npos);
  }
}

TEST_F(Doors, ARunHeedsSignalsFromItsBeginning) {
  const auto start = [&](const std::string& elements) {
    write_case(scratch_.path(), {"sleep_milliseconds 1", elements, "count: 2, tolerance: 1e-6"});
    fs::remove_all(at("out"));
    fs::remove(at("program.out"));
    return std::make_unique<RunningProgram>(scratch_.path(), "run case.yaml -o out -w 1 --quiet");
  };
  const auto has_handler = [](pid_t process) {
    const std::string status = content("/proc/" + std::to_string(process) + "/status");
    const std::size_t place = status.find("SigCgt:\t");
    return place != std::string::npos &&
           (std::stoull(status.substr(place + 8, 16), nullptr, 16) >> (SIGTERM - 1)) % 2 == 1;
  };
  const auto expect_word = [&](RunningProgram& program) {
    EXPECT_EQ(program.end(SIGTERM), 3) << text("program.out");
    EXPECT_NE(text("program.out").find("stopped by SIGTERM"), std::string::npos) << text("program.out");
  };
  // A case that takes seconds to read: signals are heeded before, and nothing is written then. Where this test waits for a
  // processor for as long, the try says nothing, and is made again.
  bool in_time = false;
  for (int attempt = 0; attempt < 20 && !in_time; ++attempt) {
    const auto program = start("[150, 300]");
    while (program->running() && !has_handler(program->id())) sleep_for(0.001);
    const bool before = !fs::exists(at("out"));
    expect_word(*program);
    in_time = before && !fs::exists(at("out"));
  }
  EXPECT_TRUE(in_time) << "nobody heeds signals before the result directory is there";
  for (const double seconds : {0.02, 0.1, 0.3}) {
    const auto program = start("[20, 40]");
    while (program->running() && !has_handler(program->id())) sleep_for(0.001);
    sleep_for(seconds);
    expect_word(*program);
  }
}

// ---- what workers need

TEST_F(Doors, ARelativeTemporaryDirectoryIsWhereItIs) {
  fs::create_directory(at("tmp"));
  for (const char* const folder : {".", "tmp", "./tmp/", "tmp/../tmp"}) {
    const Outcome outcome =
        polargrain("run case.yaml -o out -w 1 --quiet", std::string("TMPDIR=") + folder + " ");
    EXPECT_EQ(outcome.status, 0) << folder << '\n' << outcome.errors;
  }
}

TEST_F(Doors, TooFewOpenFilesAreSaidAtOnce) {
  for (const int limit : {12, 16, 20, 24, 28, 32, 40, 64}) {
    for (const int workers : {1, 8}) {
      fs::remove_all(at("out"));
      const Outcome outcome = polargrain("run case.yaml -o out --quiet -w " + std::to_string(workers),
                                         "ulimit -n " + std::to_string(limit) + " && ");
      EXPECT_NE(outcome.status, 124) << limit << ' ' << workers << '\n' << outcome.errors;
      EXPECT_EQ(outcome.errors.find("did not report"), std::string::npos)
          << "waited for who cannot come: " << outcome.errors;
      if (limit == 20 && workers == 8) {
        EXPECT_NE(outcome.errors.find("the limit of open files is 20"), std::string::npos) << outcome.errors;
      }
    }
  }
  EXPECT_EQ(polargrain("run case.yaml -o out --quiet -w 8", "ulimit -n 128 && ").status, 0);
}

// ---- numbers and places of the command line

TEST_F(Doors, OptionsThatAreNoSoundNumbersAreRefused) {
  for (const char* const number : {"nan", "-nan", "inf", "1e400", "-1", "ten", ""}) {
    const std::string quoted = std::string("'") + number + "'";
    expect_refused("run case.yaml -o out --checkpoint-minutes=" + quoted, "--checkpoint-minutes");
    expect_refused("worker --connect ipc:///nowhere --patience=" + quoted, "--patience");
    expect_refused("band out --window=" + quoted, "--window");
    expect_refused("band out --contrast=" + quoted, "--contrast");
  }
  for (const char* const number : {"nan", "inf"}) {
    expect_refused(std::string("band out --from=") + number, "--from");
    expect_refused(std::string("bench case.yaml --band 0,") + number, "--band");
  }
  EXPECT_FALSE(fs::exists(at("out")));
}

TEST_F(Doors, PlacesToListenAtAreWhatTheySay) {
  ASSERT_EQ(polargrain("keys keys").status, 0);
  for (const char* const url : {"tcp://127.0.0.1:99999", "tcp://127.0.0.1:65536", "tcp://127.0.0.1:-1",
                                "tcp://127.0.0.1:0", "tcp://127.0.0.1:55x", "tcp://127.0.0.1:",
                                "tcp://127.0.0.1", "tcp://:5570", "ipc:///tmp/x", "5570", "tcp://"}) {
    expect_refused(std::string("run case.yaml -o out -w 0 --keys keys --listen '") + url + "'",
                   "expected tcp://HOST:PORT");
  }
  expect_refused("worker --key keys/worker.key --connect tcp://127.0.0.1:99999", "expected tcp://HOST:PORT");
  EXPECT_FALSE(fs::exists(at("out")));
}

// ---- input files

TEST_F(Doors, NoPipeOrDeviceIsWaitedFor) {
  ASSERT_EQ(polargrain("keys keys").status, 0);
  ASSERT_EQ(polargrain("run case.yaml -o out -w 1 --quiet").status, 0);
  ASSERT_EQ(mkfifo(at("pipe").c_str(), 0600), 0);
  fs::create_symlink("pipe", at("link"));
  fs::create_symlink("circle", at("circle"));
  const std::string set = "check case.yaml --set materials.sand.";
  for (const std::string file : {"pipe", "link", "circle", "/dev/zero", "keys"}) {
    expect_refused("check " + file, "");
    expect_refused(set + "packing=" + file, "");
    expect_refused(set + "script=" + file, "");
    expect_refused("check case.yaml --set mesh.file=" + file, "");
    expect_refused("worker --connect tcp://127.0.0.1:5570 --key " + file, "");
    expect_refused("point case.yaml sand " + file, "");
    expect_refused("pack --export out.data " + file, "");
    expect_refused("band " + file, "");
    expect_refused("report " + file, "");
    expect_refused("verify " + file, "");
    expect_refused("calibrate " + file + " " + file, "");
    expect_refused("element " + file, "");
  }
  // In the place of each file of a result.
  for (const char* const name : {"history.csv", "costs.csv", "run.log", "summary.json", "checkpoint.h5",
                                 "sample.h5", "fields.pvd", "fields/step-00001.vtu"}) {
    fs::remove_all(at("copy"));
    fs::copy(at("out"), at("copy"), fs::copy_options::recursive);
    fs::remove(at("copy") / name);
    ASSERT_EQ(mkfifo((at("copy") / name).c_str(), 0600), 0);
    for (const char* const command :
         {"report copy", "verify copy -w 1", "run case.yaml -o copy --quiet -w 1 --resume"})
      EXPECT_NE(polargrain(command).status, 124) << command << ' ' << name;
  }
}

TEST_F(Doors, NamesThatAreTooLongOrLeadInCirclesEndNothing) {
  fs::create_symlink("circle", at("circle"));
  for (const std::string& name :
       {std::string("circle"), std::string(300, 'x'), std::string(5000, 'x'), std::string()}) {
    for (const char* const command : {"check", "run", "pack", "bench", "layer", "interface", "report",
                                      "verify", "band", "grains", "keys", "element"}) {
      const Outcome outcome = polargrain(std::string(command) + " '" + name + "'");
      EXPECT_TRUE(outcome.status == 1 || outcome.status == 2) << command << ' ' << name << '\n'
                                                              << outcome.status;
      EXPECT_EQ(outcome.errors.find("filesystem error"), std::string::npos) << command << '\n'
                                                                            << outcome.errors;
      EXPECT_EQ(outcome.errors.find("terminate"), std::string::npos) << command << '\n' << outcome.errors;
    }
  }
}

// ---- output files

TEST_F(Doors, OutputTakesNothingsPlace) {
  ASSERT_EQ(polargrain("run case.yaml -o out -w 1 --quiet").status, 0);
  // By links: should this fail, no device of the machine is lost.
  for (const char* const device : {"null", "full", "zero", "stdout"}) {
    fs::create_symlink(std::string("/dev/") + device, at(device));
    const Outcome outcome = polargrain(std::string("report out -o ") + device);
    EXPECT_EQ(outcome.status, std::string(device) == "full" ? 1 : 0) << device << '\n' << outcome.errors;
    EXPECT_TRUE(fs::is_symlink(at(device))) << device;
    EXPECT_EQ(outcome.out.find("<!DOCTYPE html>") != std::string::npos, std::string(device) == "stdout")
        << device;
  }
  EXPECT_NE(polargrain("report out -o full").errors.find("full cannot be written: No space left"),
            std::string::npos);
  // Through links, also where nothing is yet.
  fs::create_directory(at("far"));
  write(at("far/page.html"), "<!DOCTYPE html>\n<html lang='en'><head><meta charset='utf-8'>\nbefore");
  fs::create_symlink("far/page.html", at("page"));
  fs::create_symlink("far/new.html", at("new"));
  fs::create_symlink("page", at("second"));
  fs::create_symlink("circle", at("circle"));
  for (const char* const link : {"page", "new", "second"}) {
    EXPECT_EQ(polargrain(std::string("report out -o ") + link).status, 0) << link;
    EXPECT_TRUE(fs::is_symlink(at(link))) << link;
    EXPECT_EQ(text(link).find("<!DOCTYPE html>"), 0U) << link;
  }
  EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(at("far/page.html"))));
  expect_refused("report out -o circle", "circle: cannot be written: Too many levels of symbolic links");
  ASSERT_EQ(mkfifo(at("pipe").c_str(), 0600), 0);
  expect_refused("report out -o pipe", "pipe cannot be written", 1);
  EXPECT_TRUE(fs::is_fifo(at("pipe")));
  expect_refused("point case.yaml sand grains.csv -o pipe", "");
  expect_refused("report out -o far", "-o far: is a directory");
  expect_refused("report out -o nowhere/page.html", "nowhere/page.html: there is no folder nowhere");
  expect_refused("report out -o " + std::string(300, 'x'), "File name too long");
  expect_refused("worker --connect ipc:///nowhere --patience 0.1 --log pipe",
                 "the log pipe cannot be written", 1);
  expect_refused("run case.yaml -w 1 -o " + std::string(300, 'x'), "File name too long", 1);
  expect_refused("run case.yaml -w 1 -o case.yaml", "is a file");
  expect_refused("run case.yaml -w 1 -o circle", "", 1);
}

// ---- names

// Each with what a terminal, a log, a table or a page would do with it.
constexpr std::array kControls{"\\x1b[2J", "\\x07", "\\0", "\\x7f", "\\x9b31m",
                               "\\x85",    "\\r",   "\\n", "\\t",   "\\b"};

TEST_F(Doors, ControlCharactersInNamesAreRefused) {
  const std::string good = text("case.yaml");
  for (const std::string control : kControls) {
    for (const auto& [what, with] :
         {std::pair<std::string, std::string>{"title: A \"small\" run", "title: \"A" + control + "run\""},
          {"monitors: {top_force:", "monitors: {\"top" + control + "force\":"},
          {"regions: {all: sand}", "regions: {\"a" + control + "ll\": sand}"},
          {"materials: {sand:", "materials: {\"s" + control + "and\":"}}) {
      std::string changed = good;
      changed.replace(changed.find(what), what.size(), with);
      write(at("case.yaml"), changed);
      const Outcome outcome = polargrain("run case.yaml -o out -w 1");
      EXPECT_EQ(outcome.status, 2) << with << '\n' << outcome.out << outcome.errors;
      EXPECT_NE(outcome.errors.find("case.yaml:"), std::string::npos) << with << '\n' << outcome.errors;
      EXPECT_EQ(outcome.errors.find_first_of("\x1b\x07\x7f\r\b"), std::string::npos) << with;
    }
  }
  write(at("case.yaml"), good);
  expect_refused("check case.yaml --set \"$(printf 'title=a\\033[2Jb')\"", "control character");
  expect_refused("check case.yaml --set \"$(printf 'monitors.a\\033b=time')\"", "a key must be a plain word");
  EXPECT_FALSE(fs::exists(at("out")));
  // A title of several lines of YAML is one line.
  expect_refused("check case.yaml --set \"$(printf 'title=>-\\n  one\\n  line')\"", "no faults", 0);
}

TEST_F(Doors, NamesOfFilesSteerNoTerminalAndNoLog) {
  const std::string name = "c\x1b[2J\nx.yaml";
  fs::copy_file(at("case.yaml"), at(name));
  const Outcome outcome =
      polargrain("run \"$(printf 'c\\033[2J\\nx.yaml')\" -o \"$(printf 'o\\033[1mut')\" -w 1");
  EXPECT_EQ(outcome.status, 0) << outcome.errors;
  for (const std::string& said : {outcome.out, outcome.errors, text("o\x1b[1mut/run.log")})
    EXPECT_EQ(said.find('\x1b'), std::string::npos) << said;
  const Outcome verified = polargrain("verify \"$(printf 'o\\033[1mut')\" -w 1");
  EXPECT_EQ(verified.status, 0) << verified.out << verified.errors;
  EXPECT_EQ(verified.out.find('\x1b'), std::string::npos);
  EXPECT_EQ(polargrain("check \"$(printf 'no\\033[2J')\"").errors.find('\x1b'), std::string::npos);
}

TEST_F(Doors, MonitorsHaveNamesOfTheirOwn) {
  for (const char* const name :
       {"step", "time", "substeps", "cuts", "iterations", "evaluations", "force_residual", "moment_residual",
        "force_noise", "within_noise", "within_rounding", "limited", "jumps", "jump_residual",
        "volume_strain", "external_work", "internal_work"})
    expect_refused(std::string("check case.yaml --set monitors.") + name + "=top_force",
                   "is taken; choose another");
  for (const char* const name : {"+x", "-x", "@x", "a,b"})
    expect_refused(std::string("check case.yaml --set 'monitors.") + name + "=top_force'",
                   "heads a column of a CSV file");
  std::string formula = text("case.yaml");
  formula.replace(formula.find("top_force:"), 10, "'=1+1':");
  write(at("case.yaml"), formula);
  expect_refused("check case.yaml", "heads a column of a CSV file");
}

// ---- results that are no numbers

TEST_F(Doors, ARatioOfWhatIsZeroYetIsNoFault) {
  const std::string ratio =
      " --set monitors.u='{on: top, displacement: u2}' --set monitors.w='{on: bottom, displacement: u2}' "
      "--set monitors.ratio='w / (0 * u)' --set monitors.strain='u / u' --set monitors.huge='1 / (0 * u)'";
  ASSERT_EQ(polargrain("run case.yaml -o out -w 1 --quiet" + ratio).status, 0);
  EXPECT_NE(text("out/history.csv").find(",nan"), std::string::npos) << text("out/history.csv");
  EXPECT_EQ(text("out/history.csv").find("-nan"), std::string::npos);
  for (const char* const command : {"report out", "report out --x strain", "report out --x ratio",
                                    "verify out -w 1", "run case.yaml -o out -w 1 --quiet --resume"}) {
    const std::string settings = std::string(command).starts_with("run") ? ratio : "";
    const Outcome outcome = polargrain(command + settings);
    EXPECT_EQ(outcome.status, 0) << command << '\n' << outcome.out << outcome.errors;
  }
}

// The note of a material stands in the log and, unless the run is quiet, on the terminal, with the step of the run.
TEST_F(Doors, NotesHaveTheStepOfTheRunAndQuietIsQuiet) {
  write_case(scratch_.path(), {"softening 3", "[4, 8]", "count: 10, tolerance: 1e-3",
                               "adaptive, adaptive: {tolerance: 1e-2, audit: 0.1}"});
  const Outcome quiet = polargrain("run case.yaml -o out -w 1 --quiet");
  EXPECT_EQ(quiet.status, 0);
  EXPECT_EQ(quiet.out + quiet.errors, "");
  const std::string log = text("out/run.log");
  const std::size_t place = log.find("region 'all': the mean error is at most");
  ASSERT_NE(place, std::string::npos) << log;
  const std::string mark = "[info] step ";
  const std::size_t step_at = log.rfind(mark, place) + mark.size();
  const std::string step = log.substr(step_at, log.find('\n', step_at) - step_at);
  const Outcome loud = polargrain("run case.yaml -o loud -w 1");
  EXPECT_NE(loud.errors.find("note: step " + step + ", region 'all': the mean error is at most"),
            std::string::npos)
      << step << '\n'
      << loud.errors;
}

}  // namespace
}  // namespace polargrain::testing
