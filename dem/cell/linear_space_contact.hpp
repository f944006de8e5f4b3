// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>

#include "dem/cell/increment_slip.hpp"
#include "dem/contact/contact_recorder.hpp"

namespace polargrain::dem {

/// The law of one contact of spheres linearised where it stands (docs/theory/grains.md, C.9): from the opening (three
/// components of the displacement of the second surface against the first, and the rotation vector of the second grain
/// against the first) to the change of force and moment on the first grain.
///
/// Of a spring that has given way over the increment the rest along and across its way acts
/// (spring_left_along, spring_left_across), and it changes with the normal force by the rest of its share in it: a contact
/// that slides to the end of the increment keeps |f_t| = mu f_n, one at its rolling limit |M| = (limit / f_n) f_n. The
/// torsion spring acts where the law has one (li_chu), and the rolling stiffness of models that do not tell it counts as
/// zero.
struct SpaceContactStiffness {
  Eigen::Vector3d branch;  ///< from the centre of the first to that of the second, m
  Eigen::Vector3d normal;
  Eigen::Matrix3d force_of_opening;   ///< N/m
  Eigen::Matrix3d moment_of_opening;  ///< N
  Eigen::Matrix3d moment_of_turning;  ///< N m/rad

  /// @param frame turns vectors of the contact into the frame of the strain
  SpaceContactStiffness(const Contact& contact, const Eigen::Matrix3d& frame, const SpaceSlip& slip = {});
};

/// x -> n x x
Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& n);

/// The same as one matrix, with the motions and strains that open the contact.
struct LinearSpaceContact {
  Eigen::Matrix<double, 6, 6> stiffness;  ///< N/m, N; N, N m/rad
  Eigen::Matrix<double, 6, 12> motions;   ///< opening from (u, rotation) of the first, then the second grain
  Eigen::Matrix<double, 6, 18>
      affine;  ///< opening from a Cosserat strain; transposed: V stress from the force

  /// @param frame turns vectors of the contact into the frame of the strain
  LinearSpaceContact(const Contact& contact, const Eigen::Matrix3d& frame, const SpaceSlip& slip = {});
};

/// The law in its parts, for the products that a network takes of it (RelaxedNetwork): most of the matrices of
/// LinearSpaceContact are zeros and ones.
class SpaceContactParts {
 public:
  template <int Strains>
  using Sides = Eigen::Matrix<double, 12, Strains>;
  template <int Strains>
  using Forces = Eigen::Matrix<double, 6, Strains>;

  /// @param arm m: rotations of grains count as arc lengths of it
  SpaceContactParts(const Contact& contact, const SpaceContactStiffness& law, double arm)
      : law_(law),
        lever_(cross_matrix(law.normal)),
        arms_{contact.arm_first / arm, contact.arm_second / arm},
        polar_(0.5 * (contact.arm_second - contact.arm_first)),
        curl_(1.0 / arm) {}

  /// Its share in the equations of the grains' motions, with what the strains leave out of balance.
  template <int Strains, class Strain, class Equations>
  void share(const Strain& strains, Equations& added) const;
  /// @param motion of both grains @param stresses their sum over the contacts, times the volume: added to @param on_grains
  /// forces @param affine_forces without the motion, N
  template <int Strains, class Strain>
  void relax(const Sides<Strains>& motion, const Strain& strains, Strain& stresses, Sides<Strains>& on_grains,
             Forces<Strains>& affine_forces) const;

 private:
  /// Opening by strains: surfaces, then turning.
  template <int Strains, class Strain>
  void open(const Strain& strains, Forces<Strains>& opening) const;
  template <int Strains>
  void answer(const Forces<Strains>& opening, Forces<Strains>& forces) const;
  template <int Strains>
  void load(const Forces<Strains>& forces, Sides<Strains>& on_grains) const;

  SpaceContactStiffness law_;
  Eigen::Matrix3d lever_;
  double arms_[2];
  double polar_;  // m: half the difference of the arms
  double curl_;   // 1/m: from an arc length to its angle
};

template <int Strains, class Strain>
void SpaceContactParts::open(const Strain& strains, Forces<Strains>& opening) const {
  const auto by_branch = [this, &strains](int row) {
    return law_.branch(0) * strains.template middleRows<3>(row) +
           law_.branch(1) * strains.template middleRows<3>(row + 3) +
           law_.branch(2) * strains.template middleRows<3>(row + 6);
  };
  opening.template topRows<3>() = by_branch(0);
  opening.template bottomRows<3>() = by_branch(9);
  opening.template topRows<3>() += polar_ * lever_.lazyProduct(opening.template bottomRows<3>());
}

