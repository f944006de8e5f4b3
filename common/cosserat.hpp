// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <type_traits>

namespace polargrain {

/// The counts and types of a Cosserat continuum in the plane (2, plane strain) and in space (3).
///
/// Components of a stress vector and of the strain vector conjugate to it:
/// - plane: s11 s22 s33 s12 s21 m1 m2 (Component in increment.hpp), with m1 = m13, m2 = m23;
/// - space: s11 s12 s13 s21 .. s33, then m11 m12 .. m33 alike.
/// First index of a stress and of a couple stress: normal of the face. Strains: eps_ij = d u_j / d x_i - e_ijk w_k and
/// kappa_ij = d w_j / d x_i.
template <int dim>
struct Cosserat {
  static_assert(dim == 2 || dim == 3);
  static constexpr int rotations = dim == 2 ? 1 : 3;  ///< of a node: about e_3, or about e_1, e_2, e_3
  static constexpr int dofs = dim + rotations;        ///< of a node: displacements, then micro-rotations
  static constexpr int stresses = dim == 2 ? 5 : 9;   ///< with s33 of the plane
  static constexpr int couples = dim == 2 ? 2 : 9;
  static constexpr int components = stresses + couples;

  using Vector = Eigen::Matrix<double, components, 1>;           ///< stress or strain
  using Matrix = Eigen::Matrix<double, components, components>;  ///< tangent
  using Place = Eigen::Matrix<double, dim, 1>;
  using Gradient = Eigen::Matrix<double, dim, dim>;
  using Rotation = Eigen::Matrix<double, rotations, 1>;
  using NodeValues = Eigen::Matrix<double, dofs, 1>;

  /// Number of s_ij among the components; i, j from 0.
  [[nodiscard]] static constexpr int stress_place(int i, int j) {
    if constexpr (dim == 2) {
      return i == j ? i : 3 + i;
    } else {
      return 3 * i + j;
    }
  }
  /// Number of the couple stress on the face i about rotation axis k; k from 0, in the plane always 0.
  [[nodiscard]] static constexpr int couple_place(int i, int k) { return stresses + rotations * i + k; }
  /// Axis of rotation k: 2 (e_3) in the plane.
  [[nodiscard]] static constexpr int axis(int k) { return dim == 2 ? 2 : k; }
};

/// e_ijk: 1 for even orders of 0, 1, 2, -1 for odd ones, else 0.
[[nodiscard]] constexpr int permutation(int i, int j, int k) {
  return (j - i) * (k - j) * (k - i) / 2;
}

using Vector7 = Cosserat<2>::Vector;
using Matrix7 = Cosserat<2>::Matrix;
using Vector18 = Cosserat<3>::Vector;
using Matrix18 = Cosserat<3>::Matrix;

}  // namespace polargrain
