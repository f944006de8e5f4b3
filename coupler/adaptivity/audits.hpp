// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cstdint>
#include <utility>
#include <vector>

namespace polargrain::coupler {

/// A number in [0, 1) that depends on its three arguments alone: the same on every machine and in every run.
double hashed_share(std::uint64_t seed, std::uint64_t first, std::uint64_t second);

/// Errors that were measured, for their mean, 95th percentile and maximum.
class MeasuredErrors {
 public:
  MeasuredErrors() = default;
  explicit MeasuredErrors(std::vector<double> errors) : errors_(std::move(errors)) {}
  void add(double error) { errors_.push_back(error); }
  [[nodiscard]] std::size_t count() const { return errors_.size(); }
  /// 0 without any.
  [[nodiscard]] double mean() const;
  /// The smallest error that at least this share of all do not exceed; 0 without any.
  [[nodiscard]] double percentile(double share) const;
  [[nodiscard]] double largest() const { return percentile(1.0); }
  [[nodiscard]] const std::vector<double>& all() const { return errors_; }

 private:
  std::vector<double> errors_;
};

}  // namespace polargrain::coupler
