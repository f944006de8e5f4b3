// SPDX-License-Identifier: GPL-2.0-or-later
#include "tests/integration/tries.hpp"

#include <fcntl.h>
#include <sched.h>
#include <signal.h>
#include <sys/ptrace.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>

namespace polargrain::testing {
namespace {

void attempt(const char* what, bool was_allowed) {
  std::printf("tried %s: %s\n", what, was_allowed ? "allowed" : "refused");
  std::fflush(stdout);
}

/// In a child, because it would change this process.
bool can_in_a_child(const std::function<bool()>& call) {
  const pid_t child = fork();
  if (child == 0) _exit(call() ? 0 : 1);
  int status = -1;
  waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

bool can_write(const std::string& file) {
  const int descriptor = open(file.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
  if (descriptor < 0) return false;
  close(descriptor);
  unlink(file.c_str());
  return true;
}

}  // namespace

void try_what_no_engine_should() {
  attempt("to start a program", can_in_a_child([] { return execl("/bin/true", "true", nullptr) == 0; }));
  const int internet = socket(AF_INET, SOCK_STREAM, 0);
  attempt("a socket of the network", internet >= 0);
  if (internet >= 0) close(internet);
  attempt("to write elsewhere", can_write("/tmp/polargrain-tried-" + std::to_string(getpid())));
  attempt("to write in its folder", can_write(std::string(std::getenv("TMPDIR")) + "/tried"));
  attempt("to trace its coordinator", ptrace(PTRACE_SEIZE, getppid(), 0, 0) == 0);
  attempt("to signal its coordinator", kill(getppid(), 0) == 0);
  attempt("to make namespaces", can_in_a_child([] { return unshare(CLONE_NEWUSER) == 0; }));
  attempt("to start another process of its own", can_in_a_child([] { return true; }));
}

}  // namespace polargrain::testing
