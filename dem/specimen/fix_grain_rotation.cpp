// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/specimen/fix_grain_rotation.hpp"
#include "dem/engine/extension.hpp"

#include <algorithm>

namespace polargrain::dem {

namespace {
constexpr int kRestartValues = 2;  ///< their number, and the angle
}

FixGrainRotation::FixGrainRotation(LAMMPS_NS::LAMMPS* lammps, int count, char** words)
    : Fix(lammps, count, words) {
  if (count != 3) error->all(FLERR, "Illegal fix grain/rotation command: it takes no arguments");
  if (!atom->omega_flag)
    error->all(FLERR, "Fix grain/rotation needs grains that rotate: atom_style granular");
  restart_peratom = 1;
  peratom_flag = 1;
  size_peratom_cols = 0;
  peratom_freq = 1;
  grow_arrays(atom->nmax);
  std::fill_n(angle_, atom->nmax, 0.0);
  atom->add_callback(0);
  atom->add_callback(1);
}

FixGrainRotation::~FixGrainRotation() {
  atom->delete_callback(id, 0);
  atom->delete_callback(id, 1);
  memory->destroy(angle_);
}

int FixGrainRotation::setmask() {
  return LAMMPS_NS::FixConst::INITIAL_INTEGRATE;
}

void FixGrainRotation::initial_integrate(int) {
  // Before or after the integrator, spin or half-step spin: the angle is that of the step to round-off of
  // order dt^2.
  for (int k = 0; k < atom->nlocal; ++k)
    if (atom->mask[k] & groupbit) angle_[k] += update->dt * atom->omega[k][2];
}

void FixGrainRotation::grow_arrays(int most) {
  memory->grow(angle_, most, "grain/rotation:angle");
  vector_atom = angle_;
}

void FixGrainRotation::copy_arrays(int from, int to, int) {
  angle_[to] = angle_[from];
}

void FixGrainRotation::set_arrays(int index) {
  angle_[index] = 0.0;
}

int FixGrainRotation::pack_exchange(int index, double* buffer) {
  buffer[0] = angle_[index];
  return 1;
}

int FixGrainRotation::unpack_exchange(int index, double* buffer) {
  angle_[index] = buffer[0];
  return 1;
}

int FixGrainRotation::pack_restart(int index, double* buffer) {
  buffer[0] = kRestartValues;
  buffer[1] = angle_[index];
  return kRestartValues;
}

void FixGrainRotation::unpack_restart(int index, int nth) {
  // The values of all fixes stand one after the other, each led by how many it has.
  const double* values = atom->extra[index];
  for (int skip = 0; skip < nth; ++skip) values += static_cast<int>(values[0]);
  angle_[index] = values[1];
}

int FixGrainRotation::size_restart(int) {
  return kRestartValues;
}

int FixGrainRotation::maxsize_restart() {
  return kRestartValues;
}

namespace {
const Extension kGrainRotation = fix_extension<FixGrainRotation>("grain/rotation");
}  // namespace

}  // namespace polargrain::dem
