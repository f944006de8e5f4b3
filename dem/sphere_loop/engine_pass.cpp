// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/sphere_loop/engine_pass.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "dem/contact/cell_loading.hpp"
#include "dem/contact/force_pass.hpp"
#include "dem/contact/points_up.hpp"
#include "dem/engine/engine_part.hpp"
#include "dem/engine/liggghts.hpp"
#include "dem/engine/private_access.hpp"
#include "dem/lanes/instruction_set.hpp"
#include "dem/sphere_loop/engine_histories.hpp"
#include "dem/sphere_loop/sphere_box.hpp"

namespace polargrain::dem {

namespace {

using LAMMPS_NS::LAMMPS;
using LAMMPS_NS::PairGran;

/// A frozen grain takes no part in the mass of a contact: beside this one, any other mass is the whole.
constexpr double kMassOfFrozen = 1e200;  // kg

/// The pass of the kernels over the engine's own list of neighbours. The engine's ghosts are grains like others; forces on
/// them are dropped, as each process computes its own side of a contact. Springs stay here while a list lasts.
class EnginePass final : public ForcePass {
 public:
  EnginePass(LAMMPS& lammps, PairGran& pair, LawCombination combination)
      : lammps_(lammps),
        pair_(pair),
        kernel_(kernel_of(sphere_kernels(best_instruction_set()), combination)),
        places_(history_places(combination)),
        loading_(cell_loading(lammps)) {
    spheres_.combination = std::move(combination);
    list_.spring_count = springs_in_pass(spheres_.combination);
    list_.images.assign(1, SpaceLattice{});
  }

  void add_forces() override {
    if (holds_ && grains_have_changed()) hand_back();
    if (!holds_)
      take_over();
    else if (lammps_.neighbor->ncalls != built_)
      lammps_.error->one(FLERR, "Internal error: a list of neighbours was made anew while springs were lent");
    gather();
    SpherePass pass = pass_over(list_, spheres_.combination);
    pass.grains = grains_.data();
    pass.forces = forces_.data();
    pass.images = no_image_;
    pass.reach = kAnyGap;
    pass.step = lammps_.update->dt;
    pass.advance = pair_.shearupdate() != 0;
    pass.bends = loading_.bends();
    std::ranges::copy(loading_.rate(), pass.curvature_rate);
    kernel_(pass);
    scatter();
    // Between two runs anybody may ask.
    if (lammps_.update->ntimestep == lammps_.update->laststep) hand_back();
  }

  void hand_back() override {
    if (!holds_) return;
    holds_ = false;
    const auto values = static_cast<std::size_t>(pair_.dnum());
    for (std::size_t c = 0; c < histories_.size(); ++c) {
      const History& to = histories_[c];
      if (to.flag == nullptr) continue;
      bool stressed = false;
      std::fill_n(to.values, values, 0.0);
      for (int k = 0; k < list_.spring_count; ++k) {
        const double spring = list_.springs[k][c];
        stressed = stressed || spring != 0.0;
        if (places_[k] >= 0) to.values[places_[k]] = to.seen(k, spring);
      }
      *to.flag = stressed ? 1 : 0;
    }
  }

 private:
  static constexpr double kAnyGap = 1e300;

  /// Where the engine keeps whether two grains touch, and the springs of their contact.
  struct History {
    int* flag = nullptr;
    double* values = nullptr;
    bool from_second = false;  ///< the engine looks from the second grain: springs point the other way

    /// A spring as the other of the two sides sees it, whose torsion looks alike.
    [[nodiscard]] double seen(int spring, double value) const {
      return from_second && spring != kTorsion ? -value : value;
    }
  };

  /// Whether a fix has made grains larger or heavier while the list lasts.
  [[nodiscard]] bool grains_have_changed() const {
    const LAMMPS_NS::Atom& atom = *lammps_.atom;
    bool changed = false;
    for (int k = 0; k < atom.nlocal; ++k)
      changed = changed | (atom.radius[k] != spheres_.radii[static_cast<std::size_t>(k)]) |
                (atom.rmass[k] != list_masses_[k]);
    return changed;
  }

