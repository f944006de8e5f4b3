// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/case/models/informed_parameters.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "coupler/case/models/cone_match.hpp"
#include "coupler/case/models/scheme_section.hpp"

namespace polargrain::coupler {
namespace {

/// Of the cone before the first reading, rad.
constexpr double kInitialFriction = 5.0 * std::numbers::pi / 180.0;

/// Older files may have this key; its value is now the only one.
void refuse_former(Section& section, const char* key, const char* value) {
  if (section.find(key) != nullptr)
    section.fault(key,
                  fmt::format("{}: is no key any more, its value is always {}; leave it out", key, value));
}

}  // namespace

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
  if (const Entry* const beyond = section.find("beyond_mismatch");
      beyond != nullptr && beyond->text == "stop")
    section.fault(
        "beyond_mismatch",
        "beyond_mismatch: 'stop' is no choice any more; write tell, and look at stress_mismatch in summary.json");
  else if (section.choice_or("beyond_mismatch", {"tell", "cell"}, "tell") == "cell")
    parameters.beyond_mismatch = BeyondMismatch::cell;
  refuse_former(section, "window", "5 increments");
  refuse_former(section, "dilatancy_limits", "[-0.5, 1]");
  refuse_former(section, "initial_friction", "5 deg");
  fem::MobilisationOptions& reading = parameters.mobilisation;
  reading.initial_friction = kInitialFriction;
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

void check_informed_parameters(Section& material, int dimension, Faults& faults) {
  for_its_faults(faults, [&] {
    SchemeSection informed(material, "informed", faults);
    if (dimension == 3) {
      read_informed_parameters<3>(informed.keys());
    } else {
      read_informed_parameters<2>(informed.keys());
    }
    informed.finish();
  });
}

}  // namespace polargrain::coupler
