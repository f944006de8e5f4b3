// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "dem/engine/engine_part.hpp"

namespace polargrain::dem {

/// One contact as the force computation saw it. Grain indices are the engine's local ones. A contact across a
/// periodic face is recorded once.
struct Contact {
  int first = 0;
  int second = 0;
  // Vectors in the frame of the box. Between discs branch and force lie in the plane, and moments along e_3.
  Eigen::Vector3d branch = Eigen::Vector3d::Zero();  ///< from the centre of first to the centre of second, m
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   ///< on first, by second, N
  /// Rolling resistance moment on first by second (conjugate to the rotation of second relative to first), N m, of any
  /// rolling model.
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  double normal_stiffness = 0.0;      ///< N/m
  double tangential_stiffness = 0.0;  ///< N/m
  double normal_viscosity = 0.0;      ///< of the dashpot, N s/m
  double tangential_viscosity = 0.0;  ///< N s/m
  double arm_first = 0.0;             ///< centre of first to the contact point, m
  double arm_second = 0.0;
  double friction = 0.0;  ///< sliding friction coefficient of the pair; 0 when the script has no friction
  double rolling_stiffness = 0.0;  ///< k_th, N m/rad; known for rolling models li_chu and epsd2, otherwise 0
  bool rolling_at_limit = false;   ///< the rolling spring stands at its limit (rolling models li_chu, epsd2)
  double rolling_limit = 0.0;      ///< of the rolling moment, N m; 0 where it is not known
  double torsion_stiffness =
      0.0;  ///< against twisting about the normal, N m/rad; known for li_chu, otherwise 0
  bool torsion_at_limit = false;  ///< the torsion spring stands at its limit (li_chu)

  [[nodiscard]] Eigen::Vector3d normal() const { return branch.normalized(); }  ///< from first to second
  /// Compressive normal force, positive when the grains push each other.
  [[nodiscard]] double normal_force() const { return -force.dot(normal()); }
  /// Of discs: force on first along t = e_3 x n.
  [[nodiscard]] double tangential_force() const {
    const Eigen::Vector3d n = normal();
    return -force.x() * n.y() + force.y() * n.x();
  }
  /// The couple conjugate to the curvature along the branch: the rolling moment, and the polar part of the
  /// tangential force, which grains of unequal radii have (docs/theory/grains.md, C.8); N m.
  [[nodiscard]] Eigen::Vector3d couple() const {
    return moment + 0.5 * (arm_second - arm_first) * force.cross(normal());
  }
  /// The tangential spring stands at its Coulomb limit. The force computation scales it exactly there, so
  /// only round-off is allowed for.
  [[nodiscard]] bool sliding() const {
    const Eigen::Vector3d n = normal();
    const double along = force.dot(n);
    return friction > 0.0 && (force - along * n).norm() >= friction * std::abs(along) * (1.0 - 1e-9);
  }
};

/// Takes down the contacts of one force computation while it is switched on. The engine's loop over pairs is
/// the only place that knows a contact's stiffnesses, so it is asked there, in passing, without a second
/// loop.
struct ContactRecorder {
  /// The values that only the rolling law knows of the contact under way; it leaves them here for the taking down.
  struct Rolling {
    double stiffness = 0.0;
    bool at_limit = false;
    double limit = 0.0;
    double torsion_stiffness = 0.0;
    bool torsion_at_limit = false;
  };

  bool on = false;
  Rolling rolling;
  std::vector<Contact> contacts;
};

/// The recorder that the contact models of this engine write to.
inline ContactRecorder& contact_recorder(LAMMPS_NS::LAMMPS& lammps) {
  return part_of<ContactRecorder>(lammps);
}

}  // namespace polargrain::dem
