// SPDX-License-Identifier: GPL-2.0-or-later
#include "common/trial.hpp"

#include <fmt/format.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "common/error.hpp"

namespace polargrain {
namespace {

constexpr rlim_t kMostSeconds = 600;

[[noreturn]] void work_and_end(const std::function<void()>& work) {
  const rlimit seconds{kMostSeconds, kMostSeconds};
  setrlimit(RLIMIT_CPU, &seconds);
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  for (const int deadly : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGXCPU}) signal(deadly, SIG_DFL);
  try {
    work();
  } catch (...) {  // it will be thrown again where it can be answered
  }
  _exit(0);
}

}  // namespace

void try_in_own_process(const std::function<void()>& work) {
  const pid_t child = fork();
  if (child < 0) throw RunError(fmt::format("no process to try it in: {}", std::strerror(errno)));
  if (child == 0) work_and_end(work);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFSIGNALED(status))
    throw RunError(fmt::format("the library that reads it ended by signal {} ({})", WTERMSIG(status),
                               strsignal(WTERMSIG(status))));
  if (WEXITSTATUS(status) != 0) throw RunError("the library that reads it ended the process");
}

}  // namespace polargrain
