// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <functional>
#include <map>
#include <string>

#include "coupler/case/case.hpp"
#include "coupler/cells/network_moduli.hpp"

namespace polargrain::app {

/// The engine's findings on a packing under its script, at rest: the state in which its cells begin.
struct PackingAtRest {
  Vector7 stress = Vector7::Zero();  ///< Pa, tension positive
  coupler::NetworkModuli moduli;
  double mean_overlap = 0.0;  ///< over the smaller radius, mean over the contacts

  /// -(s11 + s22) / 2, Pa
  [[nodiscard]] double pressure() const { return -0.5 * (stress(k11) + stress(k22)); }
  /// The shear strain at which elastic grains would have a deviator as large as their pressure; 0 where nothing resists.
  [[nodiscard]] double elastic_strain() const {
    return moduli.shear > 0.0 ? pressure() / (2.0 * moduli.shear) : 0.0;
  }
};

/// The forces of a stress of the engine, in the plane or in space.
template <int dim>
typename Cosserat<dim>::Vector stress_in(const Vector7& of_engine) {
  typename Cosserat<dim>::Vector stress = Cosserat<dim>::Vector::Zero();
  for (int i = 0; i < 3; ++i) stress(Cosserat<dim>::stress_place(i, i)) = of_engine(i);
  stress(Cosserat<dim>::stress_place(0, 1)) = of_engine(k12);
  stress(Cosserat<dim>::stress_place(1, 0)) = of_engine(k21);
  return stress;
}

/// By name of the material; those without cells are not there.
using PackingsAtRest = std::map<std::string, PackingAtRest>;

/// The fate of a worker's log when it cannot answer.
enum class LogsOfFailure {
  kept,  ///< the message names it
  lost   ///< nobody will read the message
};

/// Asks one worker, started for this, for the packings of a case. @param trust_scripts as the command was told
/// @param heed called while it waits; may throw
/// @throws RunError in the engine's words where a packing and its script do not fit
PackingsAtRest packings_at_rest(const coupler::Case& the_case, bool trust_scripts,
                                LogsOfFailure logs = LogsOfFailure::kept,
                                const std::function<void()>& heed = {});

/// The same of one packing.
PackingAtRest packing_at_rest(const CellDefinition& cell, bool trust_scripts);

}  // namespace polargrain::app
