// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/element/large_tangent.hpp"

#include <Eigen/LU>

#include "common/elementary_functions.hpp"
#include "fem/element/dofs.hpp"
#include "fem/material/polar_decomposition.hpp"
#include "fem/material/rotation.hpp"

namespace polargrain::fem {
namespace {

Eigen::Matrix2d in_plane(const Vector7& stress) {
  Eigen::Matrix2d s;
  s << stress(k11), stress(k12), stress(k21), stress(k22);
  return s;
}

/// d u_i / d x_j at the end of the step for a unit value of one displacement of node `a`.
template <int dim>
typename Cosserat<dim>::Gradient unit_gradient(const PointGeometry<dim>& end, Eigen::Index a,
                                               Eigen::Index component) {
  typename Cosserat<dim>::Gradient g = Cosserat<dim>::Gradient::Zero();
  g.row(component) = end.gradient.row(a);
  return g;
}

/// The same as the material feels it: of gradients that are means about the start, which lead to other means at the end.
template <int dim>
typename Cosserat<dim>::Gradient felt_gradient(const PointGeometry<dim>& end, const PointGeometry<dim>& start,
                                               const Increment<dim>& increment, bool is_averaged,
                                               Eigen::Index a, Eigen::Index component) {
  using Gradient = typename Cosserat<dim>::Gradient;
  if (is_averaged)
    return unit_gradient<dim>(start, a, component) *
           Gradient(Gradient::Identity() + increment.displacement_gradient).inverse();
  Gradient felt = unit_gradient<dim>(end, a, component);
  if (end.dilatation_correction.size() > 0)
    felt += end.dilatation_correction(a, component) * Gradient::Identity();
  return felt;
}

/// The step of one point taken apart, and how its parts change with the nodal values.
class StepKinematics {
 public:
  StepKinematics(const Increment<2>& increment, Continuum continuum)
      : step_(stretch_and_turn(increment)), cosserat_(continuum == Continuum::cosserat) {
    const auto [sine, cosine] = sine_and_cosine(step_.turn);
    turn_ << cosine, -sine, sine, cosine;
    stretch_ = turn_.transpose() * (Eigen::Matrix2d::Identity() + increment.displacement_gradient);
    inverse_ = (stretch_ + Eigen::Matrix2d::Identity()).inverse();
  }

  /// Change of the strain of the stretch, in the axes of the end, and of the angle turned.
  struct Variation {
    Vector7 strain = Vector7::Zero();
    double angle = 0.0;
  };

  /// @param g change of the displacement gradient about the end of the step
  [[nodiscard]] Variation of_displacement(const Eigen::Matrix2d& g) const {
    // dF = g F; with G = R^T g R: dU = G U - dR U, whose skew part must vanish.
    const Eigen::Matrix2d gu = turn_.transpose() * g * turn_ * stretch_;
    Variation change;
    change.angle = (gu(1, 0) - gu(0, 1)) / stretch_.trace();
    Eigen::Matrix2d spin;
    spin << 0.0, -change.angle, change.angle, 0.0;
    const Eigen::Matrix2d du = gu - spin * stretch_;
    const Eigen::Matrix2d strain = 4.0 * inverse_ * du * inverse_;
    const double skew = cosserat_ ? change.angle : 0.0;
    change.strain << strain(0, 0), strain(1, 1), 0.0, strain(1, 0) + skew, strain(0, 1) - skew,
        -inverse_ * du * step_.stretch.curvature;
    change.strain = rotated(change.strain, step_.turn);
    return change;
  }

  /// @param value, gradient of the shape function at the start of the step
  [[nodiscard]] Variation of_rotation(double value, const Eigen::Vector2d& gradient) const {
    Variation change;
    if (!cosserat_) return change;
    change.strain << 0.0, 0.0, 0.0, -value, value, 2.0 * inverse_ * gradient;
    change.strain = rotated(change.strain, step_.turn);
    return change;
  }

