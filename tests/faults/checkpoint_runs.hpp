// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <algorithm>
#include <chrono>
#include <random>
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

/// A biaxial test of a few elements whose cells the fake engine stands in for.
struct FakeCase {
  std::string engine;  ///< script of the fake engine (tests/integration/fake_engine.hpp)
  std::string elements = "[2, 2]";
  std::string steps = "count: 10, tolerance: 1e-8";
  std::string model = "cell";  ///< with what else the model needs
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

/// What so many kills at random moments, each followed by a resumption, have done.
struct Kills {
  int kills = 0;
  int resumed = 0;           ///< runs that went on from a checkpoint
  int before_the_first = 0;  ///< kills before there was a checkpoint
  int runs_finished = 0;     ///< runs that reached their end although somebody waited to kill them
};

/// Kills runs of `arguments` (without directory and workers) at moments drawn from `seed`, `kills` times, in
/// as many results as it takes, and ends with a run that is left alone.
/// @param most_seconds the latest moment of a kill, at first: later where other programs delay the first checkpoint, sooner
/// where runs come to their end
/// @param check is called with each result that has come to its end
template <class Check>
Kills kill_again_and_again(const std::filesystem::path& scratch, const std::string& arguments, int kills,
                           unsigned seed, double most_seconds, Check check) {
  std::mt19937 random(seed);
  const auto drawn = [&](double most) { return most * static_cast<double>(random()) / 4294967296.0; };
  Kills done;
  int result = 0;
  while (true) {
    const std::string name = "killed" + std::to_string(result);
    const bool has_checkpoint = std::filesystem::exists(scratch / name / "checkpoint.h5");
    // At every step, or now and then, so that rows that are already written have to be taken back.
    const std::string minutes = drawn(1.0) < 0.5 ? "0" : "0.002";
    const std::string workers = std::to_string(1 + static_cast<int>(drawn(3.0)));
    const double moment = drawn(most_seconds);
    if (has_checkpoint) ++done.resumed;
    RunningProgram program(scratch, arguments + " -o " + name + " -w " + workers + " --checkpoint-minutes " +
                                        minutes + (has_checkpoint ? " --resume" : ""));
    if (done.kills < kills) {
      sleep_for(moment);
      const int status = program.end(SIGKILL);
      if (status == -1) {
        ++done.kills;
        if (!std::filesystem::exists(scratch / name / "checkpoint.h5")) {
          ++done.before_the_first;
          most_seconds *= 1.25;
        }
        continue;
      }
    }
    check(program.wait(), scratch / name);
    if (done.kills >= kills) return done;
    ++done.runs_finished;
    ++result;
    most_seconds /= 1.25;
  }
}

}  // namespace polargrain::testing
