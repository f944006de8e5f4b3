// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/specimen/fix_biaxial.hpp"
#include "dem/engine/extension.hpp"

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

/// Strain over which the platen comes to its speed.
constexpr double kRunUp = 1e-3;
constexpr double kPlatenMass = 0.1;  ///< of the grains' mass
/// Part of its radius by which a grain under the membrane may sink before the membrane leaves it. Without it
/// a grain that the membrane just touches is pushed in, left, springs back, and is pushed again for ever.
constexpr double kSlack = 0.05;
/// Searches for which a grain that the membrane has left is braked. It was pressed against others and springs
/// off them; flying, it would come under the membrane again, be pushed in again, and drum on the specimen for
/// ever.
constexpr int kBraked = 50;

}  // namespace

FixBiaxial::FixBiaxial(LAMMPS* lammps, int count, char** words) : Fix(lammps, count, words) {
  restart_global = 1;
  vector_flag = 1;
  size_vector = 12;
  global_freq = 1;
  extvector = 0;
  nevery = 1;  // end_of_step is called every so many steps

  const auto fail = [&](const char* message) { error->all(FLERR, message); };
  const std::array<std::pair<const char*, double*>, 5> settings{{{"pressure", &pressure_},
                                                                 {"modulus", &modulus_},
                                                                 {"damping", &damping_},
                                                                 {"thickness", &thickness_},
                                                                 {"probe", &probe_}}};
  for (int k = 3; k < count; k += 2) {
    if (k + 1 == count) fail("Illegal fix biaxial command: a value is missing after the last word");
    if (std::strcmp(words[k], "every") == 0) {
      every_ = force->inumeric(FLERR, words[k + 1]);
      if (every_ < 1) fail("Illegal fix biaxial command: every must be at least 1");
      continue;
    }
    const auto* const known = std::find_if(settings.begin(), settings.end(), [&](const auto& setting) {
      return std::strcmp(words[k], setting.first) == 0;
    });
    if (known == settings.end())
      fail(fmt::format(
               "Illegal fix biaxial command: '{}' is not one of pressure, modulus, damping, thickness, "
               "probe, every",
               words[k])
               .c_str());
    *known->second = force->numeric(FLERR, words[k + 1]);
    if (!(*known->second >= 0.0)) fail("Illegal fix biaxial command: values must not be negative");
  }
  if (!(pressure_ > 0.0) || !(modulus_ > 0.0) || !(thickness_ > 0.0))
    fail("Illegal fix biaxial command: pressure, modulus and thickness must be positive");
  if (domain->dimension != 2) fail("Fix biaxial needs dimension 2");
  if (domain->xperiodic || domain->yperiodic)
    fail("Fix biaxial needs a box that is not periodic: boundary f f p");
  if (comm->nprocs > 1) fail("Fix biaxial runs in one process");
}

int FixBiaxial::setmask() {
  return FixConst::INITIAL_INTEGRATE | FixConst::POST_FORCE | FixConst::END_OF_STEP;
}

void FixBiaxial::init() {
  if (atom->map_style == 0) error->all(FLERR, "Fix biaxial needs a script line: atom_modify map array");
  double greatest = 0.0;
  mean_diameter_ = 0.0;
  grain_mass_ = 0.0;
  for (int k = 0; k < atom->nlocal; ++k) {
    greatest = std::max(greatest, atom->radius[k]);
    mean_diameter_ += 2.0 * atom->radius[k] / atom->nlocal;
    grain_mass_ += atom->rmass[k];
  }
  if (atom->nlocal == 0) error->all(FLERR, "Fix biaxial: there are no grains");
  if (probe_ == 0.0) probe_ = 2.0 * greatest;
}

void FixBiaxial::place_platens() {
  state_.bottom = std::numeric_limits<double>::infinity();
  state_.top = -state_.bottom;
  for (int k = 0; k < atom->nlocal; ++k) {
    state_.bottom = std::min(state_.bottom, atom->x[k][1] - atom->radius[k]);
    state_.top = std::max(state_.top, atom->x[k][1] + atom->radius[k]);
  }
  state_.placed = 1.0;
}

void FixBiaxial::setup(int vflag) {
  if (state_.placed == 0.0) place_platens();
  find_chains();
  if (state_.rate > 0.0 && state_.reference_height == 0.0) {
    state_.reference_height = height();
    state_.reference_area = area();
    state_.time = 0.0;
    state_.top_velocity = 0.0;
  }
  post_force(vflag);
  measure_unbalanced();
}

void FixBiaxial::initial_integrate(int) {
  if (state_.rate > 0.0) {
    state_.time += update->dt;
    const double share = std::min(1.0, state_.time * state_.rate / kRunUp);
    state_.top_velocity = -share * state_.rate * state_.reference_height;
  } else {
    move_under_pressure();
  }
  state_.top += state_.top_velocity * update->dt;
}

