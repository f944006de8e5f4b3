// SPDX-License-Identifier: GPL-2.0-or-later
// To be preloaded: kills the process at its rename number KILL_AT_RENAME, before it or (KILL_AFTER_RENAME=1) behind it.
#include <dlfcn.h>
#include <signal.h>
#include <unistd.h>

#include <cstdlib>

namespace {
int count = 0;
}

extern "C" int rename(const char* from, const char* to) noexcept {
  using Rename = int (*)(const char*, const char*);
  static const auto next = reinterpret_cast<Rename>(dlsym(RTLD_NEXT, "rename"));
  const char* const at = std::getenv("KILL_AT_RENAME");
  const bool now = at != nullptr && ++count == std::atoi(at);
  const bool behind = std::getenv("KILL_AFTER_RENAME") != nullptr;
  if (now && !behind) kill(getpid(), SIGKILL);
  const int result = next(from, to);
  if (now && behind) kill(getpid(), SIGKILL);
  return result;
}
