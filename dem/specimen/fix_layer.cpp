// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/specimen/fix_layer.hpp"
#include "dem/engine/extension.hpp"

#include <group.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

namespace polargrain::dem {

using LAMMPS_NS::Fix;
using LAMMPS_NS::LAMMPS;
namespace FixConst = LAMMPS_NS::FixConst;

namespace {

/// Shear over which the plate comes to its speed.
constexpr double kLayerRunUp = 1e-3;
/// Share of the critical damping while the layer is sheared. It dilates then, and what brakes the plate carries part of
/// its pressure: 1.5 % of it with critical damping, at an inertial number of 2e-4.
constexpr double kDampingInShear = 0.05;
constexpr double kSameDepth = 1e-6;  ///< relative

}  // namespace

FixLayer::FixLayer(LAMMPS* lammps, int count, char** words) : Fix(lammps, count, words) {
  restart_global = 1;
  vector_flag = 1;
  size_vector = 10;
  global_freq = 1;
  extvector = 0;

  const auto fail = [&](const std::string& message) {
    error->all(FLERR, ("Illegal fix layer command: " + message).c_str());
  };
  const std::array<std::pair<const char*, double*>, 3> settings{
      {{"pressure", &pressure_}, {"modulus", &modulus_}, {"thickness", &thickness_}}};
  const std::array<std::pair<const char*, int*>, 2> plates{{{"lower", &lower_}, {"upper", &upper_}}};
  for (int k = 3; k < count; k += 2) {
    if (k + 1 == count) fail("a value is missing after the last word");
    const auto is_word = [&](const auto& known) { return std::strcmp(words[k], known.first) == 0; };
    const auto* const plate = std::find_if(plates.begin(), plates.end(), is_word);
    const auto* const setting = std::find_if(settings.begin(), settings.end(), is_word);
    if (plate != plates.end()) {
      const int number = group->find(words[k + 1]);
      if (number < 0) fail(fmt::format("there is no group '{}'", words[k + 1]));
      *plate->second = group->bitmask[number];
    } else if (setting != settings.end()) {
      *setting->second = force->numeric(FLERR, words[k + 1]);
    } else {
      fail(fmt::format("'{}' is not one of lower, upper, pressure, modulus, thickness", words[k]));
    }
  }
  if (lower_ == 0 || upper_ == 0) fail("name the groups of the plates: lower GROUP upper GROUP");
  if (!(pressure_ > 0.0) || !(modulus_ > 0.0) || !(thickness_ > 0.0))
    fail("pressure, modulus and thickness must be positive");
  if (!domain->xperiodic || domain->yperiodic || !domain->zperiodic)
    error->all(FLERR, "Fix layer needs a box that is not periodic along y: boundary p f p");
  if (domain->dimension == 3 && std::abs(thickness_ / domain->zprd - 1.0) > kSameDepth)
    error->all(FLERR, "Fix layer: the thickness of a layer of spheres is the depth of its box");
  if (comm->nprocs > 1) error->all(FLERR, "Fix layer runs in one process");
}

int FixLayer::setmask() {
  return FixConst::POST_FORCE;
}

void FixLayer::init() {
  plate_mass_ = 0.0;
  mean_diameter_ = 0.0;
  int lower = 0;
  int both = 0;
  for (int k = 0; k < atom->nlocal; ++k) {
    mean_diameter_ += 2.0 * atom->radius[k] / atom->nlocal;
    const bool up = (atom->mask[k] & upper_) != 0;
    const bool low = (atom->mask[k] & lower_) != 0;
    if (up) plate_mass_ += atom->rmass[k];
    if (low) ++lower;
    if (up && low) ++both;
  }
  if (plate_mass_ == 0.0 || lower == 0) error->all(FLERR, "Fix layer: a plate has no grains");
  if (both > 0) error->all(FLERR, "Fix layer: a grain belongs to both plates");
}

void FixLayer::setup(int) {
  if (state_.rate > 0.0 && state_.reference_height == 0.0) {
    state_.reference_height = height();
    state_.displacement = 0.0;
    state_.time = 0.0;
    state_.velocity_x = 0.0;
  }
  // Forces of a run's start are those of the step before it, which the plate has moved by already.
  hold_plates();
}

void FixLayer::post_force(int) {
  hold_plates();
  move_upper_plate();
}

void FixLayer::hold_plates() {
  force_x_upper_ = force_y_upper_ = force_x_lower_ = force_y_lower_ = 0.0;
  double unbalanced = 0.0;
  int free = 0;
  for (int k = 0; k < atom->nlocal; ++k) {
    double* const f = atom->f[k];
    const bool up = (atom->mask[k] & upper_) != 0;
    if (!up && (atom->mask[k] & lower_) == 0) {
      unbalanced += std::sqrt(f[0] * f[0] + f[1] * f[1] + f[2] * f[2]);
      ++free;
      continue;
    }
    (up ? force_x_upper_ : force_x_lower_) += f[0];
    (up ? force_y_upper_ : force_y_lower_) += f[1];
    std::fill_n(f, 3, 0.0);
    std::fill_n(atom->torque[k], 3, 0.0);
    std::fill_n(atom->omega[k], 3, 0.0);
    atom->v[k][0] = up ? state_.velocity_x : 0.0;
    atom->v[k][1] = up ? state_.velocity_y : 0.0;
    atom->v[k][2] = 0.0;
  }
  unbalanced_ = free > 0 ? unbalanced / free / (pressure_ * depth_of_grain() * mean_diameter_) : 0.0;
}

void FixLayer::move_upper_plate() {
  const double dt = update->dt;
  if (state_.rate > 0.0) {
    state_.displacement += state_.velocity_x * dt;
    state_.time += dt;
    state_.velocity_x =
        std::min(1.0, state_.time * state_.rate / kLayerRunUp) * state_.rate * state_.reference_height;
  }
  // A packing is half as stiff as its contacts: modulus 2 E r of a contact of discs over the thickness, of spheres over a diameter.
  const double stiffness =
      0.5 * modulus_ * mean_diameter_ * (thickness_ / depth_of_grain()) * width() / height();
  const double load = force_y_upper_ - pressure_ * thickness_ * width();
  const double drag = (state_.rate > 0.0 ? kDampingInShear : 1.0) * 2.0 * std::sqrt(stiffness / plate_mass_);
  // The drag is taken at the end of the step, which is stable for any step.
  state_.velocity_y = (state_.velocity_y + dt * load / plate_mass_) / (1.0 + dt * drag);
  for (int k = 0; k < atom->nlocal; ++k) {
    if ((atom->mask[k] & upper_) == 0) continue;
    atom->v[k][0] = state_.velocity_x;
    atom->v[k][1] = state_.velocity_y;
  }
}

double FixLayer::height() const {
  double top = std::numeric_limits<double>::infinity();
  double bottom = -top;
  for (int k = 0; k < atom->nlocal; ++k) {
    if ((atom->mask[k] & upper_) != 0) top = std::min(top, atom->x[k][1]);
    if ((atom->mask[k] & lower_) != 0) bottom = std::max(bottom, atom->x[k][1]);
  }
  return top - bottom;
}

double FixLayer::depth_of_grain() const {
  return domain->dimension == 3 ? mean_diameter_ : thickness_;
}

double FixLayer::width() const {
  return domain->boxhi[0] - domain->boxlo[0];
}

double FixLayer::compute_vector(int index) {
  const double area = width() * thickness_;
  const double stress = 0.5 * (force_x_lower_ - force_x_upper_) / area;
  const double reference = state_.reference_height;
  const bool sheared = reference > 0.0;
  const std::array<double, 10> values{sheared ? state_.displacement / reference : 0.0,
                                      state_.displacement,
                                      stress,
                                      stress / pressure_,
                                      -force_y_lower_ / area / pressure_,
                                      sheared ? height() - reference : 0.0,
                                      height(),
                                      force_x_upper_,
                                      force_x_lower_,
                                      unbalanced_};
  return values[static_cast<std::size_t>(index)];
}

int FixLayer::modify_param(int count, char** words) {
  if (count < 2 || std::strcmp(words[0], "shear") != 0) return 0;
  const double rate = force->numeric(FLERR, words[1]);
  if (!(rate > 0.0)) error->all(FLERR, "Illegal fix_modify command: shear needs a positive rate, 1/s");
  if (state_.rate == rate) return 2;  // a restarted script says it again: the shear goes on
  state_.rate = rate;
  state_.reference_height = 0.0;  // taken at the start of the next run
  return 2;
}

void FixLayer::write_restart(FILE* file) {
  if (comm->me != 0) return;
  const int size = static_cast<int>(sizeof(State));
  std::fwrite(&size, sizeof(int), 1, file);
  std::fwrite(&state_, sizeof(State), 1, file);
}

void FixLayer::restart(char* buffer) {
  std::memcpy(&state_, buffer, sizeof(State));
}

namespace {
const Extension kLayer = fix_extension<FixLayer>("layer");
}  // namespace

}  // namespace polargrain::dem
