// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <algorithm>
#include <cmath>

namespace polargrain::fem {

/// A way, from 0 to 1, that is gone whole, or in parts where it fails: shares of a step, or of the imbalance left by
/// a jump.
class Substeps {
 public:
  /// @param growth of a part behind one that went @param next length of the first part; 0: the whole way
  explicit Substeps(double growth, double next = 0.0) : growth_(growth), next_(next) {}

  [[nodiscard]] bool arrived() const { return done_ >= 1.0; }
  [[nodiscard]] double done() const { return done_; }
  /// Of the way that is tried now.
  [[nodiscard]] double share() const { return is_limited() ? limit_ : part(); }
  [[nodiscard]] double end() const { return is_limited() ? done_ + limit_ : is_part() ? done_ + next_ : 1.0; }
  /// The part that is tried now is no longer than this, which is no cut. A part that would leave less than itself leaves as much.
  void limit(double share) {
    const double left = 1.0 - done_;
    limit_ = share < left && left < 2.0 * share ? 0.5 * left : share;
  }
  /// Length of the part to come, for the way after this one; 0: nothing was cut.
  [[nodiscard]] double next() const { return next_; }
  [[nodiscard]] int cuts_in_a_row() const { return cuts_; }

  void went() {
    const double went = share();
    done_ = end();
    if (next_ > 0.0) next_ = std::max(next_, growth_ * went);
    cuts_ = 0;
  }
  void failed(double factor) {
    next_ = share() * std::clamp(factor, 0.1, 0.5);
    ++cuts_;
  }
  /// The way begins anew, with parts as long as now.
  void begin_again() { done_ = 0.0; }

 private:
  static constexpr double kNearlyAll = 1.0 - 1e-6;
  [[nodiscard]] bool is_part() const { return next_ > 0.0 && next_ < kNearlyAll * (1.0 - done_); }
  [[nodiscard]] double part() const { return is_part() ? next_ : 1.0 - done_; }
  [[nodiscard]] bool is_limited() const { return limit_ < kNearlyAll * part(); }

  double growth_;
  double next_;
  double done_ = 0.0;
  double limit_ = HUGE_VAL;
  int cuts_ = 0;
};

}  // namespace polargrain::fem
