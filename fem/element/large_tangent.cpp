// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/element/large_tangent.hpp"

#include <Eigen/LU>

#include "common/elementary_functions.hpp"
#include "fem/element/dofs.hpp"
#include "fem/material/rotation.hpp"

namespace polargrain::fem {
namespace {

Eigen::Matrix2d in_plane(const Vector7& stress) {
  Eigen::Matrix2d s;
  s << stress(k11), stress(k12), stress(k21), stress(k22);
  return s;
}

/// d u_i / d x_j at the end of the step for a unit value of one displacement of node `a`.
Eigen::Matrix2d unit_gradient(const PointGeometry& end, Eigen::Index a, Eigen::Index component) {
  Eigen::Matrix2d g = Eigen::Matrix2d::Zero();
  g.row(component) = end.gradient.row(a);
  return g;
}

/// The step of one point taken apart, and how its parts change with the nodal values.
class StepKinematics {
 public:
  StepKinematics(const Increment& increment, Continuum continuum)
      : step_(stretch_and_turn(increment)), cosserat_(continuum == Continuum::cosserat) {
    const auto [sine, cosine] = sine_and_cosine(step_.angle);
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
    change.strain = rotated(change.strain, step_.angle);
    return change;
  }

  /// @param value, gradient of the shape function at the start of the step
  [[nodiscard]] Variation of_rotation(double value, const Eigen::Vector2d& gradient) const {
    Variation change;
    if (!cosserat_) return change;
    change.strain << 0.0, 0.0, 0.0, -value, value, 2.0 * inverse_ * gradient;
    change.strain = rotated(change.strain, step_.angle);
    return change;
  }

 private:
  StretchAndTurn step_;
  bool cosserat_;
  Eigen::Matrix2d turn_;     // R
  Eigen::Matrix2d stretch_;  // U
  Eigen::Matrix2d inverse_;  // (U + I)^-1
};

/// How the nodal forces of a given stress change with the shape: gradients by -N_a,k g_kj, the volume by tr g.
Eigen::VectorXd change_of_shape(const PointGeometry& end, const Eigen::Matrix2d& g, const Vector7& stress,
                                Continuum continuum) {
  const Eigen::Matrix2d s = in_plane(stress);
  const Eigen::Matrix2d ds = s * g.trace() - g * s;
  const Eigen::Vector2d dm = stress.tail<2>() * g.trace() - g * stress.tail<2>();
  const double moment = (stress(k21) - stress(k12)) * g.trace();
  const auto nodes = end.shape.size();
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(entry_of(nodes));
  for (Eigen::Index a = 0; a < nodes; ++a) {
    const Eigen::Vector2d gradient = end.gradient.row(a).transpose();
    forces.segment<2>(entry_of(a)) = ds.transpose() * gradient;
    if (continuum == Continuum::cosserat)
      forces(entry_of(a, Dof::w)) = end.shape(a) * moment + gradient.dot(dm);
  }
  return forces;
}

}  // namespace

Eigen::MatrixXd large_tangent(const PointGeometry& end, const PointGeometry& start,
                              const Increment& increment, Continuum continuum, const Response& response) {
  const auto nodes = end.shape.size();
  const StepKinematics step(increment, continuum);
  const Eigen::Matrix2d s = in_plane(response.stress);
  const Eigen::Vector2d m = response.stress.tail<2>();
  const auto b = strain_matrix(end, continuum);
  Eigen::MatrixXd tangent(entry_of(nodes), entry_of(nodes));
  for (Eigen::Index column = 0; column < tangent.cols(); ++column) {
    const Eigen::Index a = column / kDofsOfNode;
    const Eigen::Index component = column % kDofsOfNode;
    if (component == 2) {
      const auto change = step.of_rotation(start.shape(a), start.gradient.row(a).transpose());
      tangent.col(column) = b.transpose() * (response.tangent * change.strain);
      continue;
    }
    const Eigen::Matrix2d g = unit_gradient(end, a, component);
    Eigen::Matrix2d felt = g;
    if (end.dilatation_correction.size() > 0)
      felt += end.dilatation_correction(a, component) * Eigen::Matrix2d::Identity();
    const auto change = step.of_displacement(felt);
    Eigen::Matrix2d spin;
    spin << 0.0, -change.angle, change.angle, 0.0;
    const Eigen::Matrix2d ds = spin * s - s * spin;
    Vector7 dstress = response.tangent * change.strain;
    dstress(k11) += ds(0, 0);
    dstress(k22) += ds(1, 1);
    dstress(k12) += ds(0, 1);
    dstress(k21) += ds(1, 0);
    dstress.tail<2>() += spin * m;
    tangent.col(column) = b.transpose() * dstress + change_of_shape(end, g, response.stress, continuum);
  }
  return end.volume * tangent;
}

Eigen::MatrixXd mean_dilatation_stiffness(std::span<const PointGeometry> points,
                                          std::span<const Response> answers) {
  const auto nodes = points.front().shape.size();
  double volume = 0.0;
  double load = 0.0;  // sum of (s11 + s22) / 2 times volume
  Eigen::MatrixX2d mean = Eigen::MatrixX2d::Zero(nodes, 2);
  for (std::size_t p = 0; p < points.size(); ++p) {
    volume += points[p].volume;
    load += points[p].volume * 0.5 * (answers[p].stress(k11) + answers[p].stress(k22));
    mean += points[p].volume * points[p].gradient;
  }
  mean /= volume;
  Eigen::MatrixXd tangent = Eigen::MatrixXd::Zero(entry_of(nodes), entry_of(nodes));
  for (Eigen::Index column = 0; column < tangent.cols(); ++column) {
    const Eigen::Index component = column % kDofsOfNode;
    if (component == 2) continue;
    // The forces are load * mean less the sum of pressure * volume * gradient.
    double of_volume = 0.0;
    double of_load = 0.0;
    Eigen::MatrixX2d of_mean = Eigen::MatrixX2d::Zero(nodes, 2);
    Eigen::MatrixX2d forces = Eigen::MatrixX2d::Zero(nodes, 2);
    for (std::size_t p = 0; p < points.size(); ++p) {
      const Eigen::Matrix2d g = unit_gradient(points[p], column / kDofsOfNode, component);
      const Eigen::MatrixX2d change =
          points[p].volume * (g.trace() * points[p].gradient - points[p].gradient * g);
      const double pressure = 0.5 * (answers[p].stress(k11) + answers[p].stress(k22));
      of_volume += points[p].volume * g.trace();
      of_load += pressure * points[p].volume * g.trace();
      of_mean += change;
      forces -= pressure * change;
    }
    forces += of_load * mean + load / volume * (of_mean - of_volume * mean);
    for (Eigen::Index a = 0; a < nodes; ++a)
      tangent.block<2, 1>(entry_of(a), column) = forces.row(a).transpose();
  }
  return tangent;
}

}  // namespace polargrain::fem
