// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "common/seconds.hpp"
#include "coupler/checkpoint/checkpoint.hpp"

namespace polargrain::app {

/// The checkpoints of a run: its last committed step in memory, and the one that is on the disk.
class RunCheckpoints {
 public:
  /// @param steps of the whole run @param seconds_between two that are written
  RunCheckpoints(std::filesystem::path directory, int steps, double seconds_between)
      : directory_(std::move(directory)), steps_(steps), seconds_between_(seconds_between) {}

  /// The run itself goes on from the one on the disk, which is of that step.
  void begin_from(int step);
  /// Takes the last committed step, so that it can be written whenever the run has to stop.
  void keep(std::unique_ptr<coupler::Checkpoint> last) { last_ = std::move(last); }
  /// Whether it is time to write one.
  [[nodiscard]] bool is_due() const;
  /// Writes the checkpoint kept last. @returns how many seconds it took; nothing when it is there already
  /// @throws RunError when it cannot be written; the one before stands
  std::optional<double> save();
  /// The next one is due after the usual time only.
  void postpone();
  /// Keeps anybody from resuming this run by mistake. A checkpoint that the run itself began from stays as it
  /// was. @returns whether a checkpoint was written, which is checkpoint.doubtful.h5 now
  bool forget();
  /// The directory of the run is elsewhere now. @param with_its_files or is a new, empty one
  void follow(const std::filesystem::path& directory, bool with_its_files);
  /// The step of the checkpoint on the disk; -1: no checkpoint.
  [[nodiscard]] int saved_step() const { return saved_step_; }
  /// The same in words.
  [[nodiscard]] std::string text() const;

 private:
  std::filesystem::path directory_;
  int steps_;
  double seconds_between_;
  Clock::time_point saved_ = Clock::now();
  int saved_step_ = -1;
  int begun_from_ = -1;
  std::unique_ptr<coupler::Checkpoint> last_;
};

}  // namespace polargrain::app
