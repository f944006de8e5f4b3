// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/cell/fix_cell_strain.hpp"

#include <algorithm>
#include <cstring>

#include "dem/contact/closing_factor.hpp"
#include "dem/engine/extension.hpp"

namespace polargrain::dem {

using LAMMPS_NS::LAMMPS;
namespace FixConst = LAMMPS_NS::FixConst;

template <int dim>
FixCellStrain<dim>::FixCellStrain(LAMMPS* lammps, int count, char** words)
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
  if (std::strcmp(update->unit_style, "si") != 0)
    error->all(FLERR, "Fix cell/strain needs units si: stresses and strains come and go in them");
  if (dim == 2 && (!domain->xperiodic || !domain->yperiodic))
    error->all(FLERR, "Fix cell/strain needs a box that is periodic along x and y: boundary p p p");
  if (dim == 2 && !domain->triclinic)
    error->all(FLERR, "Fix cell/strain needs a triclinic box (a line 'xy xz yz' in the data)");
  if (dim == 3 && (!domain->triclinic || !domain->xperiodic || !domain->yperiodic || !domain->zperiodic))
    error->all(FLERR,
               "A cell of spheres in space needs a script with dimension 3 and boundary p p p, whose box is "
               "set by read_data ${packing}");
  // Cells forget the springs of contacts that open, also those of stock models, which would keep them until the
  // next neighbour list.
  neighbor->register_contact_dist_factor(kClosingFactor);
}

template <int dim>
int FixCellStrain<dim>::setmask() {
  return FixConst::PRE_INITIAL_INTEGRATE | FixConst::POST_INTEGRATE | FixConst::POST_FORCE;
}

template <int dim>
void FixCellStrain<dim>::init() {
  // As Domain::init does for fix deform with `remap v`, which it knows by name only: grains that cross a
  // face and images of grains get the velocity difference of the faces. The atom style keeps its own copy.
  domain->deform_vremap = 1;
  domain->deform_groupbit = groupbit;
  atom->avec->init();
}

template <int dim>
Box<dim> FixCellStrain<dim>::engine_box() const {
  Box<dim> box;
  for (int axis = 0; axis < dim; ++axis) box.base(axis, axis) = domain->boxhi[axis] - domain->boxlo[axis];
  box.base(0, 1) = domain->xy;
  if constexpr (dim == 3) {
    box.base(0, 2) = domain->xz;
    box.base(1, 2) = domain->yz;
  }
  return box;
}

template <int dim>
void FixCellStrain<dim>::begin(const BoxPath<dim>& path, double damping_rate, const Loading& rotation) {
  motion_ = BoxMotion<dim>(path, rotation, update->dt);
  damping_rate_ = damping_rate;
  if constexpr (dim == 2) depth_ = domain->boxhi[2] - domain->boxlo[2];
  multiplier_.setZero();
  weights_.clear();  // they belong to another path
  loading_ = {};
  std::fill_n(domain->h_rate, 6, 0.0);
  std::fill_n(domain->h_ratelo, 3, 0.0);
  set_box(motion_.box());
}

template <int dim>
void FixCellStrain<dim>::fold() {
  const Box<dim> box = motion_.box().reduced();
  for (int k = 0; k < grains(); ++k) place(k) = box.folded(place(k));
  begin(BoxPath<dim>(box), damping_rate_);
}

template <int dim>
void FixCellStrain<dim>::set_box(const Box<dim>& box) {
  for (int axis = 0; axis < dim; ++axis) {
    domain->boxlo[axis] = 0.0;
    domain->boxhi[axis] = box.base(axis, axis);
  }
  domain->xy = box.base(0, 1);
  if constexpr (dim == 3) {
    domain->xz = box.base(0, 2);
    domain->yz = box.base(1, 2);
  }
  domain->set_global_box();
  domain->set_lamda_box();
  domain->set_local_box();
}

template <int dim>
void FixCellStrain<dim>::setup(int) {
  balance(false);
}

template <int dim>
void FixCellStrain<dim>::pre_initial_integrate() {
  motion_.advance();
  loading_.bend(motion_.curvature_rate());
  if (motion_.moving()) accelerate();
}

