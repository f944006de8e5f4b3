// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/material/elastic.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "common/error.hpp"

namespace polargrain::fem {

template <int dim>
std::vector<std::string> faults(const ElasticParameters<dim>& parameters) {
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
  const double trace = parameters.couple_trace_ratio;
  const double transpose = parameters.couple_transpose_ratio;
  // The eigenvalues of the couple law on spherical, symmetric deviatoric and skew curvatures.
  if (!(3.0 * trace + transpose + 1.0 >= 0.0 && std::abs(transpose) <= 1.0)) {
    messages.push_back(fmt::format(
        "the couple moduli must not be negative: beta over gamma must lie from -1 to 1, found {}, and "
        "3 alpha + beta over gamma must be at least -1, found {}",
        transpose, 3.0 * trace + transpose));
  }
  return messages;
}

template <int dim>
typename Cosserat<dim>::Matrix elastic_stiffness(const ElasticParameters<dim>& parameters) {
  const double nu = parameters.poisson_ratio;
  const double g = parameters.young_modulus / (2.0 * (1.0 + nu));
  const double lambda = 2.0 * g * nu / (1.0 - 2.0 * nu);
  const double gc = parameters.cosserat_shear_modulus;
  using Counts = Cosserat<dim>;
  typename Counts::Matrix d = Counts::Matrix::Zero();
  // The normal stresses; s33 is one in the plane too.
  const auto normal = [](int i) { return dim == 2 ? i : Counts::stress_place(i, i); };
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) d(normal(i), normal(j)) = lambda;
    d(normal(i), normal(i)) += 2.0 * g;
  }
  for (int i = 0; i < dim; ++i) {
    for (int j = 0; j < dim; ++j) {
      if (i == j) continue;
      const int place = Counts::stress_place(i, j);
      d(place, place) = g + gc;
      d(place, Counts::stress_place(j, i)) = g - gc;
    }
  }
  const double gamma = 2.0 * g * parameters.internal_length * parameters.internal_length;
  for (int i = 0; i < dim; ++i)
    for (int k = 0; k < Counts::rotations; ++k)
      d(Counts::couple_place(i, k), Counts::couple_place(i, k)) = gamma;
  if constexpr (dim == 3) {
    for (int i = 0; i < dim; ++i) {
      for (int j = 0; j < dim; ++j) {
        d(Counts::couple_place(i, j), Counts::couple_place(j, i)) +=
            parameters.couple_transpose_ratio * gamma;
        d(Counts::couple_place(i, i), Counts::couple_place(j, j)) += parameters.couple_trace_ratio * gamma;
      }
    }
  }
  return d;
}

template <int dim>
ElasticLaw<dim>::ElasticLaw(const ElasticParameters<dim>& parameters)
    : initial_stress_(parameters.initial_stress) {
  if (const auto messages = faults(parameters); !messages.empty()) {
    throw RunError(fmt::format("elastic material: {}", fmt::join(messages, "; ")));
  }
  stiffness_ = elastic_stiffness(parameters);
}

template <int dim>
Response<dim> ElasticLaw<dim>::integrate(const State& start, const Vector& strain, State& trial) const {
  trial.stress = start.stress + stiffness_ * strain;
  Response<dim> response;
  response.stress = trial.stress;
  response.tangent = stiffness_;
  return response;
}

template std::vector<std::string> faults<2>(const ElasticParameters<2>& parameters);
template std::vector<std::string> faults<3>(const ElasticParameters<3>& parameters);
template Cosserat<2>::Matrix elastic_stiffness<2>(const ElasticParameters<2>& parameters);
template Cosserat<3>::Matrix elastic_stiffness<3>(const ElasticParameters<3>& parameters);
template class ElasticLaw<2>;
template class ElasticLaw<3>;

}  // namespace polargrain::fem
