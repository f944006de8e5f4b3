// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "tests/support/processes.hpp"

namespace polargrain::testing {

/// A command of the shell that runs beside the test.
class Beside {
 public:
  explicit Beside(const std::string& command) {
    const std::string line = "exec " + command;
    std::vector<char*> arguments{const_cast<char*>("sh"), const_cast<char*>("-c"),
                                 const_cast<char*>(line.c_str()), nullptr};
    posix_spawn(&id_, "/bin/sh", nullptr, nullptr, arguments.data(), environ);
  }
  ~Beside() {
    if (id_ > 0) kill(id_, SIGKILL);
    wait();
  }
  Beside(const Beside&) = delete;
  Beside& operator=(const Beside&) = delete;

  [[nodiscard]] pid_t id() const { return id_; }
  bool running() {
    if (id_ > 0 && waitpid(id_, &status_, WNOHANG) == id_) id_ = -1;
    return id_ > 0;
  }
  /// @returns its exit status, -1 when a signal ended it
  int wait() {
    if (id_ > 0) waitpid(id_, &status_, 0);
    id_ = -1;
    return WIFEXITED(status_) ? WEXITSTATUS(status_) : -1;
  }

 private:
  pid_t id_ = -1;
  int status_ = 0;
};

/// Waits until the condition holds or the command has ended. @returns whether the condition holds
template <class Condition>
bool await(Beside& command, Condition condition) {
  while (!condition()) {
    if (!command.running()) return condition();
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return true;
}

/// Rows of a table that a run writes, the row of names included; 0 when there is no table yet.
inline long rows_of(const std::filesystem::path& table) {
  std::ifstream in(table, std::ios::binary);
  return std::count(std::istreambuf_iterator<char>(in), {}, '\n');
}

/// Follows a run by its history.csv, so that faults come at its own pace and not at that of a clock: a run that others slow down
/// meets as many in a step as one that is alone.
class Pace {
 public:
  Pace(Beside& run, std::filesystem::path history) : run_(run), history_(std::move(history)) {}
  /// Waits until the table has so many rows more than when the run began, or the run has ended.
  /// @returns whether it goes on
  bool await(long rows) {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point begin = Clock::now();
    const long before = rows_of(history_);
    testing::await(run_, [&] { return rows_of(history_) >= rows; });
    if (const long more = rows_of(history_) - before; more > 0)
      row_ = std::chrono::duration<double>(Clock::now() - begin).count() / static_cast<double>(more);
    return run_.running();
  }
  /// Waits for a share of the time that a row took at last.
  void sleep_for_rows(double share) const {
    std::this_thread::sleep_for(std::chrono::duration<double>(share * row_));
  }

 private:
  Beside& run_;
  std::filesystem::path history_;
  double row_ = 0.01;  ///< s
};

struct WorkerKills {
  int sent = 0;
  int before_last_step = 0;  ///< of these, dead with a whole step to go: the run must have noticed them
};

/// Kills children of a run, picked at random, each but once, at random moments behind every so many of its steps, until it has killed
/// so many or the run has ended.
/// @param rows that the table has at the end; 0: not known
inline WorkerKills kill_workers(Beside& run, const std::filesystem::path& history, int kills,
                                double steps_between, std::uint64_t seed, long rows = 0) {
  std::mt19937_64 generator(seed);
  std::uniform_real_distribution<double> share(0.0, std::min(1.0, steps_between));
  Pace pace(run, history);
  std::set<pid_t> hit;  // one that is dead stays in the list until its parent has noticed
  WorkerKills done;
  while (done.sent < kills && pace.await(2 + static_cast<long>(steps_between * done.sent))) {
    pace.sleep_for_rows(share(generator));
    std::vector<pid_t> workers = children_of(run.id());
    std::erase_if(workers, [&](pid_t worker) { return hit.contains(worker); });
    if (workers.empty()) continue;
    const pid_t worker = workers[generator() % workers.size()];
    hit.insert(worker);
    // A process whose end has been asked for ends when it has the processor next: others may go on for steps by then.
    if (!kill_and_await_end(worker)) continue;
    ++done.sent;
    if (rows_of(history) + 1 < rows) ++done.before_last_step;
  }
  return done;
}

}  // namespace polargrain::testing
