// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "common/seconds.hpp"
namespace polargrain::fem {

/// Adds the wall time of its life to a sum.
class Stopwatch {
 public:
  explicit Stopwatch(double& sum) : sum_(sum) {}
  ~Stopwatch() { sum_ += seconds_since(start_); }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  double& sum_;
  Clock::time_point start_ = Clock::now();
};

}  // namespace polargrain::fem