template <int dim>
void FixCellStrain<dim>::accelerate() {
  for (int k = 0; k < grains(); ++k) {
    velocity(k).noalias() += motion_.change_of_gradient() * place(k);
    spin(k) += motion_.change_of_spin();
  }
  // Velocity of a face, in the engine's order xx, yy, zz, yz, xz, xy.
  const auto& rate = motion_.rate();
  for (int axis = 0; axis < dim; ++axis) domain->h_rate[axis] = rate(axis, axis);
  domain->h_rate[5] = rate(0, 1);
  if constexpr (dim == 3) {
    domain->h_rate[3] = rate(1, 2);
    domain->h_rate[4] = rate(0, 2);
  }
}

template <int dim>
void FixCellStrain<dim>::post_integrate() {
  if (motion_.moving()) set_box(motion_.box());
  rotations_.resize(static_cast<std::size_t>(grains()) * Cosserat<dim>::rotations, 0.0);
  Eigen::Matrix<double, Cosserat<dim>::rotations, Cosserat<dim>::rotations>
      turned;  // of a spin over the step
  if constexpr (dim == 2) {
    turned << update->dt;
  } else {
    turned = update->dt * box().orientation;
  }
  auto* rotation = rotations_.data();
  for (int k = 0; k < grains(); ++k, rotation += Cosserat<dim>::rotations)
    ThisRotation(rotation) += turned * spin(k) + motion_.turn();
}

template <int dim>
void FixCellStrain<dim>::post_force(int) {
  balance(damping_rate_ > 0.0);
}

template <int dim>
void FixCellStrain<dim>::balance(bool damped) {
  imbalance_ = {0.0, 0.0, grains()};
  contact_torques_.resize(static_cast<std::size_t>(grains()));
  for (int k = 0; k < grains(); ++k) {
    imbalance_.force += force_on(k).norm();
    contact_torques_[static_cast<std::size_t>(k)] = torque_on(k);
  }
  if (damped) damp();
  if (controlled()) control_mean_rotation();
  const Rotation imposed = multiplier_ * box().size() * depth_;
  for (std::size_t k = 0; k < contact_torques_.size(); ++k) {
    if (controlled()) contact_torques_[k] += imposed * weights_[k];
    imbalance_.moment += contact_torques_[k].norm();
  }
}

template <int dim>
void FixCellStrain<dim>::control_mean_rotation() {
  // The spins of the next half step must average to the prescribed one, sum W (spin + dt (T + lambda W) / I)
  // = V rate with W = V weight (C.6). All grains get the change of the rate until then alike.
  Rotation mean_spin = Rotation::Zero();
  double compliance = 0.0;
  for (int k = 0; k < grains(); ++k) {
    const double gain = update->dt / inertia(k);
    const double weight = weights_[static_cast<std::size_t>(k)];
    mean_spin += weight * (spin(k) + gain * torque_on(k));
    compliance += weight * weight * gain;
  }
  multiplier_ = (motion_.spin() - mean_spin) / (compliance * volume());
  for (int k = 0; k < grains(); ++k)
    torque_on(k) += multiplier_ * volume() * weights_[static_cast<std::size_t>(k)];
}

template <int dim>
void FixCellStrain<dim>::damp() {
  const auto& gradient = motion_.gradient();
  for (int k = 0; k < grains(); ++k) {
    Place against = velocity(k);  // the affine flow
    for (int axis = 0; axis < dim; ++axis) against -= gradient.col(axis) * atom->x[k][axis];
    force_on(k) -= damping_rate_ * atom->rmass[k] * against;
    torque_on(k) -= damping_rate_ * inertia(k) * (spin(k) - motion_.spin());
  }
}

template <int dim>
typename FixCellStrain<dim>::Rotation FixCellStrain<dim>::multiplier() const {
  if constexpr (dim == 2) {
    return multiplier_;
  } else {
    return box().orientation * multiplier_;
  }
}

template class FixCellStrain<2>;
template class FixCellStrain<3>;

namespace {
/// One name for both; the dimension of the script decides.
LAMMPS_NS::Fix* make_cell_strain(LAMMPS* lammps, int count, char** words) {
  if (lammps->domain->dimension == 3) return new FixCellStrain<3>(lammps, count, words);
  return new FixCellStrain<2>(lammps, count, words);
}
const Extension kCellStrain([](LAMMPS& engine) {
  fix_table(*engine.modify)["cell/strain"] = &make_cell_strain;
});
}  // namespace

}  // namespace polargrain::dem
