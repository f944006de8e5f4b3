// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <array>
#include <cmath>
#include <complex>

#include "fem/material/elastic.hpp"

namespace polargrain::fem {

/// The components in the order of Cosserat<dim>, but SCALED with the internal length lc: curvatures
/// times lc (dimensionless), couple stresses over lc (Pa). All components then share one unit and the four
/// subspaces below are orthogonal (docs/theory/plasticity.md, B.1). The scalar is double, or complex in tests
/// that differentiate by a complex step.
template <class Scalar, int dim = 2>
using ScaledVector = Eigen::Matrix<Scalar, Cosserat<dim>::components, 1>;

template <class Scalar, int dim = 2>
using ScaledMatrix = Eigen::Matrix<Scalar, Cosserat<dim>::components, Cosserat<dim>::components>;

/// The dimension that vectors of so many components belong to.
template <int components>
inline constexpr int dimension_of_components = components == Cosserat<2>::components ? 2 : 3;

/// Real part, so that decisions (yield, apex, convergence) do not feel a complex step.
inline double real_part(double value) {
  return value;
}
inline double real_part(const std::complex<double>& value) {
  return value.real();
}

/// a . b without conjugation: an analytic function also for complex components.
template <class Scalar, int size>
Scalar plain_dot(const Eigen::Matrix<Scalar, size, 1>& a, const Eigen::Matrix<Scalar, size, 1>& b) {
  return (a.array() * b.array()).sum();
}

/// Weights of J2 = a1 s_ij s_ij + a2 s_ij s_ji + a3 m_i m_i / lc^2 (docs/theory/plasticity.md, B.1), with
/// a1 + a2 = 1/2, a1 >= a2 and a3 >= 0. The defaults let the skew stress stay out of the yield function.
struct InvariantWeights {
  double a1 = 0.25;
  double a2 = 0.25;
  double a3 = 0.5;
};

/// The ratios of the couple moduli in space, L = gamma (1 + transpose + trace); the plane does not have them (ElasticParameters).
struct CoupleShape {
  double trace = 0.0;      ///< alpha over gamma
  double transpose = 0.0;  ///< beta over gamma
};

/// The moduli and weights of the three subspaces outside the mean stress, in the order: symmetric deviator, skew shear,
/// couple stress. Elasticity acts on each by a factor d_k, the invariant q weighs each by p_k.
struct SubspaceModuli {
  double bulk = 0.0;                  ///< K, Pa
  std::array<double, 3> stiffness{};  ///< d_k = 2G, 2Gc, 2G, Pa
  std::array<double, 3> weight{};     ///< p_k = 1, 2(a1-a2), 2 a3
  CoupleShape couples;

  SubspaceModuli() = default;
  template <int dim>
  SubspaceModuli(const ElasticParameters<dim>& elastic, const InvariantWeights& weights)
      : bulk(elastic.young_modulus / (3.0 * (1.0 - 2.0 * elastic.poisson_ratio))),
        stiffness{elastic.young_modulus / (1.0 + elastic.poisson_ratio), 2.0 * elastic.cosserat_shear_modulus,
                  elastic.young_modulus / (1.0 + elastic.poisson_ratio)},
        weight{1.0, 2.0 * (weights.a1 - weights.a2), 2.0 * weights.a3},
        couples{elastic.couple_trace_ratio, elastic.couple_transpose_ratio} {}

  [[nodiscard]] double shear() const { return 0.5 * stiffness[0]; }  ///< G, Pa
  /// c_k = d_k p_k, Pa.
  [[nodiscard]] double return_stiffness(std::size_t k) const { return stiffness[k] * weight[k]; }
};

/// A vector split into the mean of its normal components and its parts in the three subspaces.
template <class Scalar, int dim = 2>
struct Split {
  Scalar mean{};
  std::array<ScaledVector<Scalar, dim>, 3> part;