void FixBiaxial::move_under_pressure() {
  const double mass = kPlatenMass * grain_mass_;
  // A packing is half as stiff as its contacts: modulus 2 E r of a contact over the thickness.
  const double stiffness = 0.5 * modulus_ * mean_diameter_ * area() / (height() * height());
  const double load = excess_forces().first;
  const double drag = 2.0 * std::sqrt(stiffness / mass);
  // The drag is taken at the end of the step, which is stable for any step.
  state_.top_velocity = (state_.top_velocity + update->dt * load / mass) / (1.0 + update->dt * drag);
}

void FixBiaxial::post_force(int) {
  if (update->ntimestep % every_ == 0) find_chains();
  push_platens();
  push_membrane();
  brake_freed();
}

void FixBiaxial::brake_freed() {
  for (const int tag : freed_) {
    const int k = atom->map(tag);
    if (k < 0) continue;
    const double drag = 2.0 * damping_ * std::sqrt(2.0 * modulus_ * atom->radius[k] * atom->rmass[k]);
    const double along = state_.top_velocity * (atom->x[k][1] - state_.bottom) / height();
    atom->f[k][0] -= drag * atom->v[k][0];
    atom->f[k][1] -= drag * (atom->v[k][1] - along);
  }
}

void FixBiaxial::push_platens() {
  top_force_ = 0.0;
  bottom_force_ = 0.0;
  for (int k = 0; k < atom->nlocal; ++k) {
    const double radius = atom->radius[k];
    const double y = atom->x[k][1];
    const double above = y + radius - state_.top;
    const double below = state_.bottom - (y - radius);
    if (above <= 0.0 && below <= 0.0) continue;
    const double stiffness = 2.0 * modulus_ * radius;
    const double drag = 2.0 * damping_ * std::sqrt(stiffness * atom->rmass[k]);
    if (above > 0.0) {
      const double push = std::max(0.0, stiffness * above + drag * (atom->v[k][1] - state_.top_velocity));
      atom->f[k][1] -= push;
      top_force_ += push;
    }
    if (below > 0.0) {
      const double push = std::max(0.0, stiffness * below - drag * atom->v[k][1]);
      atom->f[k][1] += push;
      bottom_force_ += push;
    }
  }
}

void FixBiaxial::find_chains() {
  const auto tags = [&](Side side, const std::vector<int>& held) {
    std::vector<Disc> discs(static_cast<std::size_t>(atom->nlocal));
    for (int k = 0; k < atom->nlocal; ++k)
      discs[static_cast<std::size_t>(k)] = {{atom->x[k][0], atom->x[k][1]}, atom->radius[k]};
    for (const int tag : held) discs[static_cast<std::size_t>(atom->map(tag))].radius *= 1.0 + kSlack;
    std::vector<int> chain;
    for (const std::size_t k : membrane_chain(discs, probe_, state_.bottom, state_.top, side))
      chain.push_back(atom->tag[k]);
    return chain;
  };
  try {
    for (int& left : searches_left_) --left;
    for (const auto& [chain, side] : {std::pair(&left_, Side::left), std::pair(&right_, Side::right)}) {
      const std::vector<int> before = std::exchange(*chain, tags(side, *chain));
      for (const int tag : before) {
        if (std::find(chain->begin(), chain->end(), tag) != chain->end()) continue;
        freed_.push_back(tag);
        searches_left_.push_back(kBraked);
      }
    }
    const auto over =
        std::find_if(searches_left_.begin(), searches_left_.end(), [](int left) { return left > 0; });
    freed_.erase(freed_.begin(), freed_.begin() + (over - searches_left_.begin()));
    searches_left_.erase(searches_left_.begin(), over);
  } catch (const std::exception& problem) {
    error->all(FLERR, fmt::format("Fix biaxial at step {}: {}", update->ntimestep, problem.what()).c_str());
  }
}

std::vector<Eigen::Vector2d> FixBiaxial::centres(const std::vector<int>& tags) const {
  std::vector<Eigen::Vector2d> places;
  for (const int tag : tags) {
    const int k = atom->map(tag);
    if (k < 0) error->all(FLERR, "Fix biaxial: a grain under the membrane left the box");
    places.emplace_back(atom->x[k][0], atom->x[k][1]);
  }
  return places;
}

void FixBiaxial::push_membrane() {
  const auto push = [&](const std::vector<int>& tags, Side side) {
    const std::vector<Eigen::Vector2d> forces =
        membrane_forces(centres(tags), pressure_ * thickness_, state_.bottom, state_.top, side);
    double sum = 0.0;
    for (std::size_t k = 0; k < tags.size(); ++k) {
      double* const f = atom->f[atom->map(tags[k])];
      f[0] += forces[k].x();
      f[1] += forces[k].y();
      sum += forces[k].x();
    }
    return sum;
  };
  left_force_ = push(left_, Side::left);
  right_force_ = push(right_, Side::right);
}

