// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/pool/private_directory.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <stdlib.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>
#include <system_error>

#include "common/error.hpp"

namespace polargrain::coupler {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPrefix = "polargrain-";
constexpr const char* kLock = "lock";

/// Removes directories of processes that were killed: the lock of a living one is held, and the kernel lets
/// go of it with the process, however it ends. One without a lock is being made, or kept for somebody to
/// read.
void remove_stale(const fs::path& parent) {
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(parent, error)) {
    if (entry.path().filename().string().rfind(kPrefix, 0) != 0 || entry.is_symlink(error)) continue;
    struct stat status {};
    if (lstat(entry.path().c_str(), &status) != 0 || !S_ISDIR(status.st_mode) || status.st_uid != geteuid())
      continue;
    const int lock = open((entry.path() / kLock).c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW);
    if (lock < 0) continue;
    if (flock(lock, LOCK_EX | LOCK_NB) == 0) fs::remove_all(entry.path(), error);
    close(lock);
  }
}

/// @returns the descriptor that holds the lock
int take_lock(const fs::path& directory) {
  // Under another name first: nobody may find the lock before it is held.
  const fs::path unfinished = directory / "lock-to-be";
  const int lock = open(unfinished.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (lock < 0) return -1;
  flock(lock, LOCK_EX | LOCK_NB);
  std::error_code ignored;
  fs::rename(unfinished, directory / kLock, ignored);
  return lock;
}

}  // namespace

PrivateDirectory::PrivateDirectory() {
  std::error_code error;
  // Absolute: a worker that is confined, or that lives in another folder, would look for the socket elsewhere.
  fs::path place = fs::temp_directory_path(error);
  if (!error) place = fs::absolute(place, error).lexically_normal();
  std::string name = (place / (std::string(kPrefix) + "XXXXXX")).string();
  if (error || name.size() > 90) name = std::string("/tmp/") + kPrefix + "XXXXXX";
  remove_stale(fs::path(name).parent_path());
  if (mkdtemp(name.data()) == nullptr) {
    throw RunError(
        fmt::format("cannot make a directory for the sockets of the workers ({}): {}; set TMPDIR to a "
                    "directory you may write to",
                    name, std::strerror(errno)));
  }
  path_ = name;
  lock_ = take_lock(path_);
}

PrivateDirectory::~PrivateDirectory() {
  std::error_code ignored;
  if (keep_) {
    fs::remove(path_ / kLock, ignored);
  } else {
    fs::remove_all(path_, ignored);
    // remove_all() begins with unlink(), which a guest that is confined to this directory may not: it is not tried as a
    // directory then.
    rmdir(path_.c_str());
  }
  if (lock_ >= 0) close(lock_);
}

}  // namespace polargrain::coupler
