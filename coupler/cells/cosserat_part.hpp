// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <optional>

#include "common/increment.hpp"
#include "common/response.hpp"

namespace polargrain::coupler {

/// The part of a point's answer that a cell with free rotations does not give (docs/theory.md, C.6 mode 1 and
/// A.4).
struct CosseratParameters {
  double shear_modulus = 0.0;           ///< G, Pa
  double cosserat_shear_modulus = 0.0;  ///< Gc, Pa
  double internal_length = 0.0;         ///< lc, m; the couple modulus is 2 G lc^2
  /// lp, m: the couple stress is at most lp times the pressure in the plane; nothing: it has no limit
  std::optional<double> plastic_length = {};

  [[nodiscard]] double couple_modulus() const {
    return 2.0 * shear_modulus * internal_length * internal_length;
  }
};

/// Skew stress and couple stresses of a point, which accumulate from its increments:
///
///     s21 - s12  +=  2 Gc (eps21 - eps12)        m_i  +=  2 G lc^2 kappa_i
///
/// In large deformation the curvature is that of the stretch of the step, and the couple stress then turns with the
/// material (fem/material/rotation.hpp); the skew stress is the same in any frame. With a plastic length lp the couple stress is elastic and perfectly plastic: where
/// |m| would exceed lp p, p = -(s11 + s22) / 2 of the cell at the end of the increment, it returns radially to that circle
/// (closed form, backward Euler; docs/theory/grains.md, C.6). In tension there is none.
struct CosseratPart {
  double skew_stress = 0.0;                                 ///< s21 - s12, Pa
  Eigen::Vector2d couple_stress = Eigen::Vector2d::Zero();  ///< N/m

  /// Goes along an increment. @param cell what the cell answered to it @returns the answer of the point, as joined_to,
  /// with the tangent of the couple stress that has reached its limit
  Response follow(const Increment& increment, const Response& cell, const CosseratParameters& cosserat);
  /// The answer of a point where nothing has happened: the symmetric part of what its cell answered, with this part.
  [[nodiscard]] Response joined_to(const Response& cell, const CosseratParameters& cosserat) const;
};

template <RecordOf<CosseratPart> Record, class Visit>
void describe(Record& part, Visit&& visit) {
  visit(FieldNotes{"skew_stress", "Pa", "s21 - s12"}, part.skew_stress);
  visit(FieldNotes{"couple_stress", "N/m", "couple stress", "_1 _2"}, part.couple_stress);
}

/// The symmetric part of a stress or a strain, without couples or curvatures: what a cell with free rotations answers
/// and feels.
Vector7 symmetric_part(const Vector7& components);

/// The tangent of the symmetric stress with respect to the Cosserat strain: mean of the two shear rows, and,
/// because a cell with free rotations feels eps12 and eps21 through their sum alone, mean of the two shear
/// columns. Nothing in the rows and columns of the curvatures.
Matrix7 symmetric_tangent(const Matrix7& cell);

}  // namespace polargrain::coupler
