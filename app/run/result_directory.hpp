// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace polargrain::app {

/// Where a run writes when it is not told: results/NAME in the current directory, NAME being the case file's
/// name without its ending, or that of its folder when the file is called case.yaml.
std::filesystem::path default_result_directory(const std::filesystem::path& case_file);

constexpr const char* kCheckpointFile = "checkpoint.h5";
constexpr const char* kCheckpointBeforeFile = "checkpoint.before.h5";  ///< coupler::checkpoint_before
constexpr const char* kOldCheckpointFile = "checkpoint.old.h5";

/// Somebody renamed or removed the result directory during the run.
struct Displacement {
  std::filesystem::path now;  ///< where it is; empty when it was removed
  std::string text;           ///< the event, for the user
};

/// While it lives no other run can write to the directory; the lock goes with the process, however that ends.
/// File systems that know no locks do without.
class DirectoryLock {
 public:
  /// @throws InputError when another run is at work there
  explicit DirectoryLock(const std::filesystem::path& directory);
  ~DirectoryLock();
  DirectoryLock(const DirectoryLock&) = delete;
  DirectoryLock& operator=(const DirectoryLock&) = delete;

  /// @returns nothing while its name still leads to the directory
  [[nodiscard]] std::optional<Displacement> displacement() const;

 private:
  std::filesystem::path directory_;
  int descriptor_;
};

/// The run that has been at work in a directory, by its log, which every run writes. Two of them tell whether another run came between.
struct FormerRun {
  std::uint64_t file = 0;
  std::int64_t seconds = 0;  ///< of its last line, with the next
  std::int64_t nanoseconds = 0;
  std::int64_t size = 0;
  bool operator==(const FormerRun&) const = default;
};
FormerRun former_run_in(const std::filesystem::path& directory);

/// Makes the directory, locks it, and empties it of the files of a former run, known by their names. Anything else stays, also in
/// its folders, and a report.html that is no page of polargrain. A former checkpoint is kept once, as checkpoint.old.h5. To
/// resume: leaves all as it is.
/// @param known the run that was there when this one began: of two that begin together the later one stops
/// @throws InputError when it exists, is not empty and holds no former result (summary.json, run.log or a
/// checkpoint): nothing of the user's own is ever mixed with results; when another run is at work in it; to
/// resume, when it holds no run. RunError when it cannot be made or written.
[[nodiscard]] std::unique_ptr<DirectoryLock> prepare_result_directory(const std::filesystem::path& directory,
                                                                      bool resume, const FormerRun& known);

/// Whether a file is, or would be, one of those that a run writes into its result directory, or lies in a folder of them:
/// report.html and the files of `band` are not of them.
bool is_of_a_run(const std::filesystem::path& file, const std::filesystem::path& directory);

/// A place for the rest of a run whose directory was removed: its name again, or, when something else has that
/// name by now, NAME.rescued. @throws RunError when it cannot be made
std::filesystem::path make_rescue_directory(const std::filesystem::path& directory);

}  // namespace polargrain::app
