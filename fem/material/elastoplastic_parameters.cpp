// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "fem/material/elastoplastic.hpp"

namespace polargrain::fem {

namespace {

/// A place on the hardening functions: values there, slopes of the piece it is seen from.
struct PlaceInCone {
  double gamma_p;
  Cone<double> cone;
};

/// All places where the bounds below can be least: both ends of every piece, and between them the turning
/// point of M_phi M_psi, the only term that is not straight.
std::vector<PlaceInCone> critical_places(const HardeningCone& cone) {
  const std::vector<double> gammas = merged_knots({&cone.friction, &cone.dilatancy, &cone.cohesion});
  std::vector<PlaceInCone> places;
  for (std::size_t i = 0; i + 1 < gammas.size(); ++i) {
    const Cone<double> start = cone(gammas[i]);
    places.push_back({gammas[i], start});
    const auto add = [&](double gamma_p) {
      PlaceInCone place{gamma_p, cone(gamma_p)};
      place.cone.friction_slope = start.friction_slope;
      place.cone.dilatancy_slope = start.dilatancy_slope;
      place.cone.cohesion_slope = start.cohesion_slope;
      places.push_back(place);
    };
    add(gammas[i + 1]);
    const double bend = 2.0 * start.friction_slope * start.dilatancy_slope;
    const double turning =
        gammas[i] - (start.friction_slope * start.dilatancy + start.friction * start.dilatancy_slope) / bend;
    if (bend > 0.0 && turning > gammas[i] && turning < gammas[i + 1]) {
      add(turning);
    }
  }
  places.push_back({gammas.back(), cone(gammas.back())});
  return places;
}

double generalised_modulus(const Cone<double>& cone, const SubspaceModuli& moduli, double mean) {
  return 3.0 * moduli.shear() + moduli.bulk * cone.friction * cone.dilatancy - cone.friction_slope * mean +
         cone.cohesion_slope;
}

void check_weights(const InvariantWeights& weights, std::vector<std::string>& found) {
  if (!(std::abs(weights.a1 + weights.a2 - 0.5) <= 1e-9)) {
    found.push_back(
        fmt::format("the weights a1 + a2 of the stress invariant are {} + {} = {}; they must add up to 1/2",
                    weights.a1, weights.a2, weights.a1 + weights.a2));
  }
  if (!(weights.a1 >= weights.a2)) {
    found.push_back(
        fmt::format("the weight a1 = {} of the stress invariant must not be below a2 = {}: the yield "
                    "surface would not be convex",
                    weights.a1, weights.a2));
  }
  if (!(weights.a3 >= 0.0) || !std::isfinite(weights.a3)) {
    found.push_back(
        fmt::format("the weight a3 of the stress invariant is {}; it must be zero or positive", weights.a3));
  }
}

void check_strength(const HardeningCone& hardening, std::vector<std::string>& found) {
  for (const PlaceInCone& place : critical_places(hardening)) {
    const Cone<double>& cone = place.cone;
    if (!(cone.friction >= 0.0) || !(cone.cohesion >= 0.0)) {
      found.push_back(
          fmt::format("at gamma_p = {} the cone has M_phi = {} and k = {} Pa; neither may be negative",
                      place.gamma_p, cone.friction, cone.cohesion));
      return;
    }
    if (cone.friction == 0.0 && cone.cohesion == 0.0) {
      found.push_back(
          fmt::format("at gamma_p = {} friction and cohesion are both zero: the material has no "
                      "strength left; keep a small cohesion",
                      place.gamma_p));
      return;
    }
    if (cone.dilatancy > cone.friction * (1.0 + 1e-12)) {
      found.push_back(
          fmt::format("at gamma_p = {} the dilatancy M_psi = {} exceeds the friction M_phi = {}: plastic "
                      "flow would create energy; lower the dilatancy",
                      place.gamma_p, cone.dilatancy, cone.friction));
      return;
    }
  }
}

void check_softening(const HardeningCone& hardening, const SubspaceModuli& moduli, double mean,
                     std::vector<std::string>& found) {
  for (const PlaceInCone& place : critical_places(hardening)) {
    const double modulus = generalised_modulus(place.cone, moduli, mean);
    if (!(modulus > 0.0)) {
      found.push_back(fmt::format(
          "softening is too steep for this elasticity: 3G + K M_phi M_psi - M_phi' p + k' = {:.6g} Pa at "
          "gamma_p = {} and mean stress p = {:.6g} Pa, but it must be above 0; soften over a larger range of gamma_p",
          modulus, place.gamma_p, mean));
      return;
    }
  }
}

template <int dim>
void check_initial_stress(const ElastoplasticParameters<dim>& parameters, const SubspaceModuli& moduli,
                          std::vector<std::string>& found) {
  using Counts = Cosserat<dim>;
  const typename Counts::Vector& initial = parameters.elastic.initial_stress;
  ScaledVector<double, dim> scaled = initial;
  const bool has_couple_stress = initial.template tail<Counts::couples>().cwiseAbs().maxCoeff() > 0.0;
  if (parameters.elastic.internal_length > 0.0) {
    scaled.template tail<Counts::couples>() /= parameters.elastic.internal_length;
  } else if (has_couple_stress) {
    found.push_back("the initial stress has couple stresses, which need lc > 0; found lc = 0");
    return;
  }
  for (int i = 0; i < dim; ++i) {
    for (int j = i + 1; j < dim; ++j) {
      const double one = initial(Counts::stress_place(i, j));
      const double other = initial(Counts::stress_place(j, i));
      if (parameters.elastic.cosserat_shear_modulus != 0.0 || one == other) continue;
      found.push_back(fmt::format(
          "the initial stress has s{0}{1} = {2} and s{1}{0} = {3} Pa, but with Gc = 0 nothing carries "
          "their difference; make them equal or give Gc > 0",
          i + 1, j + 1, one, other));
      return;
    }
  }
  const Split<double, dim> split(scaled);
  const double q = deviatoric_stress(split, moduli);
  const Cone<double> cone = parameters.cone(0.0);
  const double yield = cone.yield_function(q, split.mean);
  if (!(yield <= 1e-9 * (q + std::abs(cone.friction * split.mean) + cone.cohesion))) {
    found.push_back(
        fmt::format("the initial stress lies outside the yield surface: q + M_phi p - k = {:.6g} Pa with "
                    "q = {:.6g}, p = {:.6g} Pa, M_phi = {:.6g}, k = {:.6g} Pa; it must not be above 0",
                    yield, q, split.mean, cone.friction, cone.cohesion));
  }
}

}  // namespace

double softening_reserve(const HardeningCone& cone, const SubspaceModuli& moduli, double mean) {
  double least = std::numeric_limits<double>::infinity();
  for (const PlaceInCone& place : critical_places(cone)) {
    least = std::min(least, generalised_modulus(place.cone, moduli, mean));
  }
  return least;
}

template <int dim>
std::vector<std::string> faults(const ElastoplasticParameters<dim>& parameters) {
  std::vector<std::string> found = faults(parameters.elastic);
  check_weights(parameters.weights, found);
  check_strength(parameters.cone, found);
  if (!(parameters.apex_stiffness_share >= 0.0 && parameters.apex_stiffness_share < 1.0)) {
    found.push_back(fmt::format("the share of elastic stiffness at the apex is {}; it must be in [0, 1)",
                                parameters.apex_stiffness_share));
  }
  if (found.empty()) {  // the checks below divide by what the checks above have found sound
    const SubspaceModuli moduli(parameters.elastic, parameters.weights);
    const double mean = Split<double, dim>(parameters.elastic.initial_stress).mean;
    check_softening(parameters.cone, moduli, mean, found);
    check_initial_stress(parameters, moduli, found);
  }
  return found;
}

template std::vector<std::string> faults<2>(const ElastoplasticParameters<2>& parameters);
template std::vector<std::string> faults<3>(const ElastoplasticParameters<3>& parameters);

}  // namespace polargrain::fem
