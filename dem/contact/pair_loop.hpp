// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cmath>
#include <cstring>
#include <memory>

#include "dem/contact/contact_recorder.hpp"
#include "dem/contact/force_pass.hpp"
#include "dem/contact/spoken_settings.hpp"
#include "dem/engine/engine_part.hpp"
#include "dem/engine/liggghts.hpp"

namespace polargrain::dem {

/// The engine's own loop over pairs of grains, for everything that is rare: virial tallies, `compute
/// pair/gran/local`, rigid bodies, stored contact forces. The frequent work of a cell, the plain force
/// pass, is done by a leaner loop over the same neighbour list with the same models and the same order of
/// additions, so that both give the same bits. All calls are inlined into it, which lets the compiler keep a
/// contact in registers; bench/contact_loop measures what that saves. Where a script says `suffix fast` and the program
/// offers a quicker pass, that one does the plain passes.
template <typename Model>
class PairLoop final : public LIGGGHTS::PairStyles::Granular<Model>, public SettingsSource {
  using Base = LIGGGHTS::PairStyles::Granular<Model>;

 public:
  PairLoop(LAMMPS_NS::LAMMPS* lammps, LAMMPS_NS::PairGran* pair, int64_t hash)
      : Base(lammps, pair, hash),
        lammps_(*lammps),
        model_(*part_of<typename Model::LastMade>(*lammps).model),
        pair_(*pair),
        recorder_(contact_recorder(*lammps)),
        passes_(part_of<ForcePasses>(*lammps)),
        asks_for_pass_(lammps->suffix_enable != 0 && lammps->suffix != nullptr &&
                       std::strcmp(lammps->suffix, "fast") == 0) {}
  ~PairLoop() override { use(nullptr); }

  [[nodiscard]] const SpokenSettings& spoken_settings() const override { return model_.spoken_settings(); }

  void init_granular() override {
    Base::init_granular();
    // Rare features that only show as fixes; looked up once a run, not once a step.
    rare_fixes_ = lammps_.modify->n_fixes_style("insert/stream/predefined") > 0 ||
                  lammps_.modify->n_fixes_style("relax_contacts") > 0;
    // Parameters may be others than in the run before.
    if (pass_) pass_->hand_back();
    if (asks_for_pass_ && passes_.make) use(passes_.make(lammps_, pair_));
  }

  void compute_force(LAMMPS_NS::PairGran* pair, int eflag, int vflag, int addflag) override {
    const bool plain =
        !eflag && !vflag && !(pair->cpl() && addflag) && !pair->fr_pair() && !pair->storeSumDelta() &&
        !pair->storeContactForces() && !pair->storeContactForcesStress() && !pair->store_sum_normal_force() &&
        !lammps_.force->newton_pair && !rare_fixes_ && pair->computeflag() && lammps_.atom->rmass;
    if (plain && pass_ && !recorder_.on) {
      pass_->add_forces();
      return;
    }
    if (pass_) pass_->hand_back();
    if (plain)
      plain_pass(*pair);
    else
      Base::compute_force(pair, eflag, vflag, addflag);
  }

 private:
  void use(std::unique_ptr<ForcePass> pass) {
    if (pass_ && passes_.in_use == pass_.get()) passes_.in_use = nullptr;
    pass_ = std::move(pass);
    if (pass_) passes_.in_use = pass_.get();
  }

