// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/cell/fix_cell_strain.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstring>

#include "dem/contact/closing_factor.hpp"
#include "dem/engine/extension.hpp"

namespace polargrain::dem {

using LAMMPS_NS::Fix;
using LAMMPS_NS::LAMMPS;
namespace FixConst = LAMMPS_NS::FixConst;

FixCellStrain::FixCellStrain(LAMMPS* lammps, int count, char** words)
    : Fix(lammps, count, words), loading_(cell_loading(*lammps)) {
  box_change_size = 1;
  box_change_shape = 1;
  for (int k = 3; k < count; k += 2) {
    if (std::strcmp(words[k], "damping") != 0 || k + 1 == count)
      error->all(FLERR, "Illegal fix cell/strain command: expected 'damping RATE'");
    damping_rate_ = force->numeric(FLERR, words[k + 1]);
    if (!(damping_rate_ >= 0.0))
      error->all(FLERR, "Illegal fix cell/strain command: damping must not be negative");
  }
  if (!domain->triclinic)
    error->all(FLERR, "Fix cell/strain needs a triclinic box (a line 'xy xz yz' in the data)");
  if (domain->dimension != 2) error->all(FLERR, "Fix cell/strain needs dimension 2");
  // Cells forget the springs of contacts that open, also those of stock models, which would keep them until the
  // next neighbour list.
  neighbor->register_contact_dist_factor(kClosingFactor);
}

int FixCellStrain::setmask() {
  return FixConst::PRE_INITIAL_INTEGRATE | FixConst::POST_INTEGRATE | FixConst::POST_FORCE;
}

void FixCellStrain::init() {
  // As Domain::init does for fix deform with `remap v`, which it knows by name only: grains that cross a
  // face and images of grains get the velocity difference of the faces. The atom style keeps its own copy.
  domain->deform_vremap = 1;
  domain->deform_groupbit = groupbit;
  atom->avec->init();
}

void FixCellStrain::begin(const BoxPath& path, double damping_rate, std::optional<RotationLoading> rotation) {
  motion_ = BoxMotion(path, rotation, update->dt);
  multiplier_ = 0.0;
  held_.clear();
  weights_.clear();  // they belong to another path
  thickness_ = domain->boxhi[2] - domain->boxlo[2];
  damping_rate_ = damping_rate;
  loading_ = {};
  std::fill_n(domain->h_rate, 6, 0.0);
  std::fill_n(domain->h_ratelo, 3, 0.0);
  set_box(motion_.box());
}

void FixCellStrain::set_box(const Box& box) {
  domain->boxlo[0] = 0.0;
  domain->boxlo[1] = 0.0;
  domain->boxhi[0] = box.length_x;
  domain->boxhi[1] = box.length_y;
  domain->xy = box.tilt;
  domain->set_global_box();
  domain->set_lamda_box();
  domain->set_local_box();
}

void FixCellStrain::setup(int) {
  balance(false);
}

void FixCellStrain::move_held_grains() {
  const Eigen::Matrix2d gradient = motion_.gradient_before();
  const Eigen::Vector2d& bending = motion_.curvature_rate();
  const Eigen::Vector2d centre = 0.5 * motion_.box_before().base_vectors().rowwise().sum();
  for (int k = 0; k < atom->nlocal; ++k) {
    if (!held_[k]) continue;
    const Eigen::Vector2d place(atom->x[k][0], atom->x[k][1]);
    const Eigen::Vector2d velocity = gradient * place;
    atom->v[k][0] = velocity.x();
    atom->v[k][1] = velocity.y();
    atom->omega[k][2] = motion_.spin() + bending.dot(place - centre);
  }
}

void FixCellStrain::take_reactions() {
  reactions_.assign(held_.size(), Eigen::Vector3d::Zero());
  for (std::size_t k = 0; k < held_.size(); ++k) {
    if (!held_[k]) continue;
    reactions_[k] = -Eigen::Vector3d(atom->f[k][0], atom->f[k][1], atom->torque[k][2]);
    atom->f[k][0] = atom->f[k][1] = atom->torque[k][2] = 0.0;
  }
}

void FixCellStrain::pre_initial_integrate() {
  motion_.advance();
  if (held_.empty()) loading_.bend_in_plane(motion_.curvature_rate());
  if (motion_.moving()) accelerate();
  if (!held_.empty()) move_held_grains();
}

void FixCellStrain::accelerate() {
  double** const x = atom->x;
  double** const v = atom->v;
  double** const omega = atom->omega;
  const Eigen::Matrix2d& change = motion_.change_of_gradient();
  for (int k = 0; k < atom->nlocal; ++k) {
    v[k][0] += change(0, 0) * x[k][0] + change(0, 1) * x[k][1];
    v[k][1] += change(1, 0) * x[k][0] + change(1, 1) * x[k][1];
    omega[k][2] += motion_.change_of_spin();
  }
  // Velocity of a face, in the engine's order xx, yy, zz, yz, xz, xy.
  const Eigen::Matrix2d& rate = motion_.rate();
  domain->h_rate[0] = rate(0, 0);
  domain->h_rate[1] = rate(1, 1);
  domain->h_rate[5] = rate(0, 1);
}

void FixCellStrain::post_integrate() {
  if (motion_.moving()) set_box(motion_.box());
  rotations_.resize(static_cast<std::size_t>(atom->nlocal), 0.0);
  for (int k = 0; k < atom->nlocal; ++k) rotations_[k] += update->dt * atom->omega[k][2] + motion_.turn();
}

void FixCellStrain::post_force(int) {
  balance(damping_rate_ > 0.0);
}

void FixCellStrain::balance(bool damped) {
  if (!held_.empty()) take_reactions();
  sum_unbalanced_forces();
  contact_torques_.resize(static_cast<std::size_t>(atom->nlocal));
  for (int k = 0; k < atom->nlocal; ++k) contact_torques_[k] = atom->torque[k][2];
  if (damped) damp();
  if (controlled()) control_mean_rotation();
  sum_unbalanced_moments();
}

void FixCellStrain::set_rotation_weights(std::span<const double> weights) {
  weights_.assign(weights.begin(), weights.end());
}

void FixCellStrain::control_mean_rotation() {
  // The spins of the next half step must average to the prescribed one, sum W (spin + dt (T + lambda W) / I)
  // = V rate with W = V weight (C.6). All grains get the change of the rate until then alike.
  const double volume = box().area() * thickness_;
  double mean_spin = 0.0;
  double compliance = 0.0;
  for (int k = 0; k < atom->nlocal; ++k) {
    const double moment_of_inertia = 0.5 * atom->rmass[k] * atom->radius[k] * atom->radius[k];  // disc
    const double gain = update->dt / moment_of_inertia;
    mean_spin += weights_[k] * (atom->omega[k][2] + gain * atom->torque[k][2]);
    compliance += weights_[k] * weights_[k] * gain;
  }
  multiplier_ = (motion_.spin() - mean_spin) / (compliance * volume);
  for (int k = 0; k < atom->nlocal; ++k) atom->torque[k][2] += multiplier_ * volume * weights_[k];
}

void FixCellStrain::sum_unbalanced_forces() {
  imbalance_.force = 0.0;
  imbalance_.grains = atom->nlocal;
  double** const f = atom->f;
  for (int k = 0; k < atom->nlocal; ++k) imbalance_.force += std::sqrt(f[k][0] * f[k][0] + f[k][1] * f[k][1]);
}

void FixCellStrain::sum_unbalanced_moments() {
  imbalance_.moment = 0.0;
  const double imposed = controlled() ? multiplier_ * box().area() * thickness_ : 0.0;
  for (int k = 0; k < atom->nlocal; ++k)
    imbalance_.moment += std::abs(contact_torques_[k] + (controlled() ? imposed * weights_[k] : 0.0));
}

void FixCellStrain::damp() {
  const Eigen::Matrix2d& gradient = motion_.gradient();
  double** const x = atom->x;
  double** const v = atom->v;
  double** const f = atom->f;
  for (int k = 0; k < atom->nlocal; ++k) {
    if (!held_.empty() && held_[k]) continue;
    const double mass_rate = damping_rate_ * atom->rmass[k];
    f[k][0] -= mass_rate * (v[k][0] - gradient(0, 0) * x[k][0] - gradient(0, 1) * x[k][1]);
    f[k][1] -= mass_rate * (v[k][1] - gradient(1, 0) * x[k][0] - gradient(1, 1) * x[k][1]);
    const double moment_of_inertia = 0.5 * atom->rmass[k] * atom->radius[k] * atom->radius[k];  // disc
    atom->torque[k][2] -= damping_rate_ * moment_of_inertia * (atom->omega[k][2] - motion_.spin());
  }
}

namespace {
const Extension kCellStrain = fix_extension<FixCellStrain>("cell/strain");
}  // namespace

}  // namespace polargrain::dem
