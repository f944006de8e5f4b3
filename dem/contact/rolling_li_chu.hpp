// SPDX-License-Identifier: GPL-2.0-or-later
// rolling model `li_chu`: rolling resistance moment with its own stiffness, damping and limit (Li, Chu and
// Feng 2005; docs/theory.md, D.2).
//
//   M = -k_th theta_r - c_th d(theta_r)/dt,   |k_th theta_r| <= mu_th r_c f_n
//
// theta_r: relative rotation, its bending part (the torsion about the normal only with `torsionTorque on`, a
// separate spring with the same stiffness and limit). f_n: compressive normal force, 0 when it pulls. r_c =
// R* = r_i r_j / (r_i + r_j) (a wall: r_i), with `meanRadius on` (r_i + r_j) / 2 (a wall: r_i). A spring
// beyond its limit is scaled to it and loses its dashpot.
//
// mu_th                 `coefficientRollingFriction`  >= 0
// k_th / (k_s r_c^2)    `rollingStiffnessRatio`       >= 0; k_s from the normal model
// zeta_th               `rollingDampingRatio`         >= 0, c_th = 2 zeta_th sqrt(k_th I_eff), I_eff the
// reduced moment
//                       of inertia; read only with the setting `rollingDamping on` (off)
// `symmetricCoupling on`: see tangential model li_chu; the moment gets the term -k_r R* u_s (D.3) and the
// limit holds for the sum.
//
// In a cell the curvature enters through the spins that a contact sees (recorded_model.hpp).
#ifdef ROLLING_MODEL
ROLLING_MODEL(ROLLING_LI_CHU, li_chu, 20)
#else
#ifndef POLARGRAIN_ROLLING_LI_CHU_HPP
#define POLARGRAIN_ROLLING_LI_CHU_HPP
#include <atom.h>
#include <contact_models.h>
#include <domain.h>
#include <error.h>
#include <neighbor.h>
#include <rolling_model_base.h>
#include <update.h>

#include <algorithm>

#include "dem/contact/contact_recorder.hpp"
#include "dem/contact/model_parameters.hpp"
#include "dem/contact/rolling_kinematics.hpp"

namespace LIGGGHTS {
namespace ContactModels {

template <>
class RollingModel<ROLLING_LI_CHU> : public RollingModelBase {
 public:
  RollingModel(LAMMPS* lmp, IContactHistorySetup* history, class ContactModelBase* model)
      : RollingModelBase(lmp, history, model),
        model_(*model),
        recorder_(polargrain::dem::contact_recorder(*lmp)) {
    bending_ = history->add_history_value("bending_x", "1");
    history->add_history_value("bending_y", "1");
    history->add_history_value("bending_z", "1");
    model_.add_history_offset("li_chu_bending", bending_);
  }

  void registerSettings(Settings& settings) {
    settings.registerOnOff("torsionTorque", torsion_on_, false);
    settings.registerOnOff("rollingDamping", damped_, false);
    settings.registerOnOff("meanRadius", mean_radius_, false);
    settings.registerOnOff("symmetricCoupling", symmetric_, false);
  }

  inline void postSettings(IContactHistorySetup* history, ContactModelBase*) {
    neighbor->register_contact_dist_factor(polargrain::dem::kClosingFactor);
    // Seen from either grain a torsion has the same sign: it turns about a normal that changes sign too.
    if (torsion_on_) torsion_ = history->add_history_value("torsion", "0");
  }

  void connectToProperties(PropertyRegistry& registry) {
    using namespace polargrain::dem;
    const char* const me = "rolling_model li_chu";
    polargrain::dem::connect(registry, "coefficientRollingFriction", &rolling_friction, friction_, me);
    polargrain::dem::connect(registry, "rollingStiffnessRatio", &rolling_stiffness, stiffness_ratio_, me);
    if (damped_)
      polargrain::dem::connect(registry, "rollingDampingRatio", &rolling_damping, damping_ratio_, me);
    if (force->cg_active()) error->cg(FLERR, me);
    if (!symmetric_) return;
    sliding_ = model_.get_history_offset("li_chu_sliding");
    if (sliding_ < 0) error->all(FLERR, "symmetricCoupling on requires tangential li_chu");
    polargrain::dem::connect(registry, "rollingFrictionForceStiffnessRatio", &rolling_force_stiffness,
                             force_stiffness_ratio_, me);
    for (int a = 1; a <= atom->ntypes; ++a)
      for (int b = 1; b <= atom->ntypes; ++b)
        if (force_stiffness_ratio_[a][b] * force_stiffness_ratio_[a][b] >= stiffness_ratio_[a][b])
          error->all(FLERR,
                     "symmetricCoupling on requires rollingFrictionForceStiffnessRatio squared to be less "
                     "than rollingStiffnessRatio: the elastic energy would not be positive");
  }

