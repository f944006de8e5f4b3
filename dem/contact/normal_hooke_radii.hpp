// SPDX-License-Identifier: GPL-2.0-or-later
// normal model `hooke/radii`: linear spring whose stiffness follows the radii of the pair.
//
//   k_n = E_c 2 r_i r_j / (r_i + r_j),   k_t = a k_n,   F_n = k_n delta - gamma_n v_n
//
// E_c  `contactModulus`             property/global peratomtypepair, Pa, > 0
// a    `tangentialStiffnessRatio`   property/global peratomtypepair, >= 0
// gamma_n = 2 zeta sqrt(k_n m_eff), gamma_t = the same with k_t, where
// zeta `contactDampingRatio`        property/global peratomtypepair, read only with the setting `damping on`
//
// Scaling k_n with the radii makes the bulk stiffness of a packing independent of its grain size (with stress
// per true thickness). Settings: `damping on|off` (off), `limitForce on|off` (off: as in the stock models).
#ifdef NORMAL_MODEL
NORMAL_MODEL(HOOKE_RADII, hooke / radii, 20)
#else
#ifndef POLARGRAIN_NORMAL_HOOKE_RADII_HPP
#define POLARGRAIN_NORMAL_HOOKE_RADII_HPP
#include <contact_models.h>
#include <global_properties.h>
#include <normal_model_base.h>

#include <cmath>

namespace LIGGGHTS {
namespace ContactModels {

template <>
class NormalModel<HOOKE_RADII> : public NormalModelBase {
 public:
  NormalModel(LAMMPS* lmp, IContactHistorySetup* history, class ContactModelBase* model)
      : NormalModelBase(lmp, history, model) {}

  void registerSettings(Settings& settings) {
    settings.registerOnOff("damping", damping_, false);
    settings.registerOnOff("limitForce", limit_force_, false);
  }
  inline void postSettings(IContactHistorySetup*, ContactModelBase*) {}

  void connectToProperties(PropertyRegistry& registry) {
    connect(registry, "contactModulus", &contact_modulus, contact_modulus_);
    connect(registry, "tangentialStiffnessRatio", &stiffness_ratio, stiffness_ratio_);
    if (damping_) connect(registry, "contactDampingRatio", &damping_ratio, damping_ratio_);
    if (force->cg_active()) error->cg(FLERR, "model hooke/radii");
  }

  inline double stressStrainExponent() { return 1.0; }
  void dissipateElasticPotential(SurfacesCloseData&) {}

  inline void surfacesIntersect(SurfacesIntersectData& contact, ForceData& force_i, ForceData& force_j) {
    if (contact.contact_flags) *contact.contact_flags |= CONTACT_NORMAL_MODEL;
    const double radius_i = contact.radi;
    // A wall is a grain of infinite radius: 2 r_i r_j / (r_i + r_j) -> 2 r_i.
    const double length =
        contact.is_wall ? 2.0 * radius_i : 2.0 * radius_i * contact.radj / (radius_i + contact.radj);
    const double kn = contact_modulus_[contact.itype][contact.jtype] * length;
    const double kt = stiffness_ratio_[contact.itype][contact.jtype] * kn;
    double gamman = 0.0;
    double gammat = 0.0;
    if (damping_) {
      const double zeta = damping_ratio_[contact.itype][contact.jtype];
      gamman = 2.0 * zeta * std::sqrt(kn * contact.meff);
      gammat = 2.0 * zeta * std::sqrt(kt * contact.meff);
    }
    double normal_force = kn * contact.deltan - gamman * contact.vn;
    if (limit_force_ && normal_force < 0.0) normal_force = 0.0;

    contact.Fn = normal_force;
    contact.kn = kn;
    contact.kt = kt;
    contact.gamman = gamman;
    contact.gammat = gammat;

    const double share = contact.is_wall ? contact.area_ratio : 1.0;
    for (int axis = 0; axis < 3; ++axis) {
      force_i.delta_F[axis] += share * normal_force * contact.en[axis];
      if (!contact.is_wall) force_j.delta_F[axis] -= normal_force * contact.en[axis];
    }
  }

  inline void surfacesClose(SurfacesCloseData& contact, ForceData&, ForceData&) {
    if (contact.contact_flags) *contact.contact_flags |= CONTACT_NORMAL_MODEL;
  }
  void beginPass(SurfacesIntersectData&, ForceData&, ForceData&) {}
  void endPass(SurfacesIntersectData&, ForceData&, ForceData&) {}

 private:
  static MatrixProperty* contact_modulus(PropertyRegistry& registry, const char* caller, bool) {
    return MODEL_PARAMS::createPerTypePairProperty(registry, "contactModulus", caller, true, 1e-300);
  }
  static MatrixProperty* stiffness_ratio(PropertyRegistry& registry, const char* caller, bool) {
    return MODEL_PARAMS::createPerTypePairProperty(registry, "tangentialStiffnessRatio", caller, true, 0.0);
  }
  static MatrixProperty* damping_ratio(PropertyRegistry& registry, const char* caller, bool) {
    return MODEL_PARAMS::createPerTypePairProperty(registry, "contactDampingRatio", caller, true, 0.0);
  }
  static void connect(PropertyRegistry& registry, const char* name,
                      MatrixProperty* (*create)(PropertyRegistry&, const char*, bool), double**& target) {
    registry.registerProperty(name, create);
    registry.connect(name, target, "model hooke/radii");
  }

  double** contact_modulus_ = nullptr;
  double** stiffness_ratio_ = nullptr;
  double** damping_ratio_ = nullptr;
  bool damping_ = false;
  bool limit_force_ = false;
};

}  // namespace ContactModels
}  // namespace LIGGGHTS
#endif
#endif
