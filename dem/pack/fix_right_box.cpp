// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/pack/fix_right_box.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/elementary_functions.hpp"

namespace polargrain::dem {

namespace FixConst = LAMMPS_NS::FixConst;

FixRightBox::FixRightBox(LAMMPS_NS::LAMMPS* lammps, int count, char** words) : Fix(lammps, count, words) {
  box_change_size = 1;
  if (domain->triclinic || domain->dimension != 3 || !domain->xperiodic || !domain->yperiodic ||
      !domain->zperiodic)
    error->all(
        FLERR,
        "A packing of spheres in space needs a script with dimension 3 and boundary p p p, whose box is "
        "that of read_data ${packing}");
}

int FixRightBox::setmask() {
  return FixConst::PRE_INITIAL_INTEGRATE | FixConst::POST_INTEGRATE | FixConst::POST_FORCE;
}

void FixRightBox::init() {
  // What the engine does for fix deform with `remap v`, which it knows by name only.
  domain->deform_vremap = 1;
  domain->deform_groupbit = groupbit;
  atom->avec->init();
}

Eigen::Vector3d FixRightBox::lengths() const {
  return Eigen::Map<const Eigen::Vector3d>(domain->boxhi) - Eigen::Map<const Eigen::Vector3d>(domain->boxlo);
}

void FixRightBox::begin(const Eigen::Vector3d& strain, int steps, double damping_rate) {
  start_ = lengths();
  strain_ = strain;
  steps_ = steps;
  step_ = 0;
  damping_rate_ = damping_rate;
}

Eigen::Vector3d FixRightBox::lengths_at(int step) const {
  const double time = std::min(1.0, static_cast<double>(step) / steps_);
  const double fraction = time - sine(2.0 * std::numbers::pi * time) / (2.0 * std::numbers::pi);
  return start_.array() * (1.0 + fraction * strain_.array());
}

void FixRightBox::setup(int) {
  sum_unbalanced();
}

void FixRightBox::pre_initial_integrate() {
  ++step_;
  Eigen::Vector3d rate = Eigen::Vector3d::Zero();
  if (step_ <= steps_)
    rate = (lengths_at(step_).cwiseQuotient(lengths_at(step_ - 1)).array() - 1.0) / update->dt;
  const Eigen::Vector3d change = rate - rate_;
  rate_ = rate;
  for (int axis = 0; axis < 3; ++axis) domain->h_rate[axis] = rate_(axis) * lengths()(axis);
  if (change.isZero(0.0)) return;
  for (int k = 0; k < atom->nlocal; ++k)
    for (int axis = 0; axis < 3; ++axis) atom->v[k][axis] += change(axis) * atom->x[k][axis];
}

void FixRightBox::post_integrate() {
  if (step_ > steps_) return;
  const Eigen::Vector3d now = lengths_at(step_);
  for (int axis = 0; axis < 3; ++axis) {
    domain->boxlo[axis] = 0.0;
    domain->boxhi[axis] = now(axis);
  }
  domain->set_global_box();
  domain->set_local_box();
}

void FixRightBox::sum_unbalanced() {
  unbalanced_force_ = 0.0;
  unbalanced_moment_ = 0.0;
  for (int k = 0; k < atom->nlocal; ++k) {
    unbalanced_force_ += Eigen::Map<const Eigen::Vector3d>(atom->f[k]).norm();
    unbalanced_moment_ += Eigen::Map<const Eigen::Vector3d>(atom->torque[k]).norm();
  }
}

void FixRightBox::post_force(int) {
  sum_unbalanced();
  for (int k = 0; k < atom->nlocal; ++k) {
    const double mass = damping_rate_ * atom->rmass[k];
    const double inertia = 0.4 * mass * atom->radius[k] * atom->radius[k];
    for (int axis = 0; axis < 3; ++axis) {
      atom->f[k][axis] -= mass * (atom->v[k][axis] - rate_(axis) * atom->x[k][axis]);
      atom->torque[k][axis] -= inertia * atom->omega[k][axis];
    }
  }
}

}  // namespace polargrain::dem
