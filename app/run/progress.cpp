// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/run/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>

#include "app/run/interrupt.hpp"
#include "common/standard_streams.hpp"

namespace polargrain::app {
namespace {
constexpr double kTerminalSeconds = 0.1;
constexpr double kSparseSeconds = 10.0;

/// The line of a terminal is renewed by control characters, which `tell` lets nobody print.
void renew_line(std::FILE* out, const std::string& line) {
  std::fputs("\r", out);
  tell(out, "{}", line);
  std::fputs("\033[K", out);
  std::fflush(out);
}
}  // namespace

std::string duration_text(double seconds) {
  const auto whole = static_cast<long>(std::lround(seconds));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
  return fmt::format("{} h {} min", whole / 3600, whole % 3600 / 60);
}

Progress::Style Progress::style_for(std::FILE* out, bool quiet) {
  if (quiet) return Style::quiet;
  return isatty(fileno(out)) != 0 ? Style::terminal : Style::sparse;
}

Progress::Progress(std::FILE* out, Style style, int steps) : out_(out), style_(style), steps_(steps) {}

void Progress::go_on(double time) {
  time_ = start_time_ = time;
}

void Progress::begin_step(int step) {
  step_ = step;
  iteration_ = 0;
  show(false);
}

void Progress::end_step(double time) {
  time_ = time;
  show(step_ == steps_);
}

void Progress::cells(std::size_t done, std::size_t total) {
  stop_if_interrupted();
  cells_done_ = done;
  cells_ = total;
  show(false);
}

void Progress::iterated(const fem::IterationReport& report) {
  stop_if_interrupted();
  iteration_ = report.iteration;
  residual_ = std::max(report.force_residual, report.moment_residual);
  show(false);
}

std::string Progress::line() const {
  std::string text = fmt::format("step {}/{}  iteration {}", step_, steps_, iteration_);
  if (cells_ > 0) text += fmt::format("  cells {}/{}", cells_done_, cells_);
  if (iteration_ > 0) text += fmt::format("  residual {:.1e}", residual_);
  const double elapsed = seconds_since(start_);
  if (time_ >= 1.0) {
    text += fmt::format("  done in {}", duration_text(elapsed));
  } else if (time_ > start_time_) {
    text += fmt::format("  left {}", duration_text(elapsed / (time_ - start_time_) * (1.0 - time_)));
  }
  return text;
}

void Progress::show(bool whole_line) {
  if (style_ == Style::quiet) return;
  const double wait = style_ == Style::terminal ? kTerminalSeconds : kSparseSeconds;
  const Clock::time_point now = Clock::now();
  if (!whole_line && seconds_of(now - shown_) < wait) return;
  shown_ = now;
  if (style_ == Style::terminal) {
    renew_line(out_, line());
    if (whole_line) tell(out_, "\n");
  } else {
    tell(out_, "{}\n", line());
  }
}

void Progress::warn(const std::string& text) {
  say("warning", text);
}

void Progress::note(const std::string& text) {
  say("note", text);
}

void Progress::say(const char* kind, const std::string& text) {
  if (style_ == Style::quiet) return;
  clear();
  tell(out_, "{}: {}\n", kind, text);
}

void Progress::clear() {
  if (style_ != Style::terminal) return;
  renew_line(out_, "");
}

}  // namespace polargrain::app
