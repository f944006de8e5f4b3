// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/pack/fix_gravity.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "dem/engine/extension.hpp"
#include "dem/sphere_loop/sphere_pass.hpp"

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

namespace {
struct FallingGrain {
  const double* place;
  const double* velocity;
  const double* spin;
  double* force;
  double* torque;
};
}  // namespace

template <typename GrainOf>
void FixGravity::act(GrainOf grain) {
  double unbalanced = 0.0;
  double weight = 0.0;
  for (int k = 0; k < atom->nlocal; ++k) {
    const FallingGrain at = grain(k);
    Eigen::Map<Eigen::Vector3d> force(at.force);
    force.y() +=
        floor_stiffness_ * std::max(0.0, atom->radius[k] - at.place[1]) - atom->rmass[k] * acceleration_;
    unbalanced += force.norm();
    weight += atom->rmass[k] * acceleration_;
    for (int axis = 0; axis < 3; ++axis) {
      force(axis) -= damping_ * std::copysign(force(axis), at.velocity[axis]);
      at.torque[axis] -= damping_ * std::copysign(at.torque[axis], at.spin[axis]);
    }
  }
  unrest_ = weight > 0.0 ? unbalanced / weight : 1.0;
}

void FixGravity::post_force(int) {
  act([this](int k) {
    return FallingGrain{atom->x[k], atom->v[k], atom->omega[k], atom->f[k], atom->torque[k]};
  });
}

void FixGravity::act_on_rows(const double* grains, double* forces) {
  act([grains, forces](int k) {
    const double* const row = grains + static_cast<long>(k) * kGrainStride;
    double* const answer = forces + static_cast<long>(k) * kForceStride;
    return FallingGrain{row, row + 4, row + 8, answer, answer + 4};
  });
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