  explicit Split(const ScaledVector<Scalar, dim>& whole) {
    if constexpr (dim == 2) {
      mean = (whole(0) + whole(1) + whole(2)) / 3.0;
      const Scalar symmetric = 0.5 * (whole(3) + whole(4));
      const Scalar skew = 0.5 * (whole(3) - whole(4));
      const Scalar zero(0.0);
      part[0] << whole(0) - mean, whole(1) - mean, whole(2) - mean, symmetric, symmetric, zero, zero;
      part[1] << zero, zero, zero, skew, -skew, zero, zero;
      part[2] << zero, zero, zero, zero, zero, whole(5), whole(6);
    } else {
      using Space = Cosserat<3>;
      for (ScaledVector<Scalar, dim>& one : part) one.setZero();
      mean = (whole(Space::stress_place(0, 0)) + whole(Space::stress_place(1, 1)) +
              whole(Space::stress_place(2, 2))) /
             3.0;
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
          const int place = Space::stress_place(i, j);
          part[0](place) =
              0.5 * (whole(place) + whole(Space::stress_place(j, i))) - (i == j ? mean : Scalar(0.0));
          part[1](place) = 0.5 * (whole(place) - whole(Space::stress_place(j, i)));
        }
      }
      part[2].template tail<Space::couples>() = whole.template tail<Space::couples>();
    }
  }
};

/// The unit vector of the mean stress: 1 at s11, s22, s33, else 0.
template <class Scalar, int dim = 2>
ScaledVector<Scalar, dim> volumetric_vector() {
  ScaledVector<Scalar, dim> one = ScaledVector<Scalar, dim>::Zero();
  if constexpr (dim == 2) {
    one.template head<3>().setOnes();
  } else {
    for (int i = 0; i < 3; ++i) one(Cosserat<3>::stress_place(i, i)) = Scalar(1.0);
  }
  return one;
}

/// Adds `factor` to the rows and columns of s11, s22, s33: the matrix factor * 1 1^T.
template <int size>
void add_volumetric(Eigen::Matrix<double, size, size>& matrix, double factor) {
  if constexpr (size == Cosserat<2>::components) {
    matrix.template topLeftCorner<3, 3>().array() += factor;
  } else {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        matrix(Cosserat<3>::stress_place(i, i), Cosserat<3>::stress_place(j, j)) += factor;
  }
}

/// sum_k factor_k Pi_k: the matrix that scales each subspace by its own factor, the couples with their shape besides.
template <class Scalar, int dim = 2>
ScaledMatrix<Scalar, dim> subspace_matrix(const std::array<Scalar, 3>& factor,
                                          const CoupleShape& shape = {}) {
  ScaledMatrix<Scalar, dim> matrix = ScaledMatrix<Scalar, dim>::Zero();
  if constexpr (dim == 2) {
    (void)shape;
    matrix.template topLeftCorner<3, 3>().setConstant(-factor[0] / 3.0);
    for (int i = 0; i < 3; ++i) {
      matrix(i, i) += factor[0];
    }
    matrix(3, 3) = matrix(4, 4) = 0.5 * (factor[0] + factor[1]);
    matrix(3, 4) = matrix(4, 3) = 0.5 * (factor[0] - factor[1]);
    matrix(5, 5) = matrix(6, 6) = factor[2];
  } else {
    using Space = Cosserat<3>;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        const int s = Space::stress_place(i, j);
        matrix(s, s) += 0.5 * (factor[0] + factor[1]);
        matrix(s, Space::stress_place(j, i)) += 0.5 * (factor[0] - factor[1]);
        matrix(Space::stress_place(i, i), Space::stress_place(j, j)) -= factor[0] / 3.0;
        const int m = Space::couple_place(i, j);
        matrix(m, m) += factor[2];
        matrix(m, Space::couple_place(j, i)) += shape.transpose * factor[2];
        matrix(Space::couple_place(i, i), Space::couple_place(j, j)) += shape.trace * factor[2];
      }
    }
  }
  return matrix;
}

