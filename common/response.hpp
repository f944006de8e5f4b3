// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string>

#include "common/cosserat.hpp"
#include "common/record.hpp"

namespace polargrain {

/// How far an answer can be trusted.
enum class Quality {
  failed = -1,     ///< there is no answer; the step must be cut
  unreliable = 0,  ///< the numbers may guide an iteration but must not be committed
  good = 1         ///< the material's own tolerances are met
};

constexpr Choices choices_of(Quality) {
  return {-1, 3};
}

/// How well a stress is known that carries noise, as that of grains does: standard deviations of its error,
/// independent of each other and of other points. Zero where the stress is exact.
struct StressNoise {
  double symmetric = 0.0;  ///< of s11, of s22 and of the mean of s12 and s21, Pa
  double skew = 0.0;       ///< of s21 - s12, Pa
  double couple = 0.0;     ///< of m1 and of m2, N/m

  [[nodiscard]] bool is_zero() const { return symmetric == 0.0 && skew == 0.0 && couple == 0.0; }
};

template <RecordOf<StressNoise> Record, class Visit>
void describe(Record& noise, Visit&& visit) {
  visit(FieldNotes{"symmetric", "Pa",
                   "standard deviation of the errors of s11, of s22 and of the mean of s12 and s21"},
        noise.symmetric);
  visit(FieldNotes{"skew", "Pa", "standard deviation of the error of s21 - s12"}, noise.skew);
  visit(FieldNotes{"couple", "N/m", "standard deviation of the errors of m1 and m2"}, noise.couple);
}

/// How far an answer can be trusted, and what to do where it cannot.
struct Trust {
  StressNoise noise;
  Quality quality = Quality::good;
  /// Why the answer is not good; empty when it is.
  std::string message;
  /// When the answer is not good: the fraction of the increment that should be tried instead, in (0, 1).
  double step_factor = 1.0;
};

template <RecordOf<Trust> Record, class Visit>
void describe(Record& trust, Visit&& visit) {
  visit(FieldNotes{"noise", "Pa, N/m", "how well the stress is known"}, trust.noise);
  visit(FieldNotes{"quality", "", "-1 failed, 0 unreliable, 1 good"}, trust.quality);
  visit(FieldNotes{"message", "", "why the answer is not good"}, trust.message);
  visit(
      FieldNotes{"step_factor", "1", "fraction of the increment to try instead, when the answer is not good"},
      trust.step_factor);
}

/// The trust in an answer, for its description.
inline const Trust& trust_of(const Trust& answer) {
  return answer;
}
inline Trust& trust_of(Trust& answer) {
  return answer;
}

/// The answer of a material at one point.
template <int dim>
struct Response : Trust {
  /// Stresses in Pa and couple stresses in N/m, in the order of Cosserat<dim>.
  typename Cosserat<dim>::Vector stress = Cosserat<dim>::Vector::Zero();
  /// d stress / d strain (Increment::strain), consistent with the increment evaluated; need not be symmetric. In large
  /// deformation stress and strain are both in the axes of the end of the step, along which the stretch has turned.
  typename Cosserat<dim>::Matrix tangent = Cosserat<dim>::Matrix::Zero();
};

template <RecordOf<Response<3>> Record, class Visit>
void describe(Record& response, Visit&& visit) {
  visit(FieldNotes{"", "Pa, N/m",
                   "stress s_ij (i: normal of the face, tension positive), then couple stress m_ij"},
        response.stress);
  visit(FieldNotes{"tangent", "Pa, N", "d stress / d strain, both in the order of the stress"},
        response.tangent);
  describe(trust_of(response), visit);
}

template <RecordOf<Response<2>> Record, class Visit>
void describe(Record& response, Visit&& visit) {
  visit(
      FieldNotes{"", "Pa, N/m", "stress s_ij (i: normal of the face, tension positive) and couple stress m_i",
                 "s11 s22 s33 s12 s21 m1 m2"},
      response.stress);
  visit(FieldNotes{"tangent", "Pa, N", "d stress / d strain, both in the order of the stress",
                   "_11 _12 _13 _14 _15 _16 _17 _21 _22 _23 _24 _25 _26 _27 _31 _32 _33 _34 _35 _36 _37 "
                   "_41 _42 _43 _44 _45 _46 _47 _51 _52 _53 _54 _55 _56 _57 _61 _62 _63 _64 _65 _66 _67 "
                   "_71 _72 _73 _74 _75 _76 _77"},
        response.tangent);
  describe(trust_of(response), visit);
}

}  // namespace polargrain