 private:
  StretchAndTurn<2> step_;
  bool cosserat_;
  Eigen::Matrix2d turn_;     // R
  Eigen::Matrix2d stretch_;  // U
  Eigen::Matrix2d inverse_;  // (U + I)^-1
};

Eigen::VectorXd change_of_shape(const PointGeometry<3>& end, const Eigen::Matrix3d& g, const Vector18& stress,
                                Continuum continuum);

/// How the nodal forces of a given stress change with the shape: gradients by -N_a,k g_kj, the volume by tr g.
Eigen::VectorXd change_of_shape(const PointGeometry<2>& end, const Eigen::Matrix2d& g, const Vector7& stress,
                                Continuum continuum) {
  const Eigen::Matrix2d s = in_plane(stress);
  const Eigen::Matrix2d ds = s * g.trace() - g * s;
  const Eigen::Vector2d dm = stress.tail<2>() * g.trace() - g * stress.tail<2>();
  const double moment = (stress(k21) - stress(k12)) * g.trace();
  const auto nodes = end.shape.size();
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(entry_of<2>(nodes));
  for (Eigen::Index a = 0; a < nodes; ++a) {
    const Eigen::Vector2d gradient = end.gradient.row(a).transpose();
    forces.segment<2>(entry_of<2>(a)) = ds.transpose() * gradient;
    if (continuum == Continuum::cosserat)
      forces(entry_of<2>(a, Dof::w)) = end.shape(a) * moment + gradient.dot(dm);
  }
  return forces;
}

/// For a unit value of one displacement of node `a`, over the volume of the point.
/// @param places that the point stands for; empty: itself
template <int dim>
Eigen::VectorXd change_of_shape(const PointGeometry<dim>& end, std::span<const PointGeometry<dim>> places,
                                Eigen::Index a, Eigen::Index component,
                                const typename Cosserat<dim>::Vector& stress, Continuum continuum) {
  if (places.empty()) return change_of_shape(end, unit_gradient<dim>(end, a, component), stress, continuum);
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(entry_of<dim>(end.shape.size()));
  for (const PointGeometry<dim>& place : places)
    sum += place.volume / end.volume *
           change_of_shape(place, unit_gradient<dim>(place, a, component), stress, continuum);
  return sum;
}

}  // namespace

template <>
Eigen::MatrixXd large_tangent<2>(const PointGeometry<2>& end, const PointGeometry<2>& start,
                                 const Increment<2>& increment, Continuum continuum,
                                 const Response<2>& response, std::span<const PointGeometry<2>> places) {
  const auto nodes = end.shape.size();
  const StepKinematics step(increment, continuum);
  const Eigen::Matrix2d s = in_plane(response.stress);
  const Eigen::Vector2d m = response.stress.tail<2>();
  const auto b = strain_matrix<2>(end, continuum);
  Eigen::MatrixXd tangent(entry_of<2>(nodes), entry_of<2>(nodes));
  for (Eigen::Index column = 0; column < tangent.cols(); ++column) {
    const Eigen::Index a = column / Cosserat<2>::dofs;
    const Eigen::Index component = column % Cosserat<2>::dofs;
    if (component == 2) {
      const auto change = step.of_rotation(start.shape(a), start.gradient.row(a).transpose());
      tangent.col(column) = b.transpose() * (response.tangent * change.strain);
      continue;
    }
    const auto change =
        step.of_displacement(felt_gradient<2>(end, start, increment, !places.empty(), a, component));
    Eigen::Matrix2d spin;
    spin << 0.0, -change.angle, change.angle, 0.0;
    const Eigen::Matrix2d ds = spin * s - s * spin;
    Vector7 dstress = response.tangent * change.strain;
    dstress(k11) += ds(0, 0);
    dstress(k22) += ds(1, 1);
    dstress(k12) += ds(0, 1);
    dstress(k21) += ds(1, 0);
    dstress.tail<2>() += spin * m;
    tangent.col(column) =
        b.transpose() * dstress + change_of_shape<2>(end, places, a, component, response.stress, continuum);
  }
  return end.volume * tangent;
}

namespace {

/// The same of a step in space.
class SpaceStep {
 public:
  SpaceStep(const Increment<3>& increment, Continuum continuum)
      : increment_(increment),
        parts_(increment.displacement_gradient),
        cosserat_(continuum == Continuum::cosserat) {}

  struct Variation {
    Vector18 strain = Vector18::Zero();              ///< in the axes of the end
    Eigen::Matrix3d spin = Eigen::Matrix3d::Zero();  ///< dR R^T
  };

