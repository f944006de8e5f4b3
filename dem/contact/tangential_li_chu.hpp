// SPDX-License-Identifier: GPL-2.0-or-later
// tangential model `li_chu`: sliding friction and, on request, the rolling friction tangential force of Li,
// Chu and Feng 2005 (docs/theory.md, D.2).
//
//   f_s = -k_s s - c_s ds/dt,  |k_s s| <= mu_s f_n          f_r = -k_r r - c_r dr/dt,  |k_r r| <= mu_r f_n
//   |f_s + f_r| <= mu_s f_n                                 f_n = compressive normal force, 0 when it pulls
//
// s: sliding displacement; r = R* en x (relative rotation): rolling displacement, i the grain with the lower id
// (seen from the other one the law would be another: docs/theory/grains.md, D.3). k_s and c_s come from the
// normal model. A spring beyond its limit is scaled to it and loses its dashpot.
//
// mu_s       `coefficientFriction`                 >= 0
// With the setting `rollingFrictionForce on` (off), which also adds
// mu_r       `coefficientRollingFrictionForce`     >= 0
// k_r / k_s  `rollingFrictionForceStiffnessRatio`  >= 0
// zeta_r     `rollingFrictionForceDampingRatio`    >= 0, c_r = 2 zeta_r sqrt(k_r m_eff); read only with
//            `rollingFrictionForceDamping on` (off)
// `symmetricCoupling on` (off; needs `rolling_friction li_chu`): r is the elastic rolling of the resistance
// moment, which gets the conjugate term -k_r R* u_s and the limit; mu_r is not used. The pair of laws then
// has an elastic energy (D.3).
#ifdef TANGENTIAL_MODEL
TANGENTIAL_MODEL(TANGENTIAL_LI_CHU, li_chu, 20)
#else
#ifndef POLARGRAIN_TANGENTIAL_LI_CHU_HPP
#define POLARGRAIN_TANGENTIAL_LI_CHU_HPP
#include <atom.h>
#include <contact_models.h>
#include <error.h>
#include <neighbor.h>
#include <tangential_model_base.h>
#include <update.h>

#include <algorithm>

#include "dem/contact/model_parameters.hpp"
#include "dem/contact/rolling_kinematics.hpp"

namespace LIGGGHTS {
namespace ContactModels {

template <>
class TangentialModel<TANGENTIAL_LI_CHU> : public TangentialModelBase {
 public:
  TangentialModel(LAMMPS* lmp, IContactHistorySetup* history, class ContactModelBase* model)
      : TangentialModelBase(lmp, history, model), model_(*model) {
    sliding_ = history->add_history_value("sliding_x", "1");
    history->add_history_value("sliding_y", "1");
    history->add_history_value("sliding_z", "1");
    model_.add_history_offset("li_chu_sliding", sliding_);
  }

  void registerSettings(Settings& settings) {
    settings.registerOnOff("rollingFrictionForce", rolling_force_, false);
    settings.registerOnOff("rollingFrictionForceDamping", rolling_force_damped_, false);
    settings.registerOnOff("symmetricCoupling", symmetric_, false);
  }

  inline void postSettings(IContactHistorySetup* history, ContactModelBase*) {
    neighbor->register_contact_dist_factor(polargrain::dem::kClosingFactor);
    if (symmetric_ && !rolling_force_)
      error->all(FLERR, "symmetricCoupling on requires rollingFrictionForce on (tangential li_chu)");
    if (!rolling_force_ || symmetric_) return;
    rolling_ = history->add_history_value("rolling_x", "1");
    history->add_history_value("rolling_y", "1");
    history->add_history_value("rolling_z", "1");
  }

  void connectToProperties(PropertyRegistry& registry) {
    using namespace polargrain::dem;
    const char* const me = "tangential_model li_chu";
    polargrain::dem::connect(registry, "coefficientFriction", &sliding_friction, friction_, me);
    if (!rolling_force_) return;
    polargrain::dem::connect(registry, "rollingFrictionForceStiffnessRatio", &rolling_force_stiffness,
                             stiffness_ratio_, me);
    if (rolling_force_damped_)
      polargrain::dem::connect(registry, "rollingFrictionForceDampingRatio", &rolling_force_damping,
                               damping_ratio_, me);
    if (symmetric_) {
      bending_ = model_.get_history_offset("li_chu_bending");
      if (bending_ < 0) error->all(FLERR, "symmetricCoupling on requires rolling_friction li_chu");
    } else {
      polargrain::dem::connect(registry, "coefficientRollingFrictionForce", &rolling_force_friction,
                               rolling_friction_, me);
    }
  }

