// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/pack/fix_space_box.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/elementary_functions.hpp"
#include "dem/engine/extension.hpp"

namespace polargrain::dem {

namespace FixConst = LAMMPS_NS::FixConst;

namespace {
/// Of a length of the box; the engine's search for images is made for half a length.
constexpr double kMostTilt = 0.5;
}  // namespace

FixSpaceBox::FixSpaceBox(LAMMPS_NS::LAMMPS* lammps, int count, char** words) : Fix(lammps, count, words) {
  box_change_size = 1;
  box_change_shape = 1;
  if (!domain->triclinic || domain->dimension != 3 || !domain->xperiodic || !domain->yperiodic ||
      !domain->zperiodic)
    error->all(
        FLERR,
        "A packing of spheres in space needs a script with dimension 3 and boundary p p p, whose box is "
        "set by read_data ${packing}");
}

int FixSpaceBox::setmask() {
  return FixConst::PRE_INITIAL_INTEGRATE | FixConst::POST_INTEGRATE | FixConst::POST_FORCE;
}

void FixSpaceBox::init() {
  // As the engine does for fix deform with `remap v`, which it knows by name only.
  domain->deform_vremap = 1;
  domain->deform_groupbit = groupbit;
  atom->avec->init();
}

Eigen::Matrix3d FixSpaceBox::base_vectors() const {
  Eigen::Matrix3d columns = Eigen::Matrix3d::Zero();
  for (int axis = 0; axis < 3; ++axis) columns(axis, axis) = domain->boxhi[axis] - domain->boxlo[axis];
  columns(0, 1) = domain->xy;
  columns(0, 2) = domain->xz;
  columns(1, 2) = domain->yz;
  return columns;
}

void FixSpaceBox::begin(const Eigen::Matrix3d& gradient, int steps, double damping_rate) {
  start_ = base_vectors();
  gradient_ = gradient;
  steps_ = steps;
  step_ = 0;
  damping_rate_ = damping_rate;
}

Eigen::Matrix3d FixSpaceBox::base_vectors_at(int step) const {
  const double time = std::min(1.0, static_cast<double>(step) / steps_);
  const double fraction = time - sine(2.0 * std::numbers::pi * time) / (2.0 * std::numbers::pi);
  return (Eigen::Matrix3d::Identity() + fraction * gradient_) * start_;
}

void FixSpaceBox::setup(int) {
  sum_unbalanced();
}

void FixSpaceBox::pre_initial_integrate() {
  ++step_;
  const Eigen::Matrix3d before = base_vectors_at(step_ - 1);
  Eigen::Matrix3d rate = Eigen::Matrix3d::Zero();
  if (step_ <= steps_) rate = (base_vectors_at(step_) - before) / update->dt;
  const Eigen::Matrix3d change = (rate - rate_) * before.inverse();
  rate_ = rate;
  // The engine's order: xx, yy, zz, yz, xz, xy.
  for (int axis = 0; axis < 3; ++axis) domain->h_rate[axis] = rate_(axis, axis);
  domain->h_rate[3] = rate_(1, 2);
  domain->h_rate[4] = rate_(0, 2);
  domain->h_rate[5] = rate_(0, 1);
  if (change.isZero(0.0)) return;
  for (int k = 0; k < atom->nlocal; ++k)
    Eigen::Map<Eigen::Vector3d>(atom->v[k]) += change * Eigen::Map<const Eigen::Vector3d>(atom->x[k]);
}

void FixSpaceBox::post_integrate() {
  if (step_ > steps_) return;
  const Eigen::Matrix3d now = base_vectors_at(step_);
  for (int axis = 0; axis < 3; ++axis) {
    domain->boxlo[axis] = 0.0;
    domain->boxhi[axis] = now(axis, axis);
  }
  domain->xy = now(0, 1);
  domain->xz = now(0, 2);
  domain->yz = now(1, 2);
  const bool lies = std::abs(now(0, 1)) > kMostTilt * now(0, 0) ||
                    std::abs(now(0, 2)) > kMostTilt * now(0, 0) ||
                    std::abs(now(1, 2)) > kMostTilt * now(1, 1);
  if (lies)
    error->all(
        FLERR,
        "The box of the packing was sheared by more than half its length on the way to a stress without "
        "shear: take another seed or a smaller inertial_number");
  domain->set_global_box();
  domain->set_lamda_box();
  domain->set_local_box();
}

void FixSpaceBox::sum_unbalanced() {
  unbalanced_force_ = 0.0;
  unbalanced_moment_ = 0.0;
  for (int k = 0; k < atom->nlocal; ++k) {
    unbalanced_force_ += Eigen::Map<const Eigen::Vector3d>(atom->f[k]).norm();
    unbalanced_moment_ += Eigen::Map<const Eigen::Vector3d>(atom->torque[k]).norm();
  }
}

void FixSpaceBox::post_force(int) {
  sum_unbalanced();
  const Eigen::Matrix3d flow = rate_ * base_vectors().inverse();  // the box is that of this step already
  for (int k = 0; k < atom->nlocal; ++k) {
    const double mass = damping_rate_ * atom->rmass[k];
    const double inertia = 0.4 * mass * atom->radius[k] * atom->radius[k];
    const Eigen::Map<const Eigen::Vector3d> place(atom->x[k]);
    const Eigen::Map<const Eigen::Vector3d> velocity(atom->v[k]);
    Eigen::Map<Eigen::Vector3d>(atom->f[k]) -= mass * (velocity - flow * place);
    Eigen::Map<Eigen::Vector3d>(atom->torque[k]) -=
        inertia * Eigen::Map<const Eigen::Vector3d>(atom->omega[k]);
  }
}

namespace {
const Extension kSpaceBox = fix_extension<FixSpaceBox>("pack/space_box");
}  // namespace

}  // namespace polargrain::dem
