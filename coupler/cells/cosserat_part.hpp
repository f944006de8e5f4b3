// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <optional>

#include "common/increment.hpp"
#include "common/response.hpp"

namespace polargrain::coupler {

/// The part of a point's answer that a cell with free rotations does not give (docs/theory/grains.md, C.6).
struct CosseratParameters {
  double shear_modulus = 0.0;           ///< G, Pa
  double cosserat_shear_modulus = 0.0;  ///< Gc, Pa
  double internal_length = 0.0;         ///< lc, m; the couple modulus is 2 G lc^2
  /// lp, m: the couple stress is at most lp times the pressure in the plane; nothing: it has no limit
  std::optional<double> plastic_length = {};
  /// The skew stress |s21 - s12| is at most so many times the pressure in the plane; nothing: it has no limit
  std::optional<double> skew_limit = {};
  bool has_rotations = true;  ///< false: the continuum has no micro-rotation that could lose its hold

  [[nodiscard]] double couple_modulus() const {
    return 2.0 * shear_modulus * internal_length * internal_length;
  }
};

/// The limits of its grains that a point has reached.
struct LimitsReached {
  bool parted = false;  ///< the grains carry no pressure that counts
  bool skew = false;
  bool couple = false;
  /// Nothing resists the micro-rotation: neither skew nor couple stress changes with it. Its stiffness is numerical.
  bool held = false;
};

/// Skew stress and couple stresses of a point: elastic and perfectly plastic, with limits that go with the pressure
/// p = -(s11 + s22) / 2 of the cell at the end of the increment (docs/theory/grains.md, C.6):
///
///     s21 - s12  +=  2 Gc s (eps21 - eps12)    |s21 - s12| <= skew_limit p
///     m_i        +=  2 G lc^2 s kappa_i        |m| <= lp p
///
/// s is the share of its contacts that the cell has kept, at the start of the increment. A stress beyond its limit
/// returns to it radially (backward Euler). Without pressure a stress that has a limit is zero. In large deformation the
/// curvature is that of the stretch of the step, and the couple stress then turns with the material
/// (fem/material/rotation.hpp); the skew stress is the same in any frame.
///
/// Where a stress is at its limit nothing is left of its stiffness but kHold of that of the packing. This stiffness
/// is in the tangent alone and adds no stress: it keeps a micro-rotation solvable that nothing else resists.
struct CosseratPart {
  /// Share of Gc, and of the couple modulus, that the tangent keeps at the limits of skew and couple stress.
  static constexpr double kHold = 0.02;

  double skew_stress = 0.0;                                 ///< s21 - s12, Pa
  Eigen::Vector2d couple_stress = Eigen::Vector2d::Zero();  ///< N/m
  double contacts_kept = 1.0;  ///< s: contacts of the cell over those of its packing
  double pressure = 0.0;       ///< of the cell at the end of the last increment, Pa

  /// Goes along an increment. @param cell the answer of the cell to it @param kept contacts of the cell now over those
  /// of its packing @returns the answer of the point, as joined_to, with the tangent of the stresses that are at their limits
  Response<2> follow(const Increment<2>& increment, const Response<2>& cell,
                     const CosseratParameters& cosserat, double kept);
  /// The answer of a point where nothing has happened: the symmetric part of the answer of its cell, with this part.
  [[nodiscard]] Response<2> joined_to(const Response<2>& cell, const CosseratParameters& cosserat) const;
  /// Reduces both stresses to the limits of a cell under `pressure` (Pa).
  void keep_within(const CosseratParameters& cosserat, double new_pressure);

  /// @param least pressure below which grains count as parted, Pa
  [[nodiscard]] LimitsReached reached(const CosseratParameters& cosserat, double least) const;
  /// The stress over its limit, 0 to 1; 0 where it has no limit or there is no pressure.
  [[nodiscard]] double skew_mobilisation(const CosseratParameters& cosserat) const;
  [[nodiscard]] double couple_mobilisation(const CosseratParameters& cosserat) const;
};

template <RecordOf<CosseratPart> Record, class Visit>
void describe(Record& part, Visit&& visit) {
  visit(FieldNotes{"skew_stress", "Pa", "s21 - s12"}, part.skew_stress);
  visit(FieldNotes{"couple_stress", "N/m", "couple stress", "_1 _2"}, part.couple_stress);
  visit(FieldNotes{"contacts_kept", "1", "contacts of the cell over those of its packing"},
        part.contacts_kept);
  visit(FieldNotes{"pressure", "Pa", "of the cell in the plane"}, part.pressure);
}

/// Mean pressure in the plane, Pa.
inline double pressure_in_plane(const Vector7& stress) {
  return -0.5 * (stress[k11] + stress[k22]);
}

/// A stress over `limit` times the pressure, 0 to 1; 0 where it has no limit or there is no pressure.
double share_of_limit(double stress, std::optional<double> limit, double pressure);

/// The limits that a part has reached, in the plane as in space.
/// @param skew, couple the shares of their limits @param contacts_kept, pressure of the part @param least pressure below which
/// grains count as parted, Pa
LimitsReached limits_reached_at(const CosseratParameters& cosserat, double skew, double couple,
                                double contacts_kept, double pressure, double least);

/// The share of a stiffness that the tangent keeps of a stress which returns from `trial` to its limit. From far beyond, an
/// iteration gone astray, the secant leads back; the hold alone would throw it as far to the other side, again and again.
double share_held(double trial, double limit);

/// Returns the skew stress of an answer to its limit, if it is beyond, and gives the tangent the rows of that.
/// @param skew_limit |s21 - s12| over the pressure @param modulus Gc of the packing, Pa, of which the tangent keeps kHold
/// @returns whether it was beyond
bool limit_skew(Response<2>& response, double skew_limit, double modulus);

/// The symmetric part of a stress or a strain, without couples or curvatures: the answer and the strain of a cell with free
/// rotations.
Vector7 symmetric_part(const Vector7& components);

/// The tangent of the symmetric stress with respect to the Cosserat strain: mean of the two shear rows, and,
/// because a cell with free rotations feels eps12 and eps21 through their sum alone, mean of the two shear
/// columns. Nothing in the rows and columns of the curvatures.
Matrix7 symmetric_tangent(const Matrix7& cell);

}  // namespace polargrain::coupler
