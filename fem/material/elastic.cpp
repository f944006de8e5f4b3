// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/material/elastic.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/error.hpp"

namespace polargrain::fem {

std::vector<std::string> faults(const ElasticParameters& parameters) {
  std::vector<std::string> messages;
  if (!(parameters.young_modulus > 0.0)) {
    messages.push_back(fmt::format("Young's modulus must be positive, not {} Pa", parameters.young_modulus));
  }
  if (!(parameters.poisson_ratio > -1.0 && parameters.poisson_ratio < 0.5)) {
    messages.push_back(
        fmt::format("Poisson's ratio must lie between -1 and 0.5, not be {}", parameters.poisson_ratio));
  }
  if (!(parameters.cosserat_shear_modulus >= 0.0)) {
    messages.push_back(fmt::format("the Cosserat shear modulus Gc must not be negative, it is {} Pa",
                                   parameters.cosserat_shear_modulus));
  }
  if (!(parameters.internal_length >= 0.0)) {
    messages.push_back(
        fmt::format("the internal length lc must not be negative, it is {} m", parameters.internal_length));
  }
  return messages;
}

Matrix7 elastic_stiffness(const ElasticParameters& parameters) {
  const double nu = parameters.poisson_ratio;
  const double g = parameters.young_modulus / (2.0 * (1.0 + nu));
  const double lambda = 2.0 * g * nu / (1.0 - 2.0 * nu);
  const double gc = parameters.cosserat_shear_modulus;
  Matrix7 d = Matrix7::Zero();
  d.topLeftCorner<3, 3>().setConstant(lambda);
  for (const int i : {k11, k22, k33}) d(i, i) += 2.0 * g;
  d(k12, k12) = d(k21, k21) = g + gc;
  d(k12, k21) = d(k21, k12) = g - gc;
  d(kCurvature1, kCurvature1) = d(kCurvature2, kCurvature2) =
      2.0 * g * parameters.internal_length * parameters.internal_length;
  return d;
}

ElasticLaw::ElasticLaw(const ElasticParameters& parameters) : initial_stress_(parameters.initial_stress) {
  if (const auto messages = faults(parameters); !messages.empty()) {
    throw RunError(fmt::format("elastic material: {}", fmt::join(messages, "; ")));
  }
  stiffness_ = elastic_stiffness(parameters);
}

Response ElasticLaw::integrate(const State& start, const Vector7& strain, State& trial) const {
  trial.stress = start.stress + stiffness_ * strain;
  Response response;
  response.stress = trial.stress;
  response.tangent = stiffness_;
  return response;
}

}  // namespace polargrain::fem