  /// One long function: values kept at hand over all pairs would be handed from part to part, once a contact.
  __attribute__((flatten)) void plain_pass(LAMMPS_NS::PairGran& pair) {
    using LIGGGHTS::ContactModels::ForceData;
    using LIGGGHTS::ContactModels::SurfacesIntersectData;
    Model& model = model_;
    const LAMMPS_NS::Atom& atom = *lammps_.atom;
    const LAMMPS_NS::NeighList& list = *pair.list;
    const double close_factor =
        lammps_.neighbor->contactDistanceFactor * lammps_.neighbor->contactDistanceFactor;
    const int history_values = pair.dnum();
    const int frozen = pair.freeze_group_bit();
    int** const all_flags = pair.listgranhistory ? pair.listgranhistory->firstneigh : nullptr;
    double** const all_histories = pair.listgranhistory ? pair.listgranhistory->firstdouble : nullptr;

    {
      SurfacesIntersectData pass{};
      ForceData force_i;
      ForceData force_j;
      pass.computeflag = pair.computeflag();
      pass.shearupdate = pair.shearupdate();
      model.beginPass(pass, force_i, force_j);
    }

    for (int row = 0; row < list.inum; ++row) {
      const int i = list.ilist[row];
      const double* const xi = atom.x[i];
      const double radius_i = atom.radius[i];
      int* const flags = all_flags ? all_flags[i] : nullptr;
      double* const histories = all_histories ? all_histories[i] : nullptr;
      const int* const neighbours = list.firstneigh[i];
      const int count = list.numneigh[i];
      for (int place = 0; place < count; ++place) {
        const int j = neighbours[place] & NEIGHMASK;
        const double* const xj = atom.x[j];
        const double delta[3] = {xi[0] - xj[0], xi[1] - xj[1], xi[2] - xj[2]};
        const double square = delta[0] * delta[0] + delta[1] * delta[1] + delta[2] * delta[2];
        const double sum_of_radii = radius_i + atom.radius[j];
        const bool touching = square < sum_of_radii * sum_of_radii;
        if (!touching && !(square < close_factor * sum_of_radii * sum_of_radii)) continue;

        SurfacesIntersectData contact{};
        contact.computeflag = pair.computeflag();
        contact.shearupdate = pair.shearupdate();
        contact.area_ratio = 1.0;
        contact.i = i;
        contact.j = j;
        contact.radi = radius_i;
        contact.radj = atom.radius[j];
        contact.radsum = sum_of_radii;
        contact.rsq = square;
        for (int axis = 0; axis < 3; ++axis) contact.delta[axis] = delta[axis];
        contact.contact_flags = flags ? &flags[place] : nullptr;
        contact.contact_history = histories ? &histories[history_values * place] : nullptr;
        contact.itype = atom.type[i];
        contact.jtype = atom.type[j];
        contact.v_i = atom.v[i];
        contact.v_j = atom.v[j];
        ForceData force_i;
        ForceData force_j;
        if (touching && model.checkSurfaceIntersect(contact)) {
          contact.r = std::sqrt(square);
          contact.rinv = 1.0 / contact.r;
          contact.mi = atom.rmass[i];
          contact.mj = atom.rmass[j];
          contact.meff = contact.mi * contact.mj / (contact.mi + contact.mj);
          if (atom.mask[i] & frozen) contact.meff = contact.mj;
          if (atom.mask[j] & frozen) contact.meff = contact.mi;
          for (int axis = 0; axis < 3; ++axis) contact.en[axis] = delta[axis] * contact.rinv;
          contact.omega_i = atom.omega[i];
          contact.omega_j = atom.omega[j];
          model.surfacesIntersect(contact, force_i, force_j);
          model.endSurfacesIntersect(contact, nullptr, force_i, force_j);
          contact.has_force_update = true;
        } else {
          model.surfacesClose(contact, force_i, force_j);
        }
        if (!contact.has_force_update) continue;
        add(atom.f[i], force_i.delta_F);
        add(atom.torque[i], force_i.delta_torque);
        if (j < atom.nlocal) {
          add(atom.f[j], force_j.delta_F);
          add(atom.torque[j], force_j.delta_torque);
        }
      }
    }
    SurfacesIntersectData pass{};
    ForceData force_i;
    ForceData force_j;
    model.endPass(pass, force_i, force_j);
  }

  static void add(double* sum, const double* part) {
    for (int axis = 0; axis < 3; ++axis) sum[axis] += part[axis];
  }

  LAMMPS_NS::LAMMPS& lammps_;
  Model& model_;  // the stock loop's own, which it keeps private
  LAMMPS_NS::PairGran& pair_;
  const ContactRecorder& recorder_;
  ForcePasses& passes_;  // it lives as long as the engine
  bool asks_for_pass_;
  std::unique_ptr<ForcePass> pass_;
  bool rare_fixes_ = false;
};

}  // namespace polargrain::dem
