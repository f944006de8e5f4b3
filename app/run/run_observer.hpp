// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <spdlog/spdlog.h>

#include <cstdio>
#include <functional>
#include <string>

#include "app/run/progress.hpp"

namespace polargrain::app {

/// Shows progress to the user and writes events to the log.
class RunObserver : public Progress {
 public:
  RunObserver(Style style, int steps, spdlog::logger& log) : Progress(stderr, style, steps), log_(log) {}
  void iterated(const fem::IterationReport& report) override {
    log_.info("  iteration {}: force residual {:.3e}, moment residual {:.3e}", report.iteration,
              report.force_residual, report.moment_residual);
    Progress::iterated(report);
  }
  void cut(double time, const std::string& reason, double next_time) override {
    log_.warn("  step to {:.6g} given up: {}; next try to {:.6g}", time, reason, next_time);
  }
  void solves(const std::string& text) override { log_.info("  {}", text); }
  void struggles(const fem::Trouble& trouble) override {
    if (on_struggle) on_struggle(trouble);
  }
  std::function<void(const fem::Trouble&)>
      on_struggle;  ///< the advice when a step is cut for the second time

 private:
  spdlog::logger& log_;
};

/// Logs the outcome of a step. @param largest_strain that corrections are shortened to
void log_step(spdlog::logger& log, const fem::StepReport& report, double largest_strain);

}  // namespace polargrain::app
