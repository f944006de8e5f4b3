// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/run/run_checkpoints.hpp"

#include <fmt/format.h>
#include <malloc.h>

#include <system_error>

#include "app/run/result_directory.hpp"

namespace polargrain::app {
void RunCheckpoints::begin_from(int step) {
  saved_step_ = step;
  begun_from_ = step;
}

bool RunCheckpoints::is_due() const {
  return saved_step_ < 0 || seconds_since(saved_) >= seconds_between_;
}

std::optional<double> RunCheckpoints::save() {
  if (!last_ || last_->step == saved_step_) return std::nullopt;
  const Clock::time_point begin = Clock::now();
  // The pool keeps the memory of freed states for those to come, and would keep that of the file's image as well: they are
  // not needed at the same time.
  malloc_trim(0);
  write_checkpoint(directory_ / kCheckpointFile, *last_);
  malloc_trim(0);
  saved_ = Clock::now();
  saved_step_ = last_->step;
  return seconds_of(saved_ - begin);
}

void RunCheckpoints::postpone() {
  saved_ = Clock::now();
}

bool RunCheckpoints::forget() {
  last_.reset();
  if (saved_step_ <= begun_from_) return false;
  std::error_code error;
  std::filesystem::rename(directory_ / kCheckpointFile, directory_ / "checkpoint.doubtful.h5", error);
  saved_step_ = -1;
  return true;
}

void RunCheckpoints::follow(const std::filesystem::path& directory, bool with_its_files) {
  directory_ = directory;
  if (!with_its_files) saved_step_ = -1;
}

std::string RunCheckpoints::text() const {
  return saved_step_ < 0 ? "no checkpoint has been written yet"
                         : fmt::format("the last one is of step {} of {}", saved_step_, steps_);
}

}  // namespace polargrain::app
