// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/pack/fix_gravity.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "dem/engine/extension.hpp"

namespace polargrain::dem {

FixGravity::FixGravity(LAMMPS_NS::LAMMPS* lammps, int count, char** words) : Fix(lammps, count, words) {}

int FixGravity::setmask() {
  return LAMMPS_NS::FixConst::POST_FORCE;
}

void FixGravity::begin(double acceleration, double floor_stiffness, double damping) {
  acceleration_ = acceleration;
  floor_stiffness_ = floor_stiffness;
  damping_ = damping;
}

void FixGravity::post_force(int) {
  double unbalanced = 0.0;
  double weight = 0.0;
  for (int k = 0; k < atom->nlocal; ++k) {
    Eigen::Map<Eigen::Vector3d> force(atom->f[k]);
    force.y() +=
        floor_stiffness_ * std::max(0.0, atom->radius[k] - atom->x[k][1]) - atom->rmass[k] * acceleration_;
    unbalanced += force.norm();
    weight += atom->rmass[k] * acceleration_;
    for (int axis = 0; axis < 3; ++axis) {
      force(axis) -= damping_ * std::copysign(force(axis), atom->v[k][axis]);
      double& torque = atom->torque[k][axis];
      torque -= damping_ * std::copysign(torque, atom->omega[k][axis]);
    }
  }
  unrest_ = weight > 0.0 ? unbalanced / weight : 1.0;
}

FixGravity& add_gravity(Engine& engine) {
  engine.command("fix polargrain_gravity all pack/gravity");
  LAMMPS_NS::Modify& modify = *engine.lammps().modify;
  return dynamic_cast<FixGravity&>(*modify.fix[modify.find_fix("polargrain_gravity")]);
}

namespace {
const Extension kGravity = fix_extension<FixGravity>("pack/gravity");
}  // namespace

}  // namespace polargrain::dem
