// SPDX-License-Identifier: GPL-2.0-or-later
// normal model `hooke/stiffening`: a spring that stiffens as the grains are pressed together.
//
//   F_n = k L overlap (1 + s overlap / L),   dF_n/d(overlap) = k L (1 + 2 s overlap / L),   k_t = a k L
//
// L = 2 r_i r_j / (r_i + r_j), of a wall 2 r_i
// k  `contactModulus`             property/global peratomtypepair, Pa, > 0
// a  `tangentialStiffnessRatio`   property/global peratomtypepair, >= 0
// s  `stiffening`                 property/global peratomtypepair, >= 0; 0: the model `hooke/radii` without damping
#ifdef NORMAL_MODEL
NORMAL_MODEL(HOOKE_STIFFENING, hooke/stiffening, 40)
#else
#ifndef NORMAL_HOOKE_STIFFENING_HPP
#define NORMAL_HOOKE_STIFFENING_HPP
#include <contact_models.h>
#include <global_properties.h>
#include <normal_model_base.h>

namespace LIGGGHTS {
namespace ContactModels {

template <>
class NormalModel<HOOKE_STIFFENING> : public NormalModelBase {
 public:
  NormalModel(LAMMPS* lammps, IContactHistorySetup* history, class ContactModelBase* model)
      : NormalModelBase(lammps, history, model) {}

  void registerSettings(Settings&) {}
  void postSettings(IContactHistorySetup*, ContactModelBase*) {}

  void connectToProperties(PropertyRegistry& registry) {
    registry.registerProperty("contactModulus", &modulus);
    registry.registerProperty("tangentialStiffnessRatio", &ratio);
    registry.registerProperty("stiffening", &stiffening);
    registry.connect("contactModulus", modulus_, "model hooke/stiffening");
    registry.connect("tangentialStiffnessRatio", ratio_, "model hooke/stiffening");
    registry.connect("stiffening", stiffening_, "model hooke/stiffening");
  }

  double stressStrainExponent() { return 1.0; }
  void dissipateElasticPotential(SurfacesCloseData&) {}

  void surfacesIntersect(SurfacesIntersectData& contact, ForceData& force_i, ForceData& force_j) {
    if (contact.contact_flags) *contact.contact_flags |= CONTACT_NORMAL_MODEL;
    const double length =
        contact.is_wall ? 2.0 * contact.radi : 2.0 * contact.radi * contact.radj / (contact.radi + contact.radj);
    const double linear = modulus_[contact.itype][contact.jtype] * length;
    const double more = stiffening_[contact.itype][contact.jtype] * contact.deltan / length;
    const double normal_force = linear * contact.deltan * (1.0 + more);

    // The law's statement of itself: cells take their tangent and their time step from it, tangential and rolling
    // models their limits and stiffness.
    contact.Fn = normal_force;
    contact.kn = linear * (1.0 + 2.0 * more);
    contact.kt = ratio_[contact.itype][contact.jtype] * linear;
    contact.gamman = 0.0;
    contact.gammat = 0.0;

    const double share = contact.is_wall ? contact.area_ratio : 1.0;
    for (int axis = 0; axis < 3; ++axis) {
      force_i.delta_F[axis] += share * normal_force * contact.en[axis];
      if (!contact.is_wall) force_j.delta_F[axis] -= normal_force * contact.en[axis];
    }
  }

  void surfacesClose(SurfacesCloseData& contact, ForceData&, ForceData&) {
    if (contact.contact_flags) *contact.contact_flags |= CONTACT_NORMAL_MODEL;
  }
  void beginPass(SurfacesIntersectData&, ForceData&, ForceData&) {}
  void endPass(SurfacesIntersectData&, ForceData&, ForceData&) {}

 private:
  static MatrixProperty* modulus(PropertyRegistry& registry, const char* caller, bool) {
    return MODEL_PARAMS::createPerTypePairProperty(registry, "contactModulus", caller, true, 1e-300);
  }
  static MatrixProperty* ratio(PropertyRegistry& registry, const char* caller, bool) {
    return MODEL_PARAMS::createPerTypePairProperty(registry, "tangentialStiffnessRatio", caller, true, 0.0);
  }
  static MatrixProperty* stiffening(PropertyRegistry& registry, const char* caller, bool) {
    return MODEL_PARAMS::createPerTypePairProperty(registry, "stiffening", caller, true, 0.0);
  }

  double** modulus_ = nullptr;
  double** ratio_ = nullptr;
  double** stiffening_ = nullptr;
};

}  // namespace ContactModels
}  // namespace LIGGGHTS
#endif
#endif
