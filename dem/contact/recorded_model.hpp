// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <array>
#include <cmath>
#include <utility>

#include "dem/contact/cell_loading.hpp"
#include "dem/contact/contact_recorder.hpp"
#include "dem/contact/rolling_kinematics.hpp"
#include "dem/contact/spoken_settings.hpp"
#include "dem/engine/liggghts.hpp"

namespace polargrain::dem {

/// Any combination of contact models of the engine between grains of a cell. It adds the
/// curvature of the cell to the spins of the grains that the models see. While the recorder is on, it writes down every
/// contact after all models have added their forces. Without either it costs two predictable branches a contact.
template <typename Model>
class RecordedModel : public Model {
 public:
  RecordedModel(LAMMPS_NS::LAMMPS* lammps, LIGGGHTS::IContactHistorySetup* history, bool is_wall,
                int64_t hash)
      : Model(lammps, history, is_wall, hash),
        lammps_(*lammps),
        loading_(cell_loading(*lammps)),
        recorder_(contact_recorder(*lammps)),
        hash_(hash) {
    part_of<LastMade>(*lammps).model = this;
  }
  RecordedModel(const RecordedModel&) = delete;
  RecordedModel& operator=(const RecordedModel&) = delete;

  /// The model that an engine made last: how PairLoop finds the one inside the stock loop it extends.
  struct LastMade {
    RecordedModel* model = nullptr;
  };

  void registerSettings(Settings& settings) {
    Model::registerSettings(settings);
    spoken_.listen(settings, hash_);
  }
  [[nodiscard]] const SpokenSettings& spoken_settings() const { return spoken_; }

  void connectToProperties(PropertyRegistry& registry) {
    Model::connectToProperties(registry);
    // Asked for by name, not required: a script may have no sliding friction.
    friction_ = lammps_.modify->find_fix_property("coefficientFriction", "property/global", "peratomtypepair",
                                                  0, 0, "polargrain", false);
  }

  inline void surfacesIntersect(LIGGGHTS::ContactModels::SurfacesIntersectData& data,
                                LIGGGHTS::ContactModels::ForceData& force_i,
                                LIGGGHTS::ContactModels::ForceData& force_j) {
    double* const spin_i = data.omega_i;
    double* const spin_j = data.omega_j;
    double seen_i[3];
    double seen_j[3];
    if (loading_.bends()) {
      // From the middle of the branch the micro-rotation changes by half of curvature . branch to either centre.
      for (int axis = 0; axis < 3; ++axis) {
        const double half = 0.5 * loading_.spin_along(data.delta, axis);
        seen_i[axis] = spin_i[axis] + half;
        seen_j[axis] = spin_j[axis] - half;
      }
      data.omega_i = seen_i;
      data.omega_j = seen_j;
    }
    Model::surfacesIntersect(data, force_i, force_j);
    data.omega_i = spin_i;
    data.omega_j = spin_j;
  }

  inline void endSurfacesIntersect(LIGGGHTS::ContactModels::SurfacesIntersectData& data,
                                   LAMMPS_NS::TriMesh* mesh, LIGGGHTS::ContactModels::ForceData& force_i,
                                   LIGGGHTS::ContactModels::ForceData& force_j) {
    Model::endSurfacesIntersect(data, mesh, force_i, force_j);
    if (recorder_.on)
      record(data.i, data.j, {data.delta[0], data.delta[1], data.delta[2]},
             {force_i.delta_F[0], force_i.delta_F[1], force_i.delta_F[2]}, data.kn, data.kt, data.cri,
             data.crj, {force_i.delta_torque[0], force_i.delta_torque[1], force_i.delta_torque[2]},
             data.gamman, data.gammat);
  }

 private:
  // Values, not references to the contact: a contact whose address escapes cannot be kept in registers.
  __attribute__((noinline)) void record(int i, int j, std::array<double, 3> delta,
                                        std::array<double, 3> force, double normal_stiffness,
                                        double tangential_stiffness, double arm_i, double arm_j,
                                        std::array<double, 3> torque, double normal_viscosity,
                                        double tangential_viscosity) {
    const ContactRecorder::Rolling rolling = std::exchange(recorder_.rolling, {});
    LAMMPS_NS::Atom& atom = *lammps_.atom;
    if (j >= atom.nlocal && !lammps_.force->newton_pair) {
      // Both grains of a contact across a periodic face see it; keep the one seen from the lower tag. A grain
      // that touches its own image keeps one of the two directions.
      const int tag_i = atom.tag[i];
      const int tag_j = atom.tag[j];
      if (tag_i > tag_j) return;
      if (tag_i == tag_j && !points_up(delta.data())) return;
    }
    Contact contact;
    contact.first = i;
    contact.second = j < atom.nlocal ? j : atom.map(atom.tag[j]);
    contact.branch = {-delta[0], -delta[1], -delta[2]};
    contact.force = {force[0], force[1], force[2]};
    contact.normal_stiffness = normal_stiffness;
    contact.tangential_stiffness = tangential_stiffness;
    contact.normal_viscosity = normal_viscosity;
    contact.tangential_viscosity = tangential_viscosity;
    contact.arm_first = arm_i;
    contact.arm_second = arm_j;
    contact.friction = friction_ ? friction_->compute_array(atom.type[i] - 1, atom.type[j] - 1) : 0.0;
    // The force turns the grain by its arm towards the contact; the rest of the torque is the rolling law's.
    const double towards = arm_i / std::hypot(delta[0], delta[1], delta[2]);
    contact.moment = {torque[0] + towards * (delta[1] * force[2] - delta[2] * force[1]),
                      torque[1] + towards * (delta[2] * force[0] - delta[0] * force[2]),
                      torque[2] + towards * (delta[0] * force[1] - delta[1] * force[0])};
    contact.rolling_stiffness = rolling.stiffness;
    contact.rolling_at_limit = rolling.at_limit;
    contact.rolling_limit = rolling.limit;
    contact.torsion_stiffness = rolling.torsion_stiffness;
    contact.torsion_at_limit = rolling.torsion_at_limit;
    recorder_.contacts.push_back(contact);
  }

  LAMMPS_NS::LAMMPS& lammps_;
  const CellLoading& loading_;
  ContactRecorder& recorder_;
  int64_t hash_;
  SpokenSettings spoken_;
  LAMMPS_NS::Fix* friction_ = nullptr;
};

}  // namespace polargrain::dem
