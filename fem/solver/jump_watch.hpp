// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string>
#include <vector>

namespace polargrain::fem {

/// Tells a step that is too long from one that no cut will help. Where stresses follow the strain without
/// jumps, the residual that the predictor leaves falls at least in proportion with the step; where they jump,
/// as those of few grains do when their contacts rearrange, it tends to the height of the jump instead.
class JumpWatch {
 public:
  /// An attempt at `share` of a step has failed. @param residual after its predictor @param excess the same
  /// over its tolerance
  void failed(double share, double residual, double excess) {
    attempts_.push_back({share, residual, excess});
  }
  /// A substep was committed: the next one starts elsewhere.
  void clear() { attempts_.clear(); }
  /// Whether the attempts since the last substep show a jump.
  [[nodiscard]] bool seen() const { return longer_with_as_much() != nullptr; }
  /// The same for people; empty while they show no jump.
  [[nodiscard]] std::string statement() const;

 private:
  struct Attempt {
    double share;
    double residual;
    double excess;
  };
  /// The last attempt that was much longer than the present one, when it left hardly more; else null.
  [[nodiscard]] const Attempt* longer_with_as_much() const;

  std::vector<Attempt> attempts_;
};

}  // namespace polargrain::fem
