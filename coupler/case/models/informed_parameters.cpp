// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/case/models/informed_parameters.hpp"

#include <cmath>
#include <numbers>

#include "coupler/case/models/cone_match.hpp"

namespace polargrain::coupler {

template <int dim>
InformedParameters<dim> read_informed_parameters(Section& section) {
  InformedParameters<dim> parameters;
  const double poisson = section.quantity_or("nu", Dimension::number, Limit::any, 0.2);
  if (!(poisson > -1.0 && poisson < 0.5)) section.fault("nu", "nu: must be above -1 and below 0.5");
  parameters.elastic.poisson_ratio = poisson;
  parameters.update = section.choice_or("update", {"frozen", "fixed_point"}, "frozen") == "fixed_point"
                          ? InformedUpdate::fixed_point
                          : InformedUpdate::frozen;
  parameters.mismatch_limit =
      section.quantity_or("mismatch_limit", Dimension::number, Limit::positive, parameters.mismatch_limit);
  const std::string beyond = section.choice_or("beyond_mismatch", {"tell", "stop", "cell"}, "tell");
  parameters.beyond_mismatch = beyond == "stop"   ? BeyondMismatch::stop
                               : beyond == "cell" ? BeyondMismatch::cell
                                                  : BeyondMismatch::tell;
  fem::MobilisationOptions& reading = parameters.mobilisation;
  reading.window = section.whole_or("window", 1, reading.window);
  if (section.find("dilatancy_limits") != nullptr) {
    const std::vector<double> ends = section.quantities("dilatancy_limits", 2, Dimension::number, Limit::any);
    reading.limits = {ends[0], ends[1]};
    constexpr double kGreatest = 1.5;  // of M_psi, where sin(psi) of B.3 reaches one
    if (!(ends[0] < ends[1]) || ends[0] < -kGreatest || ends[1] > kGreatest) {
      section.fault("dilatancy_limits",
                    "dilatancy_limits: expected the least and the most M_psi, rising, between -1.5 and 1.5");
      reading.limits = {};
    }
  }
  const double angle = section.quantity_or("initial_friction", Dimension::angle, Limit::not_negative,
                                           5.0 * std::numbers::pi / 180.0);
  if (angle >= 0.5 * std::numbers::pi) {
    section.fault("initial_friction", "initial_friction: must be an angle below 90 degrees");
  }
  reading.initial_friction = angle;
  if constexpr (dim == 3) reading.match = read_match(section, dim);
  reading.drift_shear =
      section.quantity_or("drift_shear", Dimension::number, Limit::not_negative, reading.drift_shear);
  reading.cohesion = section.quantity_or("cohesion", Dimension::pressure, Limit::positive, 100.0);
  if (section.find("invariants") != nullptr) {
    const std::vector<double> a = section.quantities("invariants", 3, Dimension::number, Limit::any);
    parameters.weights = fem::InvariantWeights{a[0], a[1], a[2]};
    constexpr double kRounding = 1e-12;
    if (std::abs(a[0] + a[1] - 0.5) > kRounding || a[0] < a[1] || a[2] < 0.0) {
      section.fault("invariants", "invariants: a1 + a2 must be 0.5, a1 at least a2, a3 not negative");
    }
  }
  return parameters;
}

template InformedParameters<2> read_informed_parameters<2>(Section&);
template InformedParameters<3> read_informed_parameters<3>(Section&);

void check_informed_parameters(Section& section, int dimension) {
  if (dimension == 3) {
    read_informed_parameters<3>(section);
  } else {
    read_informed_parameters<2>(section);
  }
}

}  // namespace polargrain::coupler