  inline void surfacesIntersect(const SurfacesIntersectData& contact, ForceData& force_i,
                                ForceData& force_j) {
    using namespace polargrain::dem;
    if (contact.contact_flags) *contact.contact_flags |= CONTACT_TANGENTIAL_MODEL;
    const bool advance = contact.computeflag && contact.shearupdate;
    const double time_step = update->dt;
    const double ks = contact.kt;
    const double cap = friction_[contact.itype][contact.jtype] * std::max(0.0, contact.Fn);
    const double slip_rate[3] = {contact.vtr1, contact.vtr2, contact.vtr3};

    double* const sliding = &contact.contact_history[sliding_];
    double spring[3] = {sliding[0], sliding[1], sliding[2]};
    if (advance) {
      turn_with_contact(spring, contact.en, twirl(contact, time_step));
      for (int axis = 0; axis < 3; ++axis) spring[axis] += slip_rate[axis] * time_step;
      // The velocity is tangential to the step's start only to round-off and first order.
      const double out_of_plane = dot(spring, contact.en);
      for (int axis = 0; axis < 3; ++axis) spring[axis] -= out_of_plane * contact.en[axis];
    }
    double elastic[3] = {ks * spring[0], ks * spring[1], ks * spring[2]};
    bool slides = limit_length(elastic, cap);
    double viscous[3] = {0.0, 0.0, 0.0};
    double rolling_part[3] = {0.0, 0.0, 0.0};
    if (rolling_force_) {
      add_rolling_force(contact, advance, rolling_part, viscous);
      for (int axis = 0; axis < 3; ++axis) elastic[axis] += rolling_part[axis];
      slides = limit_length(elastic, cap) || slides;
    }
    if (advance)
      for (int axis = 0; axis < 3; ++axis)
        sliding[axis] = slides && ks > 0.0 ? (elastic[axis] - rolling_part[axis]) / ks : spring[axis];

    const bool stands = stands_at(elastic, cap);
    double total[3];
    for (int axis = 0; axis < 3; ++axis)
      total[axis] =
          stands ? -elastic[axis] : -elastic[axis] - viscous[axis] - contact.gammat * slip_rate[axis];
    // A dashpot cannot push past the friction of the surfaces either.
    limit_length(total, cap);
    apply(contact, total, force_i, force_j);
  }

  inline void surfacesClose(SurfacesCloseData& contact, ForceData&, ForceData&) {
    if (contact.contact_flags) *contact.contact_flags &= ~CONTACT_TANGENTIAL_MODEL;
    if (!contact.contact_history) return;
    std::fill_n(&contact.contact_history[sliding_], 3, 0.0);
    if (rolling_ >= 0) std::fill_n(&contact.contact_history[rolling_], 3, 0.0);
  }
  inline void beginPass(SurfacesIntersectData&, ForceData&, ForceData&) {}
  inline void endPass(SurfacesIntersectData&, ForceData&, ForceData&) {}

 private:
  /// Elastic part k_r r and viscous part c_r dr/dt of the rolling friction force, before the common limit.
  void add_rolling_force(const SurfacesIntersectData& contact, bool advance, double (&elastic)[3],
                         double (&viscous)[3]) {
    using namespace polargrain::dem;
    const double time_step = update->dt;
    const double kr = stiffness_ratio_[contact.itype][contact.jtype] * contact.kt;
    const double radius = side(contact, atom->tag) * reduced_radius(contact);
    const Vector spin = relative_spin(contact);
    const Vector rate = cross(contact.en, spin.data());
    bool rolls_freely = false;
    if (symmetric_) {
      // The rolling law has its turn after this one; look ahead to the rotation it will find.
      double* const stored = &contact.contact_history[bending_];
      double bending[3] = {stored[0], stored[1], stored[2]};
      if (advance) advance_bending(bending, contact, spin, time_step);
      const Vector direction = cross(contact.en, bending);
      for (int axis = 0; axis < 3; ++axis) elastic[axis] = kr * radius * direction[axis];
    } else {
      double* const stored = &contact.contact_history[rolling_];
      double spring[3] = {stored[0], stored[1], stored[2]};
      if (advance) {
        turn_with_contact(spring, contact.en, twirl(contact, time_step));
        for (int axis = 0; axis < 3; ++axis) spring[axis] += radius * rate[axis] * time_step;
      }
      for (int axis = 0; axis < 3; ++axis) elastic[axis] = kr * spring[axis];
      const double limit = rolling_friction_[contact.itype][contact.jtype] * std::max(0.0, contact.Fn);
      const bool gives_way = limit_length(elastic, limit);
      rolls_freely = stands_at(elastic, limit);
      if (advance)
        for (int axis = 0; axis < 3; ++axis) stored[axis] = gives_way ? elastic[axis] / kr : spring[axis];
    }
    if (!rolling_force_damped_ || rolls_freely) return;
    const double cr = 2.0 * damping_ratio_[contact.itype][contact.jtype] * std::sqrt(kr * contact.meff);
    for (int axis = 0; axis < 3; ++axis) viscous[axis] = cr * radius * rate[axis];
  }

  static void apply(const SurfacesIntersectData& contact, const double (&total)[3], ForceData& force_i,
                    ForceData& force_j) {
    const polargrain::dem::Vector turning = polargrain::dem::cross(contact.en, total);
    const double share = contact.is_wall ? contact.area_ratio : 1.0;
    for (int axis = 0; axis < 3; ++axis) {
      force_i.delta_F[axis] += share * total[axis];
      force_i.delta_torque[axis] -= share * contact.cri * turning[axis];
      if (contact.is_wall) continue;
      force_j.delta_F[axis] -= total[axis];
      force_j.delta_torque[axis] -= contact.crj * turning[axis];
    }
  }

  ContactModelBase& model_;
  double** friction_ = nullptr;
  double** rolling_friction_ = nullptr;
  double** stiffness_ratio_ = nullptr;
  double** damping_ratio_ = nullptr;
  int sliding_ = -1;  ///< places of the history values
  int rolling_ = -1;
  int bending_ = -1;
  bool rolling_force_ = false;
  bool rolling_force_damped_ = false;
  bool symmetric_ = false;
};

}  // namespace ContactModels
}  // namespace LIGGGHTS
#endif
#endif
