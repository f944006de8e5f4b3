// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>

#include "common/increment.hpp"
#include "common/response.hpp"
#include "coupler/cells/cosserat_part.hpp"

namespace polargrain::coupler {

/// CosseratPart in space: skew stress and couple stresses of a point whose cell has free rotations, elastic and perfectly
/// plastic, with limits that go with the mean pressure p = -(s11 + s22 + s33) / 3 of the cell at the end of the increment:
///
///     t = (s32 - s23, s13 - s31, s21 - s12)  +=  2 Gc s (the same of the strain)    |t| <= skew_limit p
///     m_ij  +=  2 G lc^2 s kappa_ij                                            |m| <= lp p
///
/// s, the return to the limits, the hold and large deformation are those of CosseratPart.
struct SpaceCosseratPart {
  Eigen::Vector3d skew_stress = Eigen::Vector3d::Zero();  ///< s32 - s23, s13 - s31, s21 - s12, Pa
  /// m11 m12 .. m33, N/m
  Eigen::Matrix<double, 9, 1> couple_stress = Eigen::Matrix<double, 9, 1>::Zero();
  double contacts_kept = 1.0;  ///< contacts of the cell over those of its packing
  double pressure = 0.0;       ///< mean, of the cell at the end of the last increment, Pa

  /// Goes along an increment. @param cell the answer of the cell to it @param kept contacts of the cell now over those
  /// of its packing @returns the answer of the point, with the tangent of the stresses that are at their limits
  Response<3> follow(const Increment<3>& increment, const Response<3>& cell,
                     const CosseratParameters& cosserat, double kept);
  /// The answer of a point where nothing has happened: the symmetric part of the answer of its cell, with this part.
  [[nodiscard]] Response<3> joined_to(const Response<3>& cell, const CosseratParameters& cosserat) const;
  /// Reduces both stresses to the limits of a cell under `pressure` (Pa).
  void keep_within(const CosseratParameters& cosserat, double new_pressure);

  /// @param least pressure below which grains count as parted, Pa
  [[nodiscard]] LimitsReached reached(const CosseratParameters& cosserat, double least) const;
  /// The stress over its limit, 0 to 1; 0 where it has no limit or there is no pressure.
  [[nodiscard]] double skew_mobilisation(const CosseratParameters& cosserat) const;
  [[nodiscard]] double couple_mobilisation(const CosseratParameters& cosserat) const;
};

template <RecordOf<SpaceCosseratPart> Record, class Visit>
void describe(Record& part, Visit&& visit) {
  visit(FieldNotes{"skew_stress", "Pa", "s32 - s23, s13 - s31, s21 - s12", "_1 _2 _3"}, part.skew_stress);
  visit(FieldNotes{"couple_stress", "N/m", "couple stress m11, m12 to m33"}, part.couple_stress);
  visit(FieldNotes{"contacts_kept", "1", "contacts of the cell over those of its packing"},
        part.contacts_kept);
  visit(FieldNotes{"pressure", "Pa", "mean pressure of the cell"}, part.pressure);
}

/// Mean pressure in space, Pa.
inline double mean_pressure(const Vector18& stress) {
  return -(stress(0) + stress(4) + stress(8)) / 3.0;
}

}  // namespace polargrain::coupler