/// Elastic stiffness D in scaled components, Pa (docs/theory/plasticity.md, B.1).
template <int dim = 2>
ScaledMatrix<double, dim> elastic_stiffness(const SubspaceModuli& moduli) {
  ScaledMatrix<double, dim> stiffness = subspace_matrix<double, dim>(moduli.stiffness, moduli.couples);
  add_volumetric(stiffness, moduli.bulk);
  return stiffness;
}

/// The couple law without gamma: kappa + beta/gamma kappa^T + alpha/gamma tr kappa 1. In the plane kappa itself.
template <class Scalar, int size>
Eigen::Matrix<Scalar, size, 1> shaped(const Eigen::Matrix<Scalar, size, 1>& couples,
                                      const CoupleShape& shape) {
  if constexpr (size == Cosserat<2>::components) {
    (void)shape;
    return couples;
  } else {
    using Space = Cosserat<3>;
    Eigen::Matrix<Scalar, size, 1> made = couples;
    Scalar trace(0.0);
    for (int i = 0; i < 3; ++i) trace += couples(Space::couple_place(i, i));
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j)
        made(Space::couple_place(i, j)) += shape.transpose * couples(Space::couple_place(j, i));
      made(Space::couple_place(i, i)) += shape.trace * trace;
    }
    return made;
  }
}

/// Stress of an elastic strain, D eps, without forming D.
template <class Scalar, int size>
Eigen::Matrix<Scalar, size, 1> elastic_stress(const SubspaceModuli& moduli,
                                              const Eigen::Matrix<Scalar, size, 1>& strain) {
  constexpr int dim = dimension_of_components<size>;
  Split<Scalar, dim> split(strain);
  split.part[2] = shaped(split.part[2], moduli.couples);
  ScaledVector<Scalar, dim> stress = (3.0 * moduli.bulk * split.mean) * volumetric_vector<Scalar, dim>();
  for (std::size_t k = 0; k < 3; ++k) {
    stress += moduli.stiffness[k] * split.part[k];
  }
  return stress;
}

/// n_k: the square of a part of a stress. Of couples gamma m : L^-1 : m, so that the return scales them as a whole
/// (pseudo-inverse where an eigenvalue of L is zero).
template <class Scalar, int dim>
Scalar square_of_part(const Split<Scalar, dim>& stress, std::size_t k, const CoupleShape& shape) {
  const Scalar plain = plain_dot(stress.part[k], stress.part[k]);
  if (dim == 2 || k != 2 || (shape.trace == 0.0 && shape.transpose == 0.0)) return plain;
  Scalar sum(0.0);
  if constexpr (dim == 3) {
    using Space = Cosserat<3>;
    const ScaledVector<Scalar, dim>& m = stress.part[2];
    Scalar trace(0.0);
    for (int i = 0; i < 3; ++i) trace += m(Space::couple_place(i, i));
    Scalar symmetric(0.0);
    Scalar skew(0.0);
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        const Scalar a = m(Space::couple_place(i, j));
        const Scalar b = m(Space::couple_place(j, i));
        symmetric += 0.25 * (a + b) * (a + b);
        skew += 0.25 * (a - b) * (a - b);
      }
    }
    const Scalar spherical = trace * trace / 3.0;
    const auto add = [&](const Scalar& square, double eigenvalue) {
      if (eigenvalue > 0.0) sum += square / eigenvalue;
    };
    add(symmetric - spherical, 1.0 + shape.transpose);
    add(skew, 1.0 - shape.transpose);
    add(spherical, 1.0 + shape.transpose + 3.0 * shape.trace);
  }
  return sum;
}

/// q = sqrt(3 J2) = sqrt((3/2) sum_k p_k n_k), Pa (docs/theory/plasticity.md, B.1).
template <class Scalar, int dim>
Scalar deviatoric_stress(const Split<Scalar, dim>& stress, const SubspaceModuli& moduli) {
  using std::sqrt;
  Scalar sum(0.0);
  for (std::size_t k = 0; k < 3; ++k) {
    sum += moduli.weight[k] * square_of_part(stress, k, moduli.couples);
  }
  return sqrt(1.5 * sum);
}

}  // namespace polargrain::fem
