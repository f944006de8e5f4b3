// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/element/large_tangent.hpp"

#include "fem/element/dofs.hpp"

#include "fem/material/rotation.hpp"

namespace polargrain::fem {
namespace {

/// Change of the strain and of the angle turned, for a unit value of one unknown of node `a`.
struct Variation {
  Vector7 strain = Vector7::Zero();
  double angle = 0.0;
};

Variation vary(const PointGeometry& middle, const Increment& increment, Continuum continuum, Eigen::Index a,
               Eigen::Index component) {
  Variation change;
  if (component == 2) {
    if (continuum == Continuum::cauchy) return change;
    change.strain(k12) = -middle.shape(a);
    change.strain(k21) = middle.shape(a);
    change.strain.tail<2>() = middle.gradient.row(a).transpose();
    return change;
  }
  Eigen::Matrix2d gradient = Eigen::Matrix2d::Zero();
  gradient.row(component) = middle.gradient.row(a);
  // The middle moves by half as much, and its gradients with it.
  const Eigen::Matrix2d& h = increment.displacement_gradient;
  const Eigen::Matrix2d dh = gradient - 0.5 * h * gradient;
  const double half_tangent = 0.25 * (h(1, 0) - h(0, 1));
  change.angle = 0.5 * (dh(1, 0) - dh(0, 1)) / (1.0 + half_tangent * half_tangent);
  const double shear = 0.5 * (dh(0, 1) + dh(1, 0));
  change.strain << dh(0, 0), dh(1, 1), 0.0, shear, shear, 0.0, 0.0;
  if (continuum == Continuum::cosserat) {
    change.strain(k12) += change.angle;
    change.strain(k21) -= change.angle;
    change.strain.tail<2>() = -0.5 * gradient.transpose() * increment.curvature;
  }
  return change;
}

}  // namespace

Eigen::MatrixXd large_tangent(const PointGeometry& end, const PointGeometry& middle,
                              const Increment& increment, Continuum continuum, const Response& response,
                              const Vector7& start_stress) {
  const auto nodes = end.shape.size();
  const Vector7& stress = response.stress;
  Eigen::Matrix2d s;
  s << stress(k11), stress(k12), stress(k21), stress(k22);
  const Eigen::Vector2d m = stress.tail<2>();
  const Vector7 turned = rotated(start_stress, rotation_angle(increment));
  Eigen::Matrix2d turned_s;
  turned_s << turned(k11), turned(k12), turned(k21), turned(k22);
  const auto b = strain_matrix(end, continuum);
  Eigen::MatrixXd tangent(entry_of(nodes), entry_of(nodes));
  for (Eigen::Index column = 0; column < tangent.cols(); ++column) {
    const Variation change = vary(middle, increment, continuum, column / kDofsOfNode, column % kDofsOfNode);
    Eigen::Matrix2d spin;
    spin << 0.0, -change.angle, change.angle, 0.0;
    // At the end of the step gradients change by -N_a,k h_kj and the volume by tr h.
    Eigen::Matrix2d h = Eigen::Matrix2d::Zero();
    if (column % kDofsOfNode < 2) h.row(column % kDofsOfNode) = end.gradient.row(column / kDofsOfNode);
    const Eigen::Matrix2d hs = h * s;
    const Eigen::Matrix2d ds = s * h.trace() - hs + spin * turned_s - turned_s * spin;
    const Eigen::Vector2d dm = m * h.trace() - h * m + spin * turned.tail<2>();
    Vector7 dstress = response.tangent * change.strain;
    dstress(k11) += ds(0, 0);
    dstress(k22) += ds(1, 1);
    dstress(k12) += ds(0, 1);
    dstress(k21) += ds(1, 0);
    dstress.tail<2>() += dm;
    tangent.col(column) = b.transpose() * dstress;
    if (continuum == Continuum::cosserat) {
      // s21 - s12 acts on w through N_a, not through the gradients that h s stands for.
      for (Eigen::Index a = 0; a < nodes; ++a)
        tangent(entry_of(a, Dof::w), column) += end.shape(a) * (hs(1, 0) - hs(0, 1));
    }
  }
  return end.volume * tangent;
}

}  // namespace polargrain::fem