  /// @param g change of the displacement gradient about the end of the step
  [[nodiscard]] Variation of_displacement(const Eigen::Matrix3d& g) const {
    const Eigen::Matrix3d& back = parts_.half_way_back;
    const Eigen::Matrix3d turned_back = parts_.rotation.transpose() * g * parts_.rotation * parts_.stretch;
    const PolarDecomposition::Change change = parts_.change(turned_back);
    Increment<3> stretch;
    stretch.displacement_gradient = 4.0 * parts_.inverse * change.stretch * parts_.inverse;
    if (cosserat_) {
      const Eigen::Vector3d turned =
          inverse_right_jacobian(parts_.vector) * change.spin;  // of the vector of R
      const Eigen::Matrix3d of_back =
          back * cross_matrix(right_jacobian(-0.5 * parts_.vector) * (-0.5 * turned));
      stretch.rotation = of_back * increment_.rotation - turned;
      stretch.curvature =
          2.0 * (of_back * increment_.curvature * parts_.inverse -
                 back * increment_.curvature * parts_.inverse * change.stretch * parts_.inverse);
    }
    Variation made{rotated(stretch.strain(), parts_.rotation), {}};
    made.spin = parts_.rotation * cross_matrix(change.spin) * parts_.rotation.transpose();
    return made;
  }

  /// Of a rotation about one axis. @param value, gradient of the shape function at the start of the step
  [[nodiscard]] Variation of_rotation(int axis, double value, const Eigen::Vector3d& gradient) const {
    Variation made;
    if (!cosserat_) return made;
    const Eigen::Vector3d about = parts_.half_way_back.col(axis);
    Increment<3> stretch;
    stretch.rotation = value * about;
    stretch.curvature = 2.0 * about * (parts_.inverse * gradient).transpose();
    made.strain = rotated(stretch.strain(), parts_.rotation);
    return made;
  }

