// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <optional>
#include <string>

#include "app/remarks/scene.hpp"

namespace polargrain::app {

/// The stress that `initial_stress` of the case gives a place of a region, if it gives one. Where boxes measure K0,
/// across with an estimate of it.
template <int dim>
std::optional<typename Cosserat<dim>::Vector> given_stress(const Scene& scene, const std::string& region,
                                                           const typename Cosserat<dim>::Place& place);

/// Whether it gives the region a stress.
bool has_given_stress(const Scene& scene, const std::string& region);

}  // namespace polargrain::app