template <int Strains>
void SpaceContactParts::answer(const Forces<Strains>& opening, Forces<Strains>& forces) const {
  forces.template topRows<3>() = law_.force_of_opening.lazyProduct(opening.template topRows<3>());
  forces.template bottomRows<3>() = law_.moment_of_opening.lazyProduct(opening.template topRows<3>());
  forces.template bottomRows<3>() += law_.moment_of_turning.lazyProduct(opening.template bottomRows<3>());
}

template <int Strains>
void SpaceContactParts::load(const Forces<Strains>& forces, Sides<Strains>& on_grains) const {
  const Eigen::Matrix<double, 3, Strains> torque = lever_.lazyProduct(forces.template topRows<3>());
  on_grains.template middleRows<3>(0) = -forces.template topRows<3>();
  on_grains.template middleRows<3>(3) = -arms_[0] * torque - curl_ * forces.template bottomRows<3>();
  on_grains.template middleRows<3>(6) = forces.template topRows<3>();
  on_grains.template middleRows<3>(9) = -arms_[1] * torque + curl_ * forces.template bottomRows<3>();
}

template <int Strains, class Strain, class Equations>
void SpaceContactParts::share(const Strain& strains, Equations& added) const {
  const Eigen::Matrix3d& force = law_.force_of_opening;
  const Eigen::Matrix3d of_turn = force * lever_;
  const Eigen::Matrix3d torque = lever_ * force;
  const Eigen::Matrix3d torque_of_turn = lever_ * of_turn;
  const Eigen::Matrix3d moment = curl_ * law_.moment_of_opening;
  const Eigen::Matrix3d moment_of_turn = moment * lever_;
  const Eigen::Matrix3d turning = (curl_ * curl_) * law_.moment_of_turning;
  // The first grain moves its surface by -u + r_A n x w, the second by u + r_B n x w.
  for (int row = 0; row < 2; ++row)
    for (int column = 0; column < 2; ++column) {
      const double sign = row == column ? 1.0 : -1.0;
      const double of_row = row == 0 ? -1.0 : 1.0;
      const double arm = arms_[column];
      auto block = added.stiffness.template block<6, 6>(6 * row, 6 * column);
      block.template topLeftCorner<3, 3>() = sign * force;
      block.template topRightCorner<3, 3>() = (of_row * arm) * of_turn;
      block.template bottomLeftCorner<3, 3>() =
          sign * moment - (column == 0 ? -arms_[row] : arms_[row]) * torque;
      block.template bottomRightCorner<3, 3>() =
          sign * turning - (arms_[row] * arm) * torque_of_turn + (of_row * arm) * moment_of_turn;
    }
  Forces<Strains> opening, forces;
  Sides<Strains> on_grains;
  open<Strains>(strains, opening);
  answer<Strains>(opening, forces);
  load<Strains>(forces, on_grains);
  added.right_sides.template leftCols<Strains>() = -on_grains;
}

template <int Strains, class Strain>
void SpaceContactParts::relax(const Sides<Strains>& motion, const Strain& strains, Strain& stresses,
                              Sides<Strains>& on_grains, Forces<Strains>& affine_forces) const {
  Forces<Strains> opening, forces;
  open<Strains>(strains, opening);
  answer<Strains>(opening, affine_forces);
  affine_forces.template bottomRows<3>() *= curl_;
  opening.template topRows<3>() += motion.template middleRows<3>(6) - motion.template middleRows<3>(0);
  const Eigen::Matrix<double, 3, Strains> turned =
      arms_[0] * motion.template middleRows<3>(3) + arms_[1] * motion.template middleRows<3>(9);
  opening.template topRows<3>() += lever_.lazyProduct(turned);
  opening.template bottomRows<3>() +=
      curl_ * (motion.template middleRows<3>(9) - motion.template middleRows<3>(3));
  answer<Strains>(opening, forces);
  load<Strains>(forces, on_grains);
  // The couple: the moment, and the polar part of the force.
  forces.template bottomRows<3>() -= polar_ * lever_.lazyProduct(forces.template topRows<3>());
  for (int i = 0; i < 3; ++i) {
    stresses.template middleRows<3>(3 * i) += law_.branch(i) * forces.template topRows<3>();
    stresses.template middleRows<3>(9 + 3 * i) += law_.branch(i) * forces.template bottomRows<3>();
  }
}

}  // namespace polargrain::dem
