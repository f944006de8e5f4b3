// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/commands/in_child.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>

#include "common/error.hpp"
#include "common/plain_text.hpp"
#include "common/standard_streams.hpp"

namespace polargrain::app {
namespace {

/// Seconds between two lines where nobody watches a terminal.
constexpr double kSecondsOfLine = 20.0;

[[noreturn]] void work_and_exit(const std::function<void(ProgressLine&)>& work, int shown) {
  int status = 1;
  try {
    ProgressLine progress(shown);
    work(progress);
    status = 0;
  } catch (const std::exception& error) {
    tell(stderr, "ERROR: {}\n", error.what());
  }
  std::exit(status);
}

}  // namespace

ProgressLine::ProgressLine(int shown) : shown_(shown), terminal_(shown >= 0 && isatty(shown) != 0) {}

void ProgressLine::say(const std::string& line) {
  if (shown_ < 0 || (!terminal_ && seconds_since(said_) < kSecondsOfLine)) return;
  said_ = Clock::now();
  const std::string plain = without_control_characters(line);
  const std::string text = terminal_ ? "\r" + plain + "   " : plain + "\n";
  if (write(shown_, text.data(), text.size()) < 0) shown_ = -1;  // nobody looks: nothing lost
}

bool run_in_child(const std::filesystem::path& log, const std::function<void(ProgressLine&)>& work,
                  bool shows_progress) {
  const int log_descriptor = open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (log_descriptor < 0) throw RunError(fmt::format("the log {} cannot be written", log.string()));
  std::fflush(nullptr);
  const pid_t parent = getpid();
  const pid_t child = fork();
  if (child == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(1);
    const int shown = shows_progress ? dup(STDERR_FILENO) : -1;
    dup2(log_descriptor, STDOUT_FILENO);
    dup2(log_descriptor, STDERR_FILENO);
    work_and_exit(work, shown);
  }
  close(log_descriptor);
  if (child < 0) throw RunError("no process can be started for the engine");
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (shows_progress && isatty(STDERR_FILENO) != 0) tell(stderr, "\n");
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace polargrain::app
