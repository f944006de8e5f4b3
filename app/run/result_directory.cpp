// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/run/result_directory.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "common/error.hpp"

namespace polargrain::app {
namespace fs = std::filesystem;

fs::path default_result_directory(const fs::path& case_file) {
  const fs::path name =
      case_file.stem() == "case" ? fs::absolute(case_file).parent_path().filename() : case_file.stem();
  return fs::path("results") / name;
}

DirectoryLock::DirectoryLock(const fs::path& directory)
    : descriptor_(open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  if (descriptor_ >= 0 && flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    close(descriptor_);
    throw InputError({directory.string(), 0,
                      "another run is at work in this directory; wait for its end, or give another with -o "
                      "DIR"});
  }
}

DirectoryLock::~DirectoryLock() {
  if (descriptor_ >= 0) close(descriptor_);
}

namespace {

void clear(const fs::path& directory) {
  if (fs::exists(directory / kCheckpointFile)) {
    fs::rename(directory / kCheckpointFile, directory / kOldCheckpointFile);
  }
  // The log last: it tells that the directory is ours, should this be interrupted.
  for (const char* file :
       {kCheckpointBeforeFile, "history.csv", "costs.csv", "fields.pvd", "summary.json", "fields", "logs", "replay", "run.log"}) {
    fs::remove_all(directory / file);
  }
}

}  // namespace

std::unique_ptr<DirectoryLock> prepare_result_directory(const fs::path& directory, bool resume) try {
  const std::string name = directory.string();
  if (fs::exists(directory) && !fs::is_directory(directory)) {
    throw InputError({name, 0, "is a file, so no result directory; give another with -o DIR"});
  }
  bool is_result = false;
  for (const char* file : {"summary.json", "run.log", kCheckpointFile, kCheckpointBeforeFile, kOldCheckpointFile}) {
    is_result = is_result || fs::exists(directory / file);
  }
  if (resume && !is_result) {
    throw InputError(
        {name, 0, "holds no run to go on with; name its directory with -o DIR, or run without --resume"});
  }
  if (fs::exists(directory) && !fs::is_empty(directory) && !is_result) {
    throw InputError(
        {name, 0,
         "exists and holds no former result; give an empty or new directory with -o DIR, so that no "
         "file of yours is mixed with results"});
  }
  fs::create_directories(directory);
  auto lock = std::make_unique<DirectoryLock>(directory);
  if (access(directory.c_str(), W_OK) != 0) {
    throw fs::filesystem_error("", std::error_code(errno, std::generic_category()));
  }
  if (!resume) clear(directory);
  return lock;
} catch (const fs::filesystem_error& error) {
  throw RunError(fmt::format("the result directory {} cannot be made ready: {}", directory.string(),
                             error.code().message()));
}

}  // namespace polargrain::app
