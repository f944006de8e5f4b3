// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/run/result_directory.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <regex>
#include <system_error>
#include <thread>
#include <vector>

#include "app/grains/cell_paths.hpp"
#include "app/grains/grain_files.hpp"
#include "app/page/page.hpp"
#include "common/error.hpp"
#include "common/seconds.hpp"

namespace polargrain::app {
namespace fs = std::filesystem;

fs::path default_result_directory(const fs::path& case_file) {
  const fs::path name =
      case_file.stem() == "case" ? fs::absolute(case_file).parent_path().filename() : case_file.stem();
  return fs::path("results") / name;
}

namespace {

/// A run that is killed while it starts a worker leaves a child for a moment, which has its lock until it notices: time enough
/// for that on a busy machine.
constexpr double kSecondsForALock = 3.0;

bool held_by_another(int descriptor) {
  const Clock::time_point begin = Clock::now();
  while (flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    if (seconds_since(begin) > kSecondsForALock) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return false;
}

}  // namespace

DirectoryLock::DirectoryLock(const fs::path& directory)
    : directory_(directory), descriptor_(open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  if (descriptor_ >= 0 && held_by_another(descriptor_)) {
    close(descriptor_);
    throw InputError({directory.string(), 0,
                      "another run is at work in this directory; wait for its end, or give another with -o "
                      "DIR"});
  }
}

DirectoryLock::~DirectoryLock() {
  if (descriptor_ >= 0) close(descriptor_);
}

std::optional<Displacement> DirectoryLock::displacement() const {
  struct stat ours {};
  if (descriptor_ < 0 || fstat(descriptor_, &ours) != 0) return std::nullopt;
  const auto leads_here = [&ours](const fs::path& path) {
    struct stat found {};
    return stat(path.c_str(), &found) == 0 && found.st_dev == ours.st_dev && found.st_ino == ours.st_ino;
  };
  if (leads_here(directory_)) return std::nullopt;
  std::error_code error;
  const fs::path now = fs::read_symlink(fmt::format("/proc/self/fd/{}", descriptor_), error);
  if (!error && leads_here(now)) {
    return Displacement{now, fmt::format("the result directory {} was renamed to {} during the run",
                                         directory_.string(), now.string())};
  }
  return Displacement{{},
                      fmt::format("the result directory {} was removed during the run", directory_.string())};
}

fs::path make_rescue_directory(const fs::path& directory) try {
  fs::path place = directory;
  if (fs::exists(place)) place += ".rescued";
  fs::create_directories(place);
  return place;
} catch (const fs::filesystem_error& error) {
  throw RunError(fmt::format("no directory can be made in its place: {}", error.code().message()));
}

namespace {

/// The log last: it tells that the directory is ours, should its removal be interrupted.
constexpr std::array kFilesOfARun{kCheckpointBeforeFile, "history.csv",  "costs.csv", "fields.pvd",
                                  "points.pvd",          "summary.json", "sample.h5", "run.log"};

struct FolderOfARun {
  const char* name;
  std::regex files;  ///< paths from the folder of what a run writes there
};

const std::vector<FolderOfARun>& folders_of_a_run() {
  static const std::vector<FolderOfARun> folders{
      {"fields", std::regex(R"(((step|points|interfaces)-\d{5,}\.vtu|structures-\d{5,}\.csv)(\.part)?)")},
      {"profiles", std::regex(R"([^/]+-\d{5,}\.csv(\.part)?)")},
      {kCellPathsFolder, std::regex(R"((cells|step-\d{5,})\.h5(\.part)?)")},
      {kGrainsFolder, std::regex(R"(engine\.log|point-\d+(\.pvd(\.part)?|/step-\d{5,}\.vtu(\.part)?)?)")},
      {"logs", std::regex(R"(worker-\d+\.log|grains\.log)")},
      {"replay", std::regex(R"(packing\.(data|state)|cell\.in|start\.state|in\.replay|README\.md)")}};
  return folders;
}

bool is_folder(const fs::path& place) {
  return fs::is_directory(fs::symlink_status(place));
}

/// Folders go when nothing else is left in them. Links are not followed: they go, what they lead to stays.
void clear(const fs::path& directory, const FolderOfARun& folder) {
  const fs::path place = directory / folder.name;
  if (fs::is_symlink(place)) fs::remove(place);
  if (!is_folder(place)) return;
  std::vector<fs::path> written{place};
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(place))
    if (std::regex_match(entry.path().lexically_relative(place).string(), folder.files))
      written.push_back(entry.path());
  std::ranges::reverse(written);  // the content of a folder comes before it
  for (const fs::path& path : written)
    if (!is_folder(path) || fs::is_empty(path)) fs::remove(path);
}

void clear(const fs::path& directory) {
  if (fs::exists(directory / kCheckpointFile)) {
    fs::rename(directory / kCheckpointFile, directory / kOldCheckpointFile);
  }
  const fs::path page = directory / "report.html";
  if (fs::is_regular_file(page) && why_no_page(page).empty()) fs::remove(page);
  for (const FolderOfARun& folder : folders_of_a_run()) clear(directory, folder);
  for (const char* file : kFilesOfARun) fs::remove(directory / file);
}

}  // namespace

bool is_of_a_run(const fs::path& file, const fs::path& directory) {
  std::error_code error;  // of links that lead round in circles: who opens the file says so
  const fs::path place = fs::weakly_canonical(fs::absolute(file, error), error);
  const fs::path inside =
      place.lexically_relative(fs::weakly_canonical(fs::absolute(directory, error), error));
  if (error || inside.empty()) return false;
  const std::string name = inside.begin()->string();
  return name == kCheckpointFile || name == kOldCheckpointFile ||
         std::ranges::count(kFilesOfARun, name) > 0 ||
         std::ranges::count(folders_of_a_run(), name, &FolderOfARun::name) > 0;
}

FormerRun former_run_in(const fs::path& directory) {
  struct stat log {};
  if (stat((directory / "run.log").c_str(), &log) != 0) return {};
  return {log.st_ino, log.st_mtim.tv_sec, log.st_mtim.tv_nsec, log.st_size};
}

std::unique_ptr<DirectoryLock> prepare_result_directory(const fs::path& directory, bool resume,
                                                        const FormerRun& known) try {
  const std::string name = directory.string();
  if (fs::exists(directory) && !fs::is_directory(directory)) {
    throw InputError({name, 0, "is a file, so no result directory; give another with -o DIR"});
  }
  bool is_result = false;
  for (const char* file :
       {"summary.json", "run.log", kCheckpointFile, kCheckpointBeforeFile, kOldCheckpointFile}) {
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
  if (former_run_in(directory) != known)
    throw InputError({name, 0,
                      "another run has been at work in this directory since this one began, and its results "
                      "are left alone; give another directory with -o DIR, or run again to replace them"});
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
