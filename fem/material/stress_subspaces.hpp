// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <array>
#include <cmath>
#include <complex>

#include "fem/material/elastic.hpp"

namespace polargrain::fem {

/// The 7 components in the order of common/increment.hpp, but SCALED with the internal length lc: curvatures
/// times lc (dimensionless), couple stresses over lc (Pa). All components then share one unit and the four
/// subspaces below are orthogonal (docs/theory/plasticity.md, B.1). The scalar is double, or complex in tests
/// that differentiate by a complex step.
template <class Scalar>
using ScaledVector = Eigen::Matrix<Scalar, 7, 1>;

template <class Scalar>
using ScaledMatrix = Eigen::Matrix<Scalar, 7, 7>;

/// Real part, so that decisions (yield, apex, convergence) do not feel a complex step.
inline double real_part(double value) {
  return value;
}
inline double real_part(const std::complex<double>& value) {
  return value.real();
}

/// a . b without conjugation: an analytic function also for complex components.
template <class Scalar>
Scalar plain_dot(const ScaledVector<Scalar>& a, const ScaledVector<Scalar>& b) {
  return (a.array() * b.array()).sum();
}

/// Weights of J2 = a1 s_ij s_ij + a2 s_ij s_ji + a3 m_i m_i / lc^2 (docs/theory/plasticity.md, B.1), with
/// a1 + a2 = 1/2, a1 >= a2 and a3 >= 0. The defaults let the skew stress stay out of the yield function.
struct InvariantWeights {
  double a1 = 0.25;
  double a2 = 0.25;
  double a3 = 0.5;
};

/// The moduli and weights of the three subspaces outside the mean stress, in the order: symmetric deviator, skew shear,
/// couple stress. Elasticity acts on each by a factor d_k, the invariant q weighs each by p_k.
struct SubspaceModuli {
  double bulk = 0.0;                  ///< K, Pa
  std::array<double, 3> stiffness{};  ///< d_k = 2G, 2Gc, 2G, Pa
  std::array<double, 3> weight{};     ///< p_k = 1, 2(a1-a2), 2 a3

  SubspaceModuli() = default;
  SubspaceModuli(const ElasticParameters& elastic, const InvariantWeights& weights)
      : bulk(elastic.young_modulus / (3.0 * (1.0 - 2.0 * elastic.poisson_ratio))),
        stiffness{elastic.young_modulus / (1.0 + elastic.poisson_ratio), 2.0 * elastic.cosserat_shear_modulus,
                  elastic.young_modulus / (1.0 + elastic.poisson_ratio)},
        weight{1.0, 2.0 * (weights.a1 - weights.a2), 2.0 * weights.a3} {}

  [[nodiscard]] double shear() const { return 0.5 * stiffness[0]; }  ///< G, Pa
  /// c_k = d_k p_k, Pa.
  [[nodiscard]] double return_stiffness(std::size_t k) const { return stiffness[k] * weight[k]; }
};

/// A vector split into the mean of its first three components and its parts in the three subspaces.
template <class Scalar>
struct Split {
  Scalar mean{};
  std::array<ScaledVector<Scalar>, 3> part;

  explicit Split(const ScaledVector<Scalar>& whole) : mean((whole(0) + whole(1) + whole(2)) / 3.0) {
    const Scalar symmetric = 0.5 * (whole(3) + whole(4));
    const Scalar skew = 0.5 * (whole(3) - whole(4));
    const Scalar zero(0.0);
    part[0] << whole(0) - mean, whole(1) - mean, whole(2) - mean, symmetric, symmetric, zero, zero;
    part[1] << zero, zero, zero, skew, -skew, zero, zero;
    part[2] << zero, zero, zero, zero, zero, whole(5), whole(6);
  }
};

/// The unit vector of the mean stress, 1 = [1 1 1 0 0 0 0].
template <class Scalar>
ScaledVector<Scalar> volumetric_vector() {
  ScaledVector<Scalar> one = ScaledVector<Scalar>::Zero();
  one.template head<3>().setOnes();
  return one;
}

/// sum_k factor_k Pi_k: the matrix that scales each subspace by its own factor.
template <class Scalar>
ScaledMatrix<Scalar> subspace_matrix(const std::array<Scalar, 3>& factor) {
  ScaledMatrix<Scalar> matrix = ScaledMatrix<Scalar>::Zero();
  matrix.template topLeftCorner<3, 3>().setConstant(-factor[0] / 3.0);
  for (int i = 0; i < 3; ++i) {
    matrix(i, i) += factor[0];
  }
  matrix(3, 3) = matrix(4, 4) = 0.5 * (factor[0] + factor[1]);
  matrix(3, 4) = matrix(4, 3) = 0.5 * (factor[0] - factor[1]);
  matrix(5, 5) = matrix(6, 6) = factor[2];
  return matrix;
}

/// Elastic stiffness D in scaled components, Pa (docs/theory/plasticity.md, B.1).
inline ScaledMatrix<double> elastic_stiffness(const SubspaceModuli& moduli) {
  ScaledMatrix<double> stiffness = subspace_matrix(moduli.stiffness);
  stiffness.topLeftCorner<3, 3>().array() += moduli.bulk;
  return stiffness;
}

/// Stress of an elastic strain, D eps, without forming D.
template <class Scalar>
ScaledVector<Scalar> elastic_stress(const SubspaceModuli& moduli, const ScaledVector<Scalar>& strain) {
  const Split<Scalar> split(strain);
  ScaledVector<Scalar> stress = (3.0 * moduli.bulk * split.mean) * volumetric_vector<Scalar>();
  for (std::size_t k = 0; k < 3; ++k) {
    stress += moduli.stiffness[k] * split.part[k];
  }
  return stress;
}

/// q = sqrt(3 J2) = sqrt((3/2) sum_k p_k |s_k|^2), Pa (docs/theory/plasticity.md, B.1).
template <class Scalar>
Scalar deviatoric_stress(const Split<Scalar>& stress, const std::array<double, 3>& weight) {
  using std::sqrt;
  Scalar sum(0.0);
  for (std::size_t k = 0; k < 3; ++k) {
    sum += weight[k] * plain_dot(stress.part[k], stress.part[k]);
  }
  return sqrt(1.5 * sum);
}

}  // namespace polargrain::fem
