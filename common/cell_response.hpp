// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <array>
#include <string>
#include <type_traits>

#include <Eigen/Core>

#include "common/cosserat.hpp"
#include "common/response.hpp"

namespace polargrain {

/// Which components of stress and couple stress a cell can tell.
enum class KnownComponents {
  plane,  ///< discs: s11, s12, s21, s22, m13, m23. They have no s33, and nothing is said of it
  all     ///< grains in space
};

constexpr Choices choices_of(KnownComponents) {
  return {0, 2};
}

/// Places of the components KnownComponents::plane among the eighteen.
inline constexpr std::array<int, 6> kPlanePlaces{0, 1, 3, 4, 11, 14};

/// The answer of a cell, in space and in the laboratory (docs/theory/continuum.md, A.7). Components it cannot tell are zero,
/// and do not travel.
struct CellResponse : Trust {
  /// stress(i,j), Pa: i the normal of the face, j the direction of the force, tension positive.
  Eigen::Matrix3d stress = Eigen::Matrix3d::Zero();
  /// couple_stress(i,j), N/m: i the normal of the face, j the axis of the moment.
  Eigen::Matrix3d couple_stress = Eigen::Matrix3d::Zero();
  /// d stress / d strain. Rows: s11 s12 s13 s21 s22 s23 s31 s32 s33, then m11 to m33 the same. Columns: the strains conjugate
  /// to them, eps_ij = d u_j / d x_i - e_ijk w_k, then d w_j / d x_i.
  Matrix18 tangent = Matrix18::Zero();
  KnownComponents known = KnownComponents::all;

  /// Stress and couple stress in the order of the tangent.
  [[nodiscard]] Vector18 components() const {
    Vector18 all;
    all << stress.row(0).transpose(), stress.row(1).transpose(), stress.row(2).transpose(),
        couple_stress.row(0).transpose(), couple_stress.row(1).transpose(), couple_stress.row(2).transpose();
    return all;
  }
  void set_components(const Vector18& all) {
    for (int place = 0; place < 9; ++place) {
      stress(place / 3, place % 3) = all(place);
      couple_stress(place / 3, place % 3) = all(9 + place);
    }
  }
};

template <RecordOf<CellResponse> Record, class Visit>
void describe(Record& response, Visit&& visit) {
  const FieldNotes stress{"", "Pa, N/m", "stress s_ij and couple stress m_ij that are known"};
  const FieldNotes tangent{"tangent", "Pa, N", "d stress / d strain of the components that are known"};
  visit(FieldNotes{"known", "", "0 components of the plane, 1 all"}, response.known);
  if (response.known == KnownComponents::all) {
    Vector18 all = response.components();
    visit(stress, all);
    if constexpr (!std::is_const_v<Record>) response.set_components(all);
    visit(tangent, response.tangent);
  } else {
    Eigen::Matrix<double, 6, 1> stresses = response.components()(kPlanePlaces);
    Eigen::Matrix<double, 6, 6> slopes = response.tangent(kPlanePlaces, kPlanePlaces);
    visit(stress, stresses);
    visit(tangent, slopes);
    if constexpr (!std::is_const_v<Record>) {
      Vector18 all = Vector18::Zero();
      all(kPlanePlaces) = stresses;
      response.set_components(all);
      response.tangent.setZero();
      response.tangent(kPlanePlaces, kPlanePlaces) = slopes;
    }
  }
  describe(trust_of(response), visit);
}

}  // namespace polargrain