  void surfacesIntersect(SurfacesIntersectData& contact, ForceData& force_i, ForceData& force_j) {
    using namespace polargrain::dem;
    if (contact.contact_flags) *contact.contact_flags |= CONTACT_ROLLING_MODEL;
    const bool advance = contact.computeflag && contact.shearupdate;
    const double radius = characteristic_radius(contact);
    const double stiffness = stiffness_ratio_[contact.itype][contact.jtype] * contact.kt * radius * radius;
    const double limit = friction_[contact.itype][contact.jtype] * radius * std::max(0.0, contact.Fn);
    const double damping = damped_ ? damping_constant(contact, stiffness) : 0.0;
    const Vector spin = relative_spin(contact);

    double* const stored = &contact.contact_history[bending_];
    double bending[3] = {stored[0], stored[1], stored[2]};
    if (advance) advance_bending(bending, contact, spin, update->dt);
    const Vector coupling = coupling_moment(contact);
    double moment[3];
    for (int axis = 0; axis < 3; ++axis) moment[axis] = stiffness * bending[axis] - coupling[axis];
    const bool at_limit = limit_length(moment, limit);
    if (advance)
      for (int axis = 0; axis < 3; ++axis)
        stored[axis] = at_limit ? (moment[axis] + coupling[axis]) / stiffness : bending[axis];

    const double torsion_rate = dot(spin.data(), contact.en);
    if (!stands_at(moment, limit))
      for (int axis = 0; axis < 3; ++axis)
        moment[axis] += damping * (spin[axis] - torsion_rate * contact.en[axis]);
    const bool torsion_at_limit =
        torsion_on_ && add_torsion(contact, advance, stiffness, damping, limit, torsion_rate, moment);

    if (recorder_.on)
      recorder_.rolling = {stiffness, at_limit, limit, torsion_on_ ? stiffness : 0.0, torsion_at_limit};
    const double share = contact.is_wall ? contact.area_ratio : 1.0;
    for (int axis = 0; axis < 3; ++axis) {
      force_i.delta_torque[axis] -= share * moment[axis];
      if (!contact.is_wall) force_j.delta_torque[axis] += moment[axis];
    }
  }

  void surfacesClose(SurfacesCloseData& contact, ForceData&, ForceData&) {
    if (contact.contact_flags) *contact.contact_flags &= ~CONTACT_ROLLING_MODEL;
    if (!contact.contact_history) return;
    std::fill_n(&contact.contact_history[bending_], 3, 0.0);
    if (torsion_ >= 0) contact.contact_history[torsion_] = 0.0;
  }
  void beginPass(SurfacesIntersectData&, ForceData&, ForceData&) {}
  void endPass(SurfacesIntersectData&, ForceData&, ForceData&) {}

 private:
  [[nodiscard]] double characteristic_radius(const SurfacesIntersectData& contact) const {
    if (mean_radius_ && !contact.is_wall) return 0.5 * (contact.radi + contact.radj);
    return polargrain::dem::reduced_radius(contact);
  }

  /// c_th = 2 zeta sqrt(k_th I_eff). The engine integrates discs in dimension 2, spheres otherwise.
  [[nodiscard]] double damping_constant(const SurfacesIntersectData& contact, double stiffness) const {
    const double shape = domain->dimension == 2 ? 0.5 : 0.4;
    const double inertia_i = shape * contact.mi * contact.radi * contact.radi;
    double inertia = inertia_i;
    if (!contact.is_wall) {
      const double inertia_j = shape * contact.mj * contact.radj * contact.radj;
      inertia = inertia_i * inertia_j / (inertia_i + inertia_j);
    }
    return 2.0 * damping_ratio_[contact.itype][contact.jtype] * std::sqrt(stiffness * inertia);
  }

  /// k_r R* en x s: the moment on i that is conjugate to the rolling friction force (D.3).
  polargrain::dem::Vector coupling_moment(const SurfacesIntersectData& contact) const {
    if (!symmetric_) return {0.0, 0.0, 0.0};
    const double factor = polargrain::dem::side(contact, atom->tag) *
                          force_stiffness_ratio_[contact.itype][contact.jtype] * contact.kt *
                          polargrain::dem::reduced_radius(contact);
    const polargrain::dem::Vector turning =
        polargrain::dem::cross(contact.en, &contact.contact_history[sliding_]);
    return {factor * turning[0], factor * turning[1], factor * turning[2]};
  }

  /// @returns whether the torsion stands at its limit
  bool add_torsion(const SurfacesIntersectData& contact, bool advance, double stiffness, double damping,
                   double limit, double rate, double (&moment)[3]) {
    double& stored = contact.contact_history[torsion_];
    const double angle = advance ? stored + rate * update->dt : stored;
    double torque = stiffness * angle;
    const bool at_limit = std::abs(torque) > limit;
    if (at_limit) torque = std::copysign(limit, torque);
    if (advance) stored = at_limit ? torque / stiffness : angle;
    if (!polargrain::dem::stands_at(torque, limit)) torque += damping * rate;
    for (int axis = 0; axis < 3; ++axis) moment[axis] += torque * contact.en[axis];
    return at_limit;
  }

  ContactModelBase& model_;
  polargrain::dem::ContactRecorder& recorder_;
  double** friction_ = nullptr;
  double** stiffness_ratio_ = nullptr;
  double** damping_ratio_ = nullptr;
  double** force_stiffness_ratio_ = nullptr;
  int bending_ = -1;  ///< places of the history values
  int torsion_ = -1;
  int sliding_ = -1;
  bool torsion_on_ = false;
  bool damped_ = false;
  bool mean_radius_ = false;
  bool symmetric_ = false;
};

}  // namespace ContactModels
}  // namespace LIGGGHTS
#endif
#endif
