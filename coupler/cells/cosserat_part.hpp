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
  /// lp, m: the couple stress is at most lp times the pressure about it; nothing: it has no limit
  std::optional<double> plastic_length = {};
  /// The skew stress is at most so many times the pressure about it; nothing: it has no limit
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

/// The pressures about the axes of rotation, Pa: P_kl = -(tr s d_kl - (s_kl + s_lk) / 2) / 2, so that n P n is the mean
/// pressure in the plane normal to n, in which grains turn about n. In the plane it has one component,
/// -(s11 + s22) / 2. The mean of its diagonal is the pressure of the dimension: in space the mean pressure.
template <int dim>
using Pressures = Eigen::Matrix<double, Cosserat<dim>::rotations, Cosserat<dim>::rotations>;
template <int dim>
Pressures<dim> pressures_of(const typename Cosserat<dim>::Vector& stress);

/// The pressure of the dimension, Pa: in the plane -(s11 + s22) / 2, in space the mean pressure.
template <int dim>
double pressure_of(const typename Cosserat<dim>::Vector& stress) {
  double sum = 0.0;
  for (int i = 0; i < dim; ++i) sum += stress(Cosserat<dim>::stress_place(i, i));
  return -sum / dim;
}

/// Skew stress and couple stresses of a point: elastic and perfectly plastic, with limits that go with the pressures of the
/// cell at the end of the increment (docs/theory/grains.md, C.6):
///
///     t_k = s_ji - s_ij, (i, j, k) cyclic  +=  2 Gc s (the same of the strain)    |t| <= skew_limit p_t
///     m_ik                                 +=  2 G lc^2 s kappa_ik                |m| <= lp p_m
///
/// In the plane t is s21 - s12 and both pressures are -(s11 + s22) / 2. In space p_t is the pressure about the axis of t, and
/// p_m the mean of those about the axes of m, each weighted by the square of its moments: grains that turn about an axis roll
/// and slide in the plane normal to it, and a body in plane strain has the limits of the plane.
///
/// s is the share of its contacts that the cell has kept, at the start of the increment. A stress beyond its limit
/// returns to it radially (backward Euler). Without pressure a stress that has a limit is zero. In large deformation the
/// curvature is that of the stretch of the step, and both stresses then turn with the material
/// (fem/material/rotation.hpp); in the plane the skew stress is the same in any frame.
///
/// Where a stress is at its limit nothing is left of its stiffness but kHold of that of the packing. This stiffness
/// is in the tangent alone and adds no stress: it keeps a micro-rotation solvable that nothing else resists.
template <int dim>
struct CosseratPart {
  /// Share of Gc, and of the couple modulus, that the tangent keeps at the limits of skew and couple stress.
  static constexpr double kHold = 0.02;

  using Dimension = Cosserat<dim>;
  using Skew = typename Dimension::Rotation;
  using Couples = Eigen::Matrix<double, Dimension::couples, 1>;

  Skew skew_stress = Skew::Zero();          ///< t, Pa
  Couples couple_stress = Couples::Zero();  ///< m, in the order of Cosserat<dim>, N/m
  double contacts_kept = 1.0;               ///< s: contacts of the cell over those of its packing
  /// Of the cell at the end of the last increment, Pa.
  Pressures<dim> pressures = Pressures<dim>::Zero();

  /// Goes along an increment. @param cell the answer of the cell to it @param kept contacts of the cell now over those
  /// of its packing @returns the answer of the point, as joined_to, with the tangent of the stresses that are at their limits
  Response<dim> follow(const Increment<dim>& increment, const Response<dim>& cell,
                       const CosseratParameters& cosserat, double kept);
  /// The answer of a point where nothing has happened: the symmetric part of the answer of its cell, with this part.
  [[nodiscard]] Response<dim> joined_to(const Response<dim>& cell, const CosseratParameters& cosserat) const;
  /// Reduces both stresses to the limits of a cell under these pressures (Pa).
  void keep_within(const CosseratParameters& cosserat, const Pressures<dim>& new_pressures);

  /// The pressure of the dimension, Pa.
  [[nodiscard]] double pressure() const { return pressures.trace() / Dimension::rotations; }
  /// @param least pressure below which grains count as parted, Pa
  [[nodiscard]] LimitsReached reached(const CosseratParameters& cosserat, double least) const;
  /// The stress over its limit, 0 to 1; 0 where it has no limit or there is no pressure.
  [[nodiscard]] double skew_mobilisation(const CosseratParameters& cosserat) const;
  [[nodiscard]] double couple_mobilisation(const CosseratParameters& cosserat) const;

  template <RecordOf<CosseratPart> Record, class Visit>
  friend void describe(Record& part, Visit&& visit) {
    visit(FieldNotes{"skew_stress", "Pa", "s21 - s12; in space s32 - s23, s13 - s31, s21 - s12"},
          part.skew_stress);
    visit(FieldNotes{"couple_stress", "N/m", "couple stress"}, part.couple_stress);
    visit(FieldNotes{"contacts_kept", "1", "contacts of the cell over those of its packing"},
          part.contacts_kept);
    visit(FieldNotes{"pressures", "Pa", "of the cell, about the axes of rotation"}, part.pressures);
  }
};

/// The pressure about the axis of a skew stress, and the mean of those about the axes of couple stresses, Pa. Without such a
/// stress it is the pressure of the dimension.
template <int dim>
double pressure_about(const Pressures<dim>& pressures, const typename Cosserat<dim>::Rotation& skew_stress);
template <int dim>
double pressure_about_couples(const Pressures<dim>& pressures,
                              const Eigen::Matrix<double, Cosserat<dim>::couples, 1>& couple_stress);

/// A stress over `limit` times the pressure about it, 0 to 1; 0 where it has no limit or there is no pressure.
double share_of_limit(double stress, std::optional<double> limit, double pressure);

/// The share of a stiffness that the tangent keeps of a stress which returns from `trial` to its limit. From far beyond, an
/// iteration gone astray, the secant leads back; the hold alone would throw it as far to the other side, again and again.
double share_held(double trial, double limit);

/// The skew stress of a stress, Pa.
template <int dim>
typename Cosserat<dim>::Rotation skew_stress_of(const typename Cosserat<dim>::Vector& stress);

/// Returns the skew stress of an answer to its limit, if it is beyond, and gives the tangent the rows of that.
/// @param skew_limit of the skew stress over the pressure about it @param modulus Gc of the packing, Pa, of which the tangent
/// keeps CosseratPart::kHold @returns whether it was beyond
template <int dim>
bool limit_skew(Response<dim>& response, double skew_limit, double modulus);

/// The symmetric part of a stress or a strain, without couples or curvatures: the answer and the strain of a cell with free
/// rotations.
template <int dim>
typename Cosserat<dim>::Vector symmetric_part(const typename Cosserat<dim>::Vector& components);

/// The tangent of the symmetric stress with respect to the Cosserat strain: means of the rows of each two shear stresses, and,
/// because a cell with free rotations feels eps_ij and eps_ji through their sum alone, means of their
/// columns. Nothing in the rows and columns of the curvatures.
template <int dim>
typename Cosserat<dim>::Matrix symmetric_tangent(const typename Cosserat<dim>::Matrix& cell);

}  // namespace polargrain::coupler
