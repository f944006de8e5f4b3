// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <random>
#include <string>
#include <thread>
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

/// Sends a signal to children of a command, picked at random, at random intervals, until it has sent so many
/// or the command has ended. @returns how many it has sent
inline int kill_workers(Beside& coordinator, int kills, double mean_seconds, std::uint64_t seed,
                        int signal = SIGKILL) {
  std::mt19937_64 generator(seed);
  std::exponential_distribution<double> wait(1.0 / mean_seconds);
  int sent = 0;
  while (sent < kills && coordinator.running()) {
    std::this_thread::sleep_for(std::chrono::duration<double>(wait(generator)));
    const std::vector<pid_t> workers = children_of(coordinator.id());
    if (workers.empty()) continue;
    sent += kill(workers[generator() % workers.size()], signal) == 0;
  }
  return sent;
}

}  // namespace polargrain::testing