  /// Grains, neighbours and springs as the engine has them.
  void take_over() {
    const LAMMPS_NS::Atom& atom = *lammps_.atom;
    const int count = atom.nlocal + atom.nghost;
    const auto n = static_cast<std::size_t>(count);
    spheres_.radii.assign(atom.radius, atom.radius + count);
    list_masses_.assign(atom.rmass, atom.rmass + count);
    spheres_.masses = list_masses_;
    spheres_.inertias.resize(n);
    spheres_.types.resize(n);
    // As the rolling law of the engine takes them, of frozen grains too.
    const double shape = lammps_.domain->dimension == 2 ? 0.5 : 0.4;
    for (int k = 0; k < count; ++k) {
      spheres_.inertias[static_cast<std::size_t>(k)] =
          shape * atom.rmass[k] * atom.radius[k] * atom.radius[k];
      spheres_.types[static_cast<std::size_t>(k)] = atom.type[k] - 1;
      if (atom.mask[k] & pair_.freeze_group_bit())
        spheres_.masses[static_cast<std::size_t>(k)] = kMassOfFrozen;
    }
    grains_.assign((n + 2) * kGrainStride, 0.0);
    forces_.assign((n + 2) * kForceStride, 0.0);
    grains_[(n + 1) * kGrainStride] = 1.0;  // two places without a grain lie apart
    gather();
    take_neighbours();
    fill_constants(spheres_, list_);
    for (std::size_t c = 0; c < histories_.size(); ++c) {
      if (histories_[c].flag == nullptr || *histories_[c].flag == 0) continue;
      for (int k = 0; k < list_.spring_count; ++k)
        if (places_[k] >= 0) list_.springs[k][c] = histories_[c].seen(k, histories_[c].values[places_[k]]);
    }
    built_ = lammps_.neighbor->ncalls;
    holds_ = true;
  }

  void take_neighbours() {
    const LAMMPS_NS::NeighList& neighbours = *pair_.list;
    const int values = pair_.dnum();
    SphereZones zones;
    std::array<std::vector<History>, 2> histories;  // of touching pairs, and of near ones
    for (int row = 0; row < neighbours.inum; ++row) {
      const int i = neighbours.ilist[row];
      for (int place = 0; place < neighbours.numneigh[i]; ++place) {
        const int j = neighbours.firstneigh[i][place] & NEIGHMASK;
        const History history{&pair_.listgranhistory->firstneigh[i][place],
                              &pair_.listgranhistory->firstdouble[i][values * place], !is_first(i, j)};
        const std::size_t zone = touches(i, j) || *history.flag != 0 ? 0 : 1;
        zones[zone].push_back(history.from_second ? SpherePair{j, i, 0, 0.0} : SpherePair{i, j, 0, 0.0});
        histories[zone].push_back(history);
      }
    }
    histories_.clear();
    for (std::vector<History>& part : histories) {
      part.resize((part.size() + kBlock - 1) / kBlock * kBlock);
      histories_.insert(histories_.end(), part.begin(), part.end());
    }
    list_.take(std::move(zones), grains_.data(), static_cast<int>(spheres_.radii.size()));
  }

