// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/pool/confinement.hpp"

#include <errno.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <linux/landlock.h>
#include <stdlib.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstdint>
#include <cstring>
#include <fstream>
#include <string_view>

#include "coupler/pool/call_filter.hpp"

// A leak sanitizer traces its own process when it ends.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define POLARGRAIN_SANITIZED 1
#else
#define POLARGRAIN_SANITIZED 0
#endif

namespace polargrain::coupler {
namespace {

constexpr std::string_view kLocal = "ipc://";

/// Whether this process sees another interface than the one to itself.
bool has_network() {
  std::ifstream in("/proc/net/dev");
  for (std::string line; std::getline(in, line);) {
    const std::size_t colon = line.find(':');
    const std::size_t name = line.find_first_not_of(' ');
    if (colon != std::string::npos && line.substr(name, colon - name) != "lo") return true;
  }
  return false;
}

/// All that changes files; later kernels know more, which this leaves alone.
constexpr std::uint64_t kChanges = LANDLOCK_ACCESS_FS_WRITE_FILE | LANDLOCK_ACCESS_FS_REMOVE_DIR |
                                   LANDLOCK_ACCESS_FS_REMOVE_FILE | LANDLOCK_ACCESS_FS_MAKE_CHAR |
                                   LANDLOCK_ACCESS_FS_MAKE_DIR | LANDLOCK_ACCESS_FS_MAKE_REG |
                                   LANDLOCK_ACCESS_FS_MAKE_SOCK | LANDLOCK_ACCESS_FS_MAKE_FIFO |
                                   LANDLOCK_ACCESS_FS_MAKE_BLOCK | LANDLOCK_ACCESS_FS_MAKE_SYM;

constexpr std::uint64_t kTruncate = std::uint64_t{1} << 14;  // LANDLOCK_ACCESS_FS_TRUNCATE, of version 3

bool allow_changes_below(long rules, const char* path, std::uint64_t changes) {
  landlock_path_beneath_attr below{};
  below.allowed_access = changes;
  below.parent_fd = open(path, O_PATH | O_CLOEXEC);
  if (below.parent_fd < 0) return false;
  const bool good = syscall(SYS_landlock_add_rule, rules, LANDLOCK_RULE_PATH_BENEATH, &below, 0) == 0;
  ::close(below.parent_fd);
  return good;
}

}  // namespace

Confinement::Confinement(const std::string& url) : may_use_network_(!url.starts_with(kLocal)) {
  if (POLARGRAIN_SANITIZED != 0) {
    missing_.emplace_back("nothing of it in a build with sanitizers");
    return;
  }
  if (may_use_network_) {
    folder_ = own_.emplace().path();
  } else {
    if (has_network()) missing_.emplace_back("no network (user and network namespaces)");
    const std::filesystem::path socket = url.substr(kLocal.size());
    folder_ = socket.parent_path() / fmt::format("worker-{}", getpid());
    mkdir(folder_.c_str(), 0700);
  }
  setenv("TMPDIR", folder_.c_str(), 1);
  if (chdir(folder_.c_str()) != 0) missing_.emplace_back("a working directory of its own");
}

void Confinement::close() {
  if (POLARGRAIN_SANITIZED != 0) return;
  prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);  // the system asks for it first
  keep_to_folder();
  if (!install_call_filter(may_use_network_))
    missing_.push_back(fmt::format("a filter of system calls (seccomp: {})", std::strerror(errno)));
}

std::string Confinement::missing() const {
  return fmt::format("{}", fmt::join(missing_, "; "));
}

void Confinement::keep_to_folder() {
  const long version = syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION);
  const std::uint64_t changes = version >= 3 ? kChanges | kTruncate : kChanges;
  landlock_ruleset_attr handled{};
  handled.handled_access_fs = changes;
  const long rules = syscall(SYS_landlock_create_ruleset, &handled, sizeof handled, 0);
  const bool good =
      rules >= 0 && allow_changes_below(rules, folder_.c_str(), changes) &&
      // so that the folder itself can go in the end: directories go when they are empty only
      allow_changes_below(rules, folder_.parent_path().c_str(), LANDLOCK_ACCESS_FS_REMOVE_DIR) &&
      allow_changes_below(rules, "/dev/null", LANDLOCK_ACCESS_FS_WRITE_FILE) &&
      syscall(SYS_landlock_restrict_self, rules, 0) == 0;
  if (!good)
    missing_.push_back(fmt::format("no writing outside of its folder (landlock: {})", std::strerror(errno)));
  if (rules >= 0) ::close(static_cast<int>(rules));
}

}  // namespace polargrain::coupler