 private:
  const Increment<3>& increment_;
  PolarDecomposition parts_;
  bool cosserat_;
};

using TensorRows = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

TensorRows tensor(const Vector18& components, int first) {
  return Eigen::Map<const TensorRows>(components.data() + first);
}

Vector18 components(const Eigen::Matrix3d& stress, const Eigen::Matrix3d& couple_stress) {
  Vector18 made;
  made << stress.row(0).transpose(), stress.row(1).transpose(), stress.row(2).transpose(),
      couple_stress.row(0).transpose(), couple_stress.row(1).transpose(), couple_stress.row(2).transpose();
  return made;
}

Eigen::VectorXd change_of_shape(const PointGeometry<3>& end, const Eigen::Matrix3d& g, const Vector18& stress,
                                Continuum continuum) {
  const Eigen::Matrix3d s = tensor(stress, 0);
  const Eigen::Matrix3d m = tensor(stress, 9);
  const Eigen::Matrix3d ds = s * g.trace() - g * s;
  const Eigen::Matrix3d dm = m * g.trace() - g * m;
  const Eigen::Vector3d moment = -2.0 * axial(s.transpose()) * g.trace();  // -e_ijk s_ij
  const auto nodes = end.shape.size();
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(entry_of<3>(nodes));
  for (Eigen::Index a = 0; a < nodes; ++a) {
    const Eigen::Vector3d gradient = end.gradient.row(a).transpose();
    forces.segment<3>(entry_of<3>(a)) = ds.transpose() * gradient;
    if (continuum == Continuum::cosserat)
      forces.segment<3>(entry_of<3>(a) + 3) = end.shape(a) * moment + dm.transpose() * gradient;
  }
  return forces;
}

}  // namespace

template <>
Eigen::MatrixXd large_tangent<3>(const PointGeometry<3>& end, const PointGeometry<3>& start,
                                 const Increment<3>& increment, Continuum continuum,
                                 const Response<3>& response, std::span<const PointGeometry<3>> places) {
  const auto nodes = end.shape.size();
  const SpaceStep step(increment, continuum);
  const Eigen::Matrix3d s = tensor(response.stress, 0);
  const Eigen::Matrix3d m = tensor(response.stress, 9);
  // All columns at once: B^T is the same for each.
  Eigen::Matrix<double, 18, Eigen::Dynamic> stresses(18, entry_of<3>(nodes));
  Eigen::MatrixXd shape = Eigen::MatrixXd::Zero(entry_of<3>(nodes), entry_of<3>(nodes));
  for (Eigen::Index a = 0; a < nodes; ++a) {
    for (int i = 0; i < 3; ++i) {
      const SpaceStep::Variation change =
          step.of_displacement(felt_gradient<3>(end, start, increment, !places.empty(), a, i));
      stresses.col(entry_of<3>(a) + i) =
          response.tangent * change.strain +
          components(change.spin * s - s * change.spin, change.spin * m - m * change.spin);
      shape.col(entry_of<3>(a) + i) = change_of_shape<3>(end, places, a, i, response.stress, continuum);
      stresses.col(entry_of<3>(a) + 3 + i) =
          response.tangent * step.of_rotation(i, start.shape(a), start.gradient.row(a).transpose()).strain;
    }
  }
  return end.volume * (strain_matrix<3>(end, continuum).transpose() * stresses + shape);
}

template <int dim>
StrainMatrix<dim> large_strain_matrix(const PointGeometry<dim>& end, const PointGeometry<dim>& start,
                                      const Increment<dim>& increment, Continuum continuum,
                                      bool is_averaged) {
  const auto step = [&] {
    if constexpr (dim == 2)
      return StepKinematics(increment, continuum);
    else
      return SpaceStep(increment, continuum);
  }();
  const auto nodes = end.shape.size();
  StrainMatrix<dim> strains(Cosserat<dim>::components, entry_of<dim>(nodes));
  for (Eigen::Index a = 0; a < nodes; ++a) {
    for (int i = 0; i < dim; ++i)
      strains.col(entry_of<dim>(a) + i) =
          step.of_displacement(felt_gradient<dim>(end, start, increment, is_averaged, a, i)).strain;
    for (int i = 0; i < Cosserat<dim>::rotations; ++i) {
      const auto column = entry_of<dim>(a) + dim + i;
      if constexpr (dim == 2)
        strains.col(column) = step.of_rotation(start.shape(a), start.gradient.row(a).transpose()).strain;
      else
        strains.col(column) = step.of_rotation(i, start.shape(a), start.gradient.row(a).transpose()).strain;
    }
  }
  return strains;
}

template StrainMatrix<2> large_strain_matrix<2>(const PointGeometry<2>&, const PointGeometry<2>&,
                                                const Increment<2>&, Continuum, bool);
template StrainMatrix<3> large_strain_matrix<3>(const PointGeometry<3>&, const PointGeometry<3>&,
                                                const Increment<3>&, Continuum, bool);

namespace {

/// Mean normal stress of the plane or of space.
template <int dim>
double mean_normal(const typename Cosserat<dim>::Vector& stress) {
  double sum = stress(Cosserat<dim>::stress_place(0, 0));
  for (int i = 1; i < dim; ++i) sum += stress(Cosserat<dim>::stress_place(i, i));
  return (1.0 / dim) * sum;
}

}  // namespace

template <int dim>
Eigen::MatrixXd mean_dilatation_stiffness(std::span<const PointGeometry<dim>> points,
                                          std::span<const Response<dim>> answers) {
  using Gradient = typename Cosserat<dim>::Gradient;
  using Rows = VectorRows<dim>;
  const auto nodes = points.front().shape.size();
  double volume = 0.0;
  double load = 0.0;  // sum of the mean normal stress times volume
  Rows mean = Rows::Zero(nodes, dim);
  for (std::size_t p = 0; p < points.size(); ++p) {
    volume += points[p].volume;
    load += points[p].volume * mean_normal<dim>(answers[p].stress);
    mean += points[p].volume * points[p].gradient;
  }
  mean /= volume;
  Eigen::MatrixXd tangent = Eigen::MatrixXd::Zero(entry_of<dim>(nodes), entry_of<dim>(nodes));
  for (Eigen::Index column = 0; column < tangent.cols(); ++column) {
    const Dof dof = dof_at<dim>(column);
    if (is_rotation(dof)) continue;
    // The forces are load * mean less the sum of pressure * volume * gradient.
    double of_volume = 0.0;
    double of_load = 0.0;
    Rows of_mean = Rows::Zero(nodes, dim);
    Rows forces = Rows::Zero(nodes, dim);
    for (std::size_t p = 0; p < points.size(); ++p) {
      Gradient g = Gradient::Zero();
      g.row(axis_of(dof)) = points[p].gradient.row(column / Cosserat<dim>::dofs);
      const Rows change = points[p].volume * (g.trace() * points[p].gradient - points[p].gradient * g);
      const double pressure = mean_normal<dim>(answers[p].stress);
      of_volume += points[p].volume * g.trace();
      of_load += pressure * points[p].volume * g.trace();
      of_mean += change;
      forces -= pressure * change;
    }
    forces += of_load * mean + load / volume * (of_mean - of_volume * mean);
    for (Eigen::Index a = 0; a < nodes; ++a)
      tangent.template block<dim, 1>(entry_of<dim>(a), column) = forces.row(a).transpose();
  }
  return tangent;
}

template Eigen::MatrixXd mean_dilatation_stiffness<2>(std::span<const PointGeometry<2>> points,
                                                      std::span<const Response<2>> answers);
template Eigen::MatrixXd mean_dilatation_stiffness<3>(std::span<const PointGeometry<3>> points,
                                                      std::span<const Response<3>> answers);

}  // namespace polargrain::fem
