// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/material/unloading.hpp"

#include <algorithm>
#include <cmath>

namespace polargrain::fem {
namespace {

constexpr double kSoftest = 0.02;
constexpr double kStiffest = 2.0;
constexpr double kMostContraction = 1.0;

}  // namespace

template <int dim>
UnloadingMode::Felt<dim> UnloadingMode::felt(const ScaledVector<double, dim>& strain,
                                             std::size_t parts) const {
  const Split<double, dim> split(strain);
  std::array<double, 3> factor{1.0, 1.0, 1.0};
  ScaledVector<double, dim> sheared = ScaledVector<double, dim>::Zero();
  Felt<dim> felt{split.mean * volumetric_vector<double, dim>(), ScaledMatrix<double, dim>::Zero()};
  for (std::size_t k = 0; k < 3; ++k) {
    if (k < parts) {
      factor[k] = stiffness;
      sheared += split.part[k];
    }
    felt.strain += factor[k] * split.part[k];
  }
  felt.slope = subspace_matrix<double, dim>(factor);
  add_volumetric(felt.slope, 1.0 / 3.0);
  const double size = sheared.norm();
  if (size > 0.0) {
    felt.strain -= contraction / 3.0 * size * volumetric_vector<double, dim>();
    felt.slope -= contraction / 3.0 * volumetric_vector<double, dim>() * (sheared / size).transpose();
  }
  return felt;
}

template <int dim>
std::optional<UnloadingMode> unloading_mode(const SubspaceModuli& moduli,
                                            const ScaledVector<double, dim>& strain,
                                            const ScaledVector<double, dim>& stress_increment) {
  const Split<double, dim> strains(strain);
  const Split<double, dim> stresses(stress_increment);
  double work = 0.0;
  double elastic = 0.0;
  double squares = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    work += plain_dot(strains.part[k], stresses.part[k]);
    elastic += moduli.stiffness[k] * strains.part[k].squaredNorm();
    squares += strains.part[k].squaredNorm();
  }
  if (!(elastic > 0.0)) return std::nullopt;
  const double volume = 3.0 * strains.mean - stresses.mean / moduli.bulk;
  return UnloadingMode{std::clamp(work / elastic, kSoftest, kStiffest),
                       std::clamp(volume / std::sqrt(squares), -kMostContraction, kMostContraction)};
}

template UnloadingMode::Felt<2> UnloadingMode::felt<2>(const ScaledVector<double, 2>&, std::size_t) const;
template UnloadingMode::Felt<3> UnloadingMode::felt<3>(const ScaledVector<double, 3>&, std::size_t) const;
template std::optional<UnloadingMode> unloading_mode<2>(const SubspaceModuli&, const ScaledVector<double, 2>&,
                                                        const ScaledVector<double, 2>&);
template std::optional<UnloadingMode> unloading_mode<3>(const SubspaceModuli&, const ScaledVector<double, 3>&,
                                                        const ScaledVector<double, 3>&);

}  // namespace polargrain::fem
