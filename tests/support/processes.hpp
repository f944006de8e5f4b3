// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <poll.h>
#include <signal.h>
#include <sys/syscall.h>
#include <sys/types.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace polargrain::testing {

/// The processes that a process has started (from any of its threads) and that have not ended.
inline std::vector<pid_t> children_of(pid_t parent) {
  std::vector<pid_t> children;
  std::error_code gone;
  for (const auto& thread :
       std::filesystem::directory_iterator("/proc/" + std::to_string(parent) + "/task", gone)) {
    std::ifstream in(thread.path() / "children");
    for (pid_t child = 0; in >> child;) children.push_back(child);
  }
  return children;
}

/// Kills a process and waits until the last of its threads has ended: before that its parent cannot notice.
/// @returns whether there was such a process
inline bool kill_and_await_end(pid_t process) {
  const int end = static_cast<int>(syscall(SYS_pidfd_open, process, 0));
  if (end < 0) return false;
  const bool sent = kill(process, SIGKILL) == 0;
  pollfd watched{end, POLLIN, 0};
  while (sent && poll(&watched, 1, -1) < 0 && errno == EINTR) continue;
  close(end);
  return sent;
}

}  // namespace polargrain::testing