void FixBiaxial::add_springs(std::vector<Contact>& contacts, Inertia& inertia) const {
  const double endless = std::numeric_limits<double>::infinity();
  const auto body = [&inertia, endless](double mass) {
    inertia.masses.push_back(mass);
    inertia.moments.push_back(endless);
    inertia.radii.push_back(0.0);
    return static_cast<int>(inertia.masses.size()) - 1;
  };
  const int ground = body(endless);
  const int plate = body(state_.rate > 0.0 ? endless : kPlatenMass * grain_mass_);
  const auto spring = [&contacts](int grain, int other, const Eigen::Vector2d& branch) -> Contact& {
    Contact& added = contacts.emplace_back();
    added.first = grain;
    added.second = other;
    added.branch.head<2>() = branch;
    return added;
  };
  for (int k = 0; k < atom->nlocal; ++k) {
    const double radius = atom->radius[k];
    const double y = atom->x[k][1];
    const double stiffness = 2.0 * modulus_ * radius;
    const auto platen = [&](int which, double way) {
      Contact& contact = spring(k, which, {0.0, way * radius});
      contact.normal_stiffness = stiffness;
      contact.normal_viscosity = 2.0 * damping_ * std::sqrt(stiffness * atom->rmass[k]);
    };
    if (y + radius > state_.top) platen(plate, 1.0);
    if (y - radius < state_.bottom) platen(ground, -1.0);
  }
  for (const std::vector<int>* const chain : {&left_, &right_})
    for (const int tag : *chain) {
      Contact& pressed = spring(atom->map(tag), ground, Eigen::Vector2d::UnitX());
      pressed.normal_stiffness = pressed.tangential_stiffness = pressure_ * thickness_;
    }
}

std::pair<double, double> FixBiaxial::excess_forces() const {
  const auto x = [&](int tag) { return atom->x[atom->map(tag)][0]; };
  const double line_pressure = pressure_ * thickness_;
  return {top_force_ - line_pressure * (x(right_.back()) - x(left_.back())),
          bottom_force_ - line_pressure * (x(right_.front()) - x(left_.front()))};
}

double FixBiaxial::area() const {
  return enclosed_area(centres(left_), centres(right_), state_.bottom, state_.top);
}

void FixBiaxial::measure_unbalanced() {
  double sum = 0.0;
  for (int k = 0; k < atom->nlocal; ++k) {
    const double* const f = atom->f[k];
    sum += std::sqrt(f[0] * f[0] + f[1] * f[1]);
  }
  unbalanced_ = sum / atom->nlocal / (pressure_ * thickness_ * mean_diameter_);
}

void FixBiaxial::end_of_step() {
  measure_unbalanced();
}

double FixBiaxial::compute_vector(int index) {
  if (left_.empty()) return 0.0;
  const double width = area() / height();
  const auto [top_excess, bottom_excess] = excess_forces();
  const double stress = pressure_ + 0.5 * (top_excess + bottom_excess) / (thickness_ * width);
  const bool compressed = state_.reference_height > 0.0;
  const std::array<double, 12> values{compressed ? 1.0 - height() / state_.reference_height : 0.0,
                                      stress,
                                      stress / pressure_,
                                      compressed ? area() / state_.reference_area - 1.0 : 0.0,
                                      width,
                                      height(),
                                      top_force_,
                                      bottom_force_,
                                      unbalanced_,
                                      static_cast<double>(left_.size() + right_.size()),
                                      left_force_,
                                      right_force_};
  return values[static_cast<std::size_t>(index)];
}

int FixBiaxial::modify_param(int count, char** words) {
  if (count < 2 || std::strcmp(words[0], "compress") != 0) return 0;
  const double rate = force->numeric(FLERR, words[1]);
  if (!(rate > 0.0)) error->all(FLERR, "Illegal fix_modify command: compress needs a positive rate, 1/s");
  if (state_.rate == rate) return 2;  // a restarted script says it again: the compression goes on
  state_.rate = rate;
  state_.reference_height = 0.0;  // taken at the start of the next run
  return 2;
}

void FixBiaxial::write_restart(FILE* file) {
  if (comm->me != 0) return;
  // The state, then the chains, each led by its length.
  std::vector<int> chains;
  for (const std::vector<int>* const chain : {&left_, &right_, &freed_, &searches_left_}) {
    chains.push_back(static_cast<int>(chain->size()));
    chains.insert(chains.end(), chain->begin(), chain->end());
  }
  const int size = static_cast<int>(sizeof(State) + chains.size() * sizeof(int));
  std::fwrite(&size, sizeof(int), 1, file);
  std::fwrite(&state_, sizeof(State), 1, file);
  std::fwrite(chains.data(), sizeof(int), chains.size(), file);
}

void FixBiaxial::restart(char* buffer) {
  std::memcpy(&state_, buffer, sizeof(State));
  const char* place = buffer + sizeof(State);
  for (std::vector<int>* const chain : {&left_, &right_, &freed_, &searches_left_}) {
    int length = 0;
    std::memcpy(&length, place, sizeof(int));
    place += sizeof(int);
    chain->resize(static_cast<std::size_t>(length));
    std::memcpy(chain->data(), place, chain->size() * sizeof(int));
    place += chain->size() * sizeof(int);
  }
}

namespace {
const Extension kBiaxial = fix_extension<FixBiaxial>("biaxial");
}  // namespace

}  // namespace polargrain::dem
