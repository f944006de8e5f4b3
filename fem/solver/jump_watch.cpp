// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/solver/jump_watch.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace polargrain::fem {

const JumpWatch::Attempt* JumpWatch::longer_with_as_much() const {
  // Noise and kinks may keep a residual from falling once; over so much of a cut they cannot.
  constexpr double kCut = 8.0;
  constexpr double kLeft = 0.5;  // in proportion, an eighth would be left
  if (attempts_.empty()) return nullptr;
  const Attempt& last = attempts_.back();
  const auto longer = std::find_if(attempts_.rbegin(), attempts_.rend(),
                                   [&](const Attempt& of) { return of.share >= kCut * last.share; });
  if (longer == attempts_.rend() || last.excess <= 1.0 || last.residual < kLeft * longer->residual)
    return nullptr;
  return &*longer;
}

std::string JumpWatch::statement() const {
  const Attempt* const longer = longer_with_as_much();
  if (longer == nullptr) return {};
  const Attempt& last = attempts_.back();
  return fmt::format(
      "; the stresses jump here, however small the strain: the predictor leaves a residual of {:.3g} at "
      "{:.2g} of the step, and still {:.3g} at {:.2g}",
      longer->residual, longer->share, last.residual, last.share);
}

}  // namespace polargrain::fem
