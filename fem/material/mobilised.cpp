// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/material/mobilised.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/elementary_functions.hpp"
#include "fem/material/cone_matching.hpp"

namespace polargrain::fem {

namespace {

constexpr double kRadian = 180.0 / std::numbers::pi;

/// Radius of Mohr's circle of the symmetric in-plane part.
double in_plane_radius(const ScaledVector<double>& tensor) {
  return std::hypot(0.5 * (tensor(0) - tensor(1)), 0.5 * (tensor(3) + tensor(4)));
}

}  // namespace

template <int dim>
ScaledVector<double, dim> plastic_strain(const SubspaceModuli& moduli,
                                         const ScaledVector<double, dim>& strain_increment,
                                         const ScaledVector<double, dim>& stress_increment) {
  const Split<double, dim> strain(strain_increment);
  const Split<double, dim> stress(stress_increment);
  ScaledVector<double, dim> plastic =
      (strain.mean - stress.mean / (3.0 * moduli.bulk)) * volumetric_vector<double, dim>();
  for (std::size_t k = 0; k < 3; ++k) {
    if (moduli.stiffness[k] > 0.0) {
      plastic += strain.part[k] - stress.part[k] / moduli.stiffness[k];
    }
  }
  return plastic;
}

template <int dim>
std::optional<double> cone_friction(const SubspaceModuli& moduli, const ScaledVector<double, dim>& stress,
                                    double cohesion) {
  const Split<double, dim> split(stress);
  const double friction = (deviatoric_stress(split, moduli) - cohesion) / -split.mean;
  if (!(split.mean < 0.0) || !(friction >= 0.0)) return std::nullopt;
  return friction;
}

template <int dim>
double shear_strain(const SubspaceModuli& moduli, const ScaledVector<double, dim>& strain) {
  const Split<double, dim> split(strain);
  double squared = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    if (moduli.weight[k] > 0.0) squared += split.part[k].squaredNorm() / moduli.weight[k];
  }
  return std::sqrt(2.0 / 3.0 * squared);
}

template <int dim>
std::optional<double> cone_dilatancy(const SubspaceModuli& moduli, const ScaledVector<double, dim>& plastic) {
  const double shear = shear_strain<dim>(moduli, plastic);
  if (!(shear > 0.0)) return std::nullopt;
  return 3.0 * Split<double, dim>(plastic).mean / shear;
}

template <int dim>
std::optional<Mobilised> mobilised(const SubspaceModuli& moduli, const ScaledVector<double, dim>& stress,
                                   const ScaledVector<double, dim>& plastic, double cohesion,
                                   const DilatancyLimits& limits) {
  const auto friction = cone_friction<dim>(moduli, stress, cohesion);
  const auto dilatancy = cone_dilatancy<dim>(moduli, plastic);
  if (!friction || !dilatancy) return std::nullopt;
  return within(*friction, *dilatancy, limits);
}

std::optional<Mobilised> mobilised_in_plane(const ScaledVector<double>& stress,
                                            const ScaledVector<double>& plastic,
                                            const DilatancyLimits& limits) {
  const double sin_friction = in_plane_radius(stress) / (-0.5 * (stress(0) + stress(1)));
  const double shear = 2.0 * in_plane_radius(plastic);
  const double sin_dilatancy = (plastic(0) + plastic(1)) / shear;
  if (!(sin_friction >= 0.0 && sin_friction < 1.0) || !(shear > 0.0)) {
    return std::nullopt;
  }
  constexpr double kSteepest = 0.99;  // sines of one or more are noise; the limits flag them
  const double bounded = std::clamp(sin_dilatancy, -kSteepest, kSteepest);
  const FrozenCone cone =
      cone_from_plane_strain({arc_sine(sin_friction) * kRadian, arc_sine(bounded) * kRadian, 0.0});
  const Mobilised read = within(cone.friction, cone.dilatancy, limits);
  return Mobilised{read.friction, read.dilatancy, read.clipped || bounded != sin_dilatancy};
}

Mobilised within(double friction, double dilatancy, const DilatancyLimits& limits) {
  const double most = std::min(limits.most, std::max(friction, limits.least));
  const double kept = std::clamp(dilatancy, limits.least, most);
  return {friction, kept, kept != dilatancy};
}

template ScaledVector<double, 2> plastic_strain<2>(const SubspaceModuli&, const ScaledVector<double, 2>&,
                                                   const ScaledVector<double, 2>&);
template std::optional<double> cone_friction<2>(const SubspaceModuli&, const ScaledVector<double, 2>&,
                                                double);
template double shear_strain<2>(const SubspaceModuli&, const ScaledVector<double, 2>&);
template std::optional<double> cone_dilatancy<2>(const SubspaceModuli&, const ScaledVector<double, 2>&);
template std::optional<Mobilised> mobilised<2>(const SubspaceModuli&, const ScaledVector<double, 2>&,
                                               const ScaledVector<double, 2>&, double,
                                               const DilatancyLimits&);
template ScaledVector<double, 3> plastic_strain<3>(const SubspaceModuli&, const ScaledVector<double, 3>&,
                                                   const ScaledVector<double, 3>&);
template std::optional<double> cone_friction<3>(const SubspaceModuli&, const ScaledVector<double, 3>&,
                                                double);
template double shear_strain<3>(const SubspaceModuli&, const ScaledVector<double, 3>&);
template std::optional<double> cone_dilatancy<3>(const SubspaceModuli&, const ScaledVector<double, 3>&);
template std::optional<Mobilised> mobilised<3>(const SubspaceModuli&, const ScaledVector<double, 3>&,
                                               const ScaledVector<double, 3>&, double,
                                               const DilatancyLimits&);

}  // namespace polargrain::fem
