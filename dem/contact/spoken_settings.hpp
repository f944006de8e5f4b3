// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cstdint>

#include "dem/engine/liggghts.hpp"

namespace polargrain::dem {

/// The on/off settings that a script gave the models of its combination. The engine tells them to the models
/// only, which keep them private; a setting may have several listeners, and this is one more.
struct SpokenSettings {
  bool damping = false;               ///< hooke/radii
  bool tangential_damping = true;     ///< hooke/stiffness, hertz
  bool absolute_damping = false;      ///< hooke/stiffness
  bool limit_force = false;           ///< all normal models of the loop over discs
  bool rolling_force = false;         ///< tangential li_chu
  bool rolling_force_damped = false;  ///< tangential li_chu
  bool symmetric = false;             ///< both li_chu
  bool rolling_damped = false;        ///< rolling li_chu
  bool mean_radius = false;           ///< rolling li_chu
  bool torsion = false;               ///< rolling epsd2, li_chu
  /// Any of the settings that keep books (heat, energies) or switch forces off; some of them, a listener each.
  bool books[6] = {};

  [[nodiscard]] bool keeps_books() const {
    for (const bool on : books)
      if (on) return true;
    return false;
  }

  /// Listens to the settings that the models of the combination have. To be called after the models have
  /// registered theirs: nothing may be accepted on behalf of a model that does not know it.
  void listen(Settings& settings, std::int64_t combination) {
    using namespace LIGGGHTS::ContactModels;  // NOLINT: names of the models
    const auto model = [combination](int place) {
      return static_cast<int>((combination >> (6 * place)) & 63);
    };
    const int normal = model(0);
    if (normal == HOOKE_RADII) settings.registerOnOff("damping", damping, false);
    if (normal == HOOKE_STIFFNESS || normal == HERTZ) {
      settings.registerOnOff("tangential_damping", tangential_damping, true);
      settings.registerOnOff("computeElasticPotential", books[0], false);
      settings.registerOnOff("computeDissipatedEnergy", books[1], false);
    }
    if (normal == HOOKE_STIFFNESS) settings.registerOnOff("absolute_damping", absolute_damping);
    if (normal == HERTZ) {
      settings.registerOnOff("heating_normal_hertz", books[2], false);
      settings.registerOnOff("heating_tracking", books[3], false);
      settings.registerOnOff("disableNormalWhenBonded", books[4], false);
    }
    if (normal == HOOKE_RADII || normal == HOOKE_STIFFNESS || normal == HERTZ)
      settings.registerOnOff("limitForce", limit_force);
    if (model(1) == TANGENTIAL_HISTORY) settings.registerOnOff("heating_tangential_history", books[5], false);
    if (model(1) == TANGENTIAL_LI_CHU) {
      settings.registerOnOff("rollingFrictionForce", rolling_force, false);
      settings.registerOnOff("rollingFrictionForceDamping", rolling_force_damped, false);
      settings.registerOnOff("symmetricCoupling", symmetric, false);
    }
    if (model(3) == ROLLING_EPSD2 || model(3) == ROLLING_LI_CHU)
      settings.registerOnOff("torsionTorque", torsion, false);
    if (model(3) == ROLLING_LI_CHU) {
      settings.registerOnOff("rollingDamping", rolling_damped, false);
      settings.registerOnOff("meanRadius", mean_radius, false);
      settings.registerOnOff("symmetricCoupling", symmetric, false);
    }
  }
};

/// The source of the settings of a combination: the loop over its pairs.
class SettingsSource {
 public:
  virtual ~SettingsSource() = default;
  [[nodiscard]] virtual const SpokenSettings& spoken_settings() const = 0;
};

}  // namespace polargrain::dem
