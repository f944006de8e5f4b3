// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string>

#include "common/increment.hpp"

namespace polargrain {

/// How far an answer can be trusted.
enum class Quality {
  failed = -1,     ///< there is no answer; the step must be cut
  unreliable = 0,  ///< the numbers may guide an iteration but must not be committed
  good = 1         ///< the material's own tolerances are met
};

/// How well a stress is known that carries noise, as that of grains does: standard deviations of its error,
/// independent of each other and of other points. Zero where the stress is exact.
struct StressNoise {
  double symmetric = 0.0;  ///< of s11, of s22 and of the mean of s12 and s21, Pa
  double skew = 0.0;       ///< of s21 - s12, Pa
  double couple = 0.0;     ///< of m1 and of m2, N/m

  [[nodiscard]] bool is_zero() const { return symmetric == 0.0 && skew == 0.0 && couple == 0.0; }
};

/// What a material answers at one point.
struct Response {
  /// s11, s22, s33, s12, s21 in Pa and couple stresses m1, m2 in N/m.
  Vector7 stress = Vector7::Zero();
  /// d stress / d strain (Increment::strain), consistent with the increment evaluated; need not be symmetric.
  Matrix7 tangent = Matrix7::Zero();
  StressNoise noise;
  Quality quality = Quality::good;
  /// Why the answer is not good; empty when it is.
  std::string message;
  /// When the answer is not good: the fraction of the increment that should be tried instead, in (0, 1).
  double step_factor = 1.0;
};

}  // namespace polargrain
