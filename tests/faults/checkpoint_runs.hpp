// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <sys/wait.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <random>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "tests/faults/killer.hpp"
#include "tests/integration/command.hpp"

namespace polargrain::testing {

/// A run of the program POLARGRAIN beside the test. Its output goes to `directory`/program.out.
class RunningProgram : public Beside {
 public:
  RunningProgram(const std::filesystem::path& directory, const std::string& arguments)
      : Beside("env -C '" + directory.string() + "' " POLARGRAIN " " + arguments + " >> '" +
               directory.string() + "/program.out' 2>&1") {}
  /// Sends a signal and waits for the end.
  /// @returns the exit status, or -1 when a signal ended it
  int end(int signal) {
    if (running()) kill(id(), signal);
    return wait();
  }
};

inline void sleep_for(double seconds) {
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
}

/// Whether a signal was sent to a process that has not arrived there.
inline bool has_pending_signal(pid_t process) {
  std::istringstream status(content("/proc/" + std::to_string(process) + "/status"));
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("ShdPnd:")) return line.find_first_of("123456789abcdef", 7) != std::string::npos;
  return false;
}

/// A run of a FakeCase into out/ that a signal (SIGSTOP) has stopped behind so many committed steps or more, with two of its ten
/// left at least. A busy machine may let it get further before the test has seen its steps: then another one is started.
/// @throws std::runtime_error when no run could be stopped
inline std::unique_ptr<RunningProgram> frozen_behind(const std::filesystem::path& directory, int steps,
                                                     const std::string& options) {
  for (int attempt = 0; attempt < 50; ++attempt) {
    std::filesystem::remove_all(directory / "out");
    std::filesystem::remove(directory / "program.out");
    auto program = std::make_unique<RunningProgram>(directory, "run case.yaml -o out --quiet " + options);
    if (!Pace(*program, directory / "out/history.csv").await(steps + 2)) continue;
    kill(program->id(), SIGSTOP);
    // It is stopped, or has ended: nothing else is waited for.
    siginfo_t what{};
    waitid(P_PID, static_cast<id_t>(program->id()), &what, WSTOPPED | WEXITED | WNOWAIT);
    if (what.si_code == CLD_STOPPED && rows_of(directory / "out/history.csv") <= 2 + 8) return program;
  }
  throw std::runtime_error("no run could be stopped before its end");
}

/// A biaxial test of a few elements whose cells the fake engine stands in for.
struct FakeCase {
  std::string engine;  ///< script of the fake engine (tests/integration/fake_engine.hpp)
  std::string elements = "[2, 2]";
  std::string steps = "count: 10, tolerance: 1e-8";
  std::string model = "cell";  ///< with the further keys that the model needs
  std::string output = "{}";
};

/// Writes case.yaml, fake.in and grains.csv.
inline void write_case(const std::filesystem::path& directory, const FakeCase& fake) {
  write(directory / "fake.in", fake.engine + "\n");
  write(directory / "grains.csv",
        "# cell xx=0.1 xy=0 yx=0 yy=0.1 z=0.1\nid,x,y,r,mass,Izz\n1,0.05,0.05,0.04,1.0,8e-4\n");
  write(directory / "case.yaml",
        "title: A \"small\" run\n"
        "mesh: {rectangle: {size: [0.4 m, 0.8 m], elements: " +
            fake.elements +
            "}}\n"
            "materials: {sand: {model: " +
            fake.model +
            ", script: fake.in, packing: grains.csv, G: 40 MPa, Gc: 10 MPa, lc: 20 mm}}\n"
            "regions: {all: sand}\n"
            "boundary:\n"
            "  - {on: bottom, fix: [u1, u2]}\n"
            "  - {on: top, fix: [u1], move: {u2: -8 mm}}\n"
            "  - {on: [left, right], pressure: 100 kPa}\n"
            "steps: {" +
            fake.steps +
            "}\n"
            "monitors: {top_force: {on: top, reaction: u2}}\n"
            "output: " +
            fake.output + "\n");
}

/// All files of a result whose bytes must not depend on interruptions, one behind the other.
inline std::string results_of(const std::filesystem::path& directory) {
  std::string all = content(directory / "history.csv") + content(directory / "fields.pvd");
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(directory / "fields")) files.push_back(entry);
  std::sort(files.begin(), files.end());
  for (const auto& file : files) all += file.filename().string() + '\n' + content(file);
  return all;
}

/// The record of so many kills at random moments, each followed by a resumption.
struct Kills {
  int kills = 0;
  int resumed = 0;           ///< runs that went on from a checkpoint
  int before_the_first = 0;  ///< kills before there was a checkpoint
  int runs_finished = 0;     ///< runs that reached their end although somebody waited to kill them
};

/// Kills runs of `arguments` (without directory and workers) at moments drawn from `seed`, `kills` times, in
/// as many results as it takes, and ends with a run that is left alone. Moments lie within a start or a step, up to three
/// steps on: they go with the run, however fast it is.
/// @param check is called with each result that has come to its end
template <class Check>
Kills kill_again_and_again(const std::filesystem::path& scratch, const std::string& arguments, int kills,
                           unsigned seed, Check check) {
  std::mt19937 random(seed);
  const auto drawn = [&](double most) { return most * static_cast<double>(random()) / 4294967296.0; };
  Kills done;
  double start_seconds = 0.1;  // of a start, as the last ones took
  for (int result = 0;; ++result) {
    const std::string name = "killed" + std::to_string(result);
    const std::filesystem::path history = scratch / name / "history.csv";
    for (bool ended = false; !ended;) {
      const bool has_checkpoint = std::filesystem::exists(scratch / name / "checkpoint.h5");
      // At every step, or now and then, so that rows that are already written have to be taken back.
      const std::string minutes = drawn(1.0) < 0.5 ? "0" : "0.002";
      const std::string workers = std::to_string(1 + static_cast<int>(drawn(3.0)));
      const int steps_on = static_cast<int>(drawn(4.0)) - 1;  // -1: before the first
      const double share = drawn(1.0);
      if (has_checkpoint) ++done.resumed;
      const auto begin = std::chrono::steady_clock::now();
      RunningProgram program(scratch, arguments + " -o " + name + " -w " + workers +
                                          " --checkpoint-minutes " + minutes +
                                          (has_checkpoint ? " --resume" : ""));
      if (done.kills < kills) {
        // Rows beyond those of the last run: each run is killed behind something that it did itself.
        Pace pace(program, history);
        if (steps_on < 0) {
          sleep_for(share * start_seconds);
        } else if (pace.await(std::max(1L, rows_of(history)) + 1)) {
          start_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
          pace.await(rows_of(history) + steps_on);
          pace.sleep_for_rows(1.5 * share);
        }
        const int status = program.end(SIGKILL);
        if (status == -1) {
          ++done.kills;
          if (!std::filesystem::exists(scratch / name / "checkpoint.h5")) ++done.before_the_first;
          continue;
        }
      }
      check(program.wait(), scratch / name);
      if (done.kills >= kills) return done;
      ++done.runs_finished;
      ended = true;
    }
  }
}

}  // namespace polargrain::testing
