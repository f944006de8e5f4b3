// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/spheres/fix_space_strain.hpp"

#include <algorithm>
#include <cmath>

#include "dem/contact/closing_factor.hpp"
#include "dem/engine/extension.hpp"

namespace polargrain::dem {

namespace FixConst = LAMMPS_NS::FixConst;

namespace {
/// Of a sphere, over m r^2.
constexpr double kInertia = 0.4;

using Place = Eigen::Map<Eigen::Vector3d>;
}  // namespace

FixSpaceStrain::FixSpaceStrain(LAMMPS_NS::LAMMPS* lammps, int count, char** words)
    : Fix(lammps, count, words), loading_(cell_loading(*lammps)) {
  box_change_size = 1;
  box_change_shape = 1;
  if (count > 3) error->all(FLERR, "Illegal fix cell/space_strain command: it takes no words");
  if (!domain->triclinic || domain->dimension != 3 || !domain->xperiodic || !domain->yperiodic ||
      !domain->zperiodic)
    error->all(FLERR,
               "A cell of spheres in space needs a script with dimension 3 and boundary p p p, whose box is "
               "set by read_data ${packing}");
  // Cells forget the springs of contacts that open, also those of stock models, which would keep them until the
  // next neighbour list.
  neighbor->register_contact_dist_factor(kClosingFactor);
}

int FixSpaceStrain::setmask() {
  return FixConst::PRE_INITIAL_INTEGRATE | FixConst::POST_INTEGRATE | FixConst::POST_FORCE;
}

void FixSpaceStrain::init() {
  // As Domain::init does for fix deform with `remap v`, which it knows by name only.
  domain->deform_vremap = 1;
  domain->deform_groupbit = groupbit;
  atom->avec->init();
}

SpaceBox FixSpaceStrain::engine_box() const {
  SpaceBox box;
  for (int axis = 0; axis < 3; ++axis) box.base(axis, axis) = domain->boxhi[axis] - domain->boxlo[axis];
  box.base(0, 1) = domain->xy;
  box.base(0, 2) = domain->xz;
  box.base(1, 2) = domain->yz;
  return box;
}

void FixSpaceStrain::begin(const SpacePath& path, double damping_rate,
                           const std::optional<SpaceRotation>& rotation) {
  motion_ = SpaceMotion(path, rotation, update->dt);
  damping_rate_ = damping_rate;
  multiplier_.setZero();
  weights_.clear();  // they belong to another path
  loading_ = {};
  std::fill_n(domain->h_rate, 6, 0.0);
  std::fill_n(domain->h_ratelo, 3, 0.0);
  set_box(motion_.box());
}

void FixSpaceStrain::lead(QuasiStatic& protocol, const CellIncrement& increment) {
  const SpaceLead led = lead_along(protocol, box(), increment, update->dt);
  begin(led.path, protocol.damping_rate(), led.rotation);
}

void FixSpaceStrain::fold() {
  const SpaceBox box = motion_.box().reduced();
  for (int k = 0; k < atom->nlocal; ++k) {
    Place place(atom->x[k]);
    place = box.folded(place);
  }
  begin(SpacePath(box, Eigen::Matrix3d::Zero(), 0), damping_rate_);
}

void FixSpaceStrain::set_box(const SpaceBox& box) {
  for (int axis = 0; axis < 3; ++axis) {
    domain->boxlo[axis] = 0.0;
    domain->boxhi[axis] = box.base(axis, axis);
  }
  domain->xy = box.base(0, 1);
  domain->xz = box.base(0, 2);
  domain->yz = box.base(1, 2);
  domain->set_global_box();
  domain->set_lamda_box();
  domain->set_local_box();
}

void FixSpaceStrain::setup(int) {
  balance(false);
}

void FixSpaceStrain::pre_initial_integrate() {
  motion_.advance();
  loading_.bend(motion_.curvature_rate());
  if (motion_.moving()) accelerate();
}

void FixSpaceStrain::accelerate() {
  const Eigen::Matrix3d& change = motion_.change_of_gradient();
  for (int k = 0; k < atom->nlocal; ++k) {
    const Place place(atom->x[k]);
    Place(atom->v[k]).noalias() += change * place;
    Place(atom->omega[k]) += motion_.change_of_spin();
  }
  // Velocity of a face, in the engine's order xx, yy, zz, yz, xz, xy.
  const Eigen::Matrix3d& rate = motion_.rate();
  for (int axis = 0; axis < 3; ++axis) domain->h_rate[axis] = rate(axis, axis);
  domain->h_rate[3] = rate(1, 2);
  domain->h_rate[4] = rate(0, 2);
  domain->h_rate[5] = rate(0, 1);
}

void FixSpaceStrain::post_integrate() {
  if (motion_.moving()) set_box(motion_.box());
  rotations_.resize(3 * static_cast<std::size_t>(atom->nlocal), 0.0);
  const Eigen::Matrix3d turned = update->dt * motion_.box().frame;
  for (int k = 0; k < atom->nlocal; ++k) {
    const Place spin(atom->omega[k]);
    Place(&rotations_[3 * static_cast<std::size_t>(k)]) += turned * spin + motion_.turn();
  }
}

void FixSpaceStrain::post_force(int) {
  balance(damping_rate_ > 0.0);
}

void FixSpaceStrain::balance(bool damped) {
  const bool controlled = motion_.rotation_is_prescribed() && !weights_.empty();
  imbalance_ = {0.0, 0.0, atom->nlocal};
  contact_torques_.resize(static_cast<std::size_t>(atom->nlocal));
  for (int k = 0; k < atom->nlocal; ++k) {
    imbalance_.force += Place(atom->f[k]).norm();
    contact_torques_[static_cast<std::size_t>(k)] = Place(atom->torque[k]);
  }
  if (damped) damp();
  if (controlled) control_mean_rotation();
  const Eigen::Vector3d imposed = motion_.box().volume() * multiplier_;
  for (std::size_t k = 0; k < contact_torques_.size(); ++k) {
    if (controlled) contact_torques_[k] += weights_[k] * imposed;
    imbalance_.moment += contact_torques_[k].norm();
  }
}

void FixSpaceStrain::control_mean_rotation() {
  // The spins of the next half step must average to the prescribed one, see FixCellStrain.
  const double volume = motion_.box().volume();
  Eigen::Vector3d mean_spin = Eigen::Vector3d::Zero();
  double compliance = 0.0;
  for (int k = 0; k < atom->nlocal; ++k) {
    const double gain = update->dt / (kInertia * atom->rmass[k] * atom->radius[k] * atom->radius[k]);
    const double weight = weights_[static_cast<std::size_t>(k)];
    mean_spin += weight * (Place(atom->omega[k]) + gain * Place(atom->torque[k]));
    compliance += weight * weight * gain;
  }
  multiplier_ = (motion_.spin() - mean_spin) / (compliance * volume);
  for (int k = 0; k < atom->nlocal; ++k)
    Place(atom->torque[k]) += weights_[static_cast<std::size_t>(k)] * volume * multiplier_;
}

void FixSpaceStrain::damp() {
  const Eigen::Matrix3d& gradient = motion_.gradient();
  const Eigen::Vector3d& spin = motion_.spin();
  for (int k = 0; k < atom->nlocal; ++k) {
    const double mass_rate = damping_rate_ * atom->rmass[k];
    const double inertia_rate = kInertia * mass_rate * atom->radius[k] * atom->radius[k];
    const Place place(atom->x[k]);
    const Place velocity(atom->v[k]);
    const Eigen::Vector3d flow = gradient * place;
    Place(atom->f[k]) -= mass_rate * (velocity - flow);
    Place(atom->torque[k]) -= inertia_rate * (Place(atom->omega[k]) - spin);
  }
}

SpaceLead lead_along(QuasiStatic& protocol, const SpaceBox& box, const CellIncrement& increment,
                     double time_step) {
  const Eigen::Matrix3d& gradient = increment.displacement_gradient;
  const SpaceRotation rotation{increment.rotation, increment.curvature};
  const SpacePath whole({Eigen::Matrix3d::Identity()}, gradient, 1);
  protocol.begin(largest_principal_strain(whole), rotation.against(whole).norm(), increment.curvature.norm(),
                 time_step);
  return {SpacePath(box, gradient, protocol.loading()),
          protocol.controlled() ? std::optional(rotation) : std::nullopt};
}

namespace {
const Extension kSpaceStrain = fix_extension<FixSpaceStrain>("cell/space_strain");
}  // namespace

}  // namespace polargrain::dem
