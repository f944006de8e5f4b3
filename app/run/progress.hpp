// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cstdio>
#include <string>

#include "common/seconds.hpp"
#include "fem/solver/solver.hpp"

namespace polargrain::app {

/// Shows how far a run is. On a terminal: one line that renews itself ten times a second at most. Elsewhere:
/// a line now and then. Quiet: nothing. Also where a run notices that it was interrupted.
class Progress : public fem::Observer {
 public:
  enum class Style { quiet, sparse, terminal };
  /// quiet, or the style that suits the stream.
  static Style style_for(std::FILE* out, bool quiet);

  Progress(std::FILE* out, Style style, int steps);

  /// The run goes on from this time: the rest is reckoned from here.
  void go_on(double time);
  void begin_step(int step);
  /// A step has been committed: `time` of 1 is reached.
  void end_step(double time);
  void cells(std::size_t done, std::size_t total);
  void iterated(const fem::IterationReport& report) override;
  /// Something the user should know that ends nothing; a line of its own.
  void warn(const std::string& text);
  /// The same of something that is as it should be.
  void note(const std::string& text);
  /// Wipes the renewing line, so that other text can follow.
  void clear();

 private:
  void show(bool whole_line);
  void say(const char* kind, const std::string& text);
  [[nodiscard]] std::string line() const;

  std::FILE* out_;
  Style style_;
  int steps_;
  int step_ = 0;
  int iteration_ = 0;
  double residual_ = 0.0;
  double time_ = 0.0;
  double start_time_ = 0.0;
  std::size_t cells_done_ = 0;
  std::size_t cells_ = 0;
  Clock::time_point start_ = Clock::now();
  Clock::time_point shown_ = start_;
};

/// "4 min 20 s"
std::string duration_text(double seconds);

}  // namespace polargrain::app