  /// Laws may tell the two grains of a contact apart (rolling_kinematics.hpp); the first one has the lower tag.
  [[nodiscard]] bool is_first(int i, int j) const {
    const int* const tag = lammps_.atom->tag;
    if (tag[i] != tag[j]) return tag[i] < tag[j];
    const double* const a = lammps_.atom->x[i];
    const double* const b = lammps_.atom->x[j];
    const double delta[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    return points_up(delta);
  }

  [[nodiscard]] bool touches(int i, int j) const {
    const double* const a = &grains_[static_cast<std::size_t>(i) * kGrainStride];
    const double* const b = &grains_[static_cast<std::size_t>(j) * kGrainStride];
    double square = 0.0;
    for (int axis = 0; axis < 3; ++axis) square += (a[axis] - b[axis]) * (a[axis] - b[axis]);
    return square < (a[3] + b[3]) * (a[3] + b[3]);
  }

  /// Places, velocities and spins of all grains; their forces are zero.
  void gather() {
    const LAMMPS_NS::Atom& atom = *lammps_.atom;
    const int count = static_cast<int>(spheres_.radii.size());
    // The engine's arrays of vectors are one piece each.
    const double* const places = atom.x[0];
    const double* const velocities = atom.v[0];
    const double* const spins = atom.omega[0];
    for (int k = 0; k < count; ++k) {
      double* const row = &grains_[static_cast<std::size_t>(k) * kGrainStride];
      for (int axis = 0; axis < 3; ++axis) {
        row[axis] = places[3 * k + axis];
        row[4 + axis] = velocities[3 * k + axis];
        row[8 + axis] = spins[3 * k + axis];
      }
      row[3] = atom.radius[k];
    }
    std::ranges::fill(forces_, 0.0);
  }

  void scatter() {
    double* const forces = lammps_.atom->f[0];
    double* const torques = lammps_.atom->torque[0];
    for (int k = 0; k < lammps_.atom->nlocal; ++k) {
      const double* const row = &forces_[static_cast<std::size_t>(k) * kForceStride];
      for (int axis = 0; axis < 3; ++axis) {
        forces[3 * k + axis] += row[axis];
        torques[3 * k + axis] += row[4 + axis];
      }
    }
  }

  LAMMPS& lammps_;
  PairGran& pair_;
  SphereKernels::Pass kernel_;
  std::array<int, kSphereSprings> places_;
  const CellLoading& loading_;
  Spheres spheres_;
  std::vector<double> list_masses_;  // of the engine when the list was taken, those of frozen grains too, kg
  SphereList list_;
  LineVector<double> grains_, forces_;
  double no_image_[kImageStride] = {};
  std::vector<History> histories_;  // of each candidate; empty ones of dummies
  bool holds_ = false;              // the springs here are newer than the engine's
  LAMMPS_NS::bigint built_ = 0;     // number of the engine's list
};

/// The engine's keeper of contact histories, which asks for springs before it moves them along with their grains.
class HistoryOfPass final : public LAMMPS_NS::FixContactHistory {
 public:
  using FixContactHistory::FixContactHistory;
  void pre_exchange() override {
    if (ForcePass* const pass = part_of<ForcePasses>(*lmp).in_use) pass->hand_back();
    FixContactHistory::pre_exchange();
  }
};

/// Tells the user, once.
void tell(LAMMPS& lammps, const std::string& line) {
  std::string& told = part_of<ForcePasses>(lammps).told;
  if (lammps.comm->me != 0 || told == line) return;
  told = line;
  for (FILE* const stream : {lammps.screen, lammps.logfile})
    if (stream != nullptr) std::fprintf(stream, "suffix fast: %s\n", line.c_str());
}

std::unique_ptr<ForcePass> make_pass(LAMMPS& lammps, PairGran& pair) {
  LawSelection selection = known_models(lammps);
  if (selection.combination && pair.dnum() != history_values(*selection.combination))
    selection = {std::nullopt, "a fix that keeps values of contacts beside the models"};
  if (!selection.combination) {
    tell(lammps,
         "contacts in LIGGGHTS's own loop, which is slower: there are no kernels for " + selection.reason);
    return nullptr;
  }
  tell(lammps, fmt::format("contacts by kernels for {} ({})", name_of(best_instruction_set()),
                           selection.combination->name()));
  return std::make_unique<EnginePass>(lammps, pair, std::move(*selection.combination));
}

}  // namespace

void offer_fast_pass(LAMMPS& lammps) {
  part_of<ForcePasses>(lammps).make = &make_pass;
  fix_table(*lammps.modify)["contacthistory"] = [](LAMMPS* engine, int count,
                                                   char** words) -> LAMMPS_NS::Fix* {
    return new HistoryOfPass(engine, count, words);
  };
}

}  // namespace polargrain::dem
