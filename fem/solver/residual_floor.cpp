// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/solver/residual_floor.hpp"

#include "fem/element/dofs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace polargrain::fem {
namespace {

double square(double x) {
  return x * x;
}

}  // namespace

Eigen::VectorXd forces_of_noise(const Discretisation& discretisation, Continuum continuum,
                                std::span<const Response> responses) {
  if (std::all_of(responses.begin(), responses.end(), [](const Response& r) { return r.noise.is_zero(); })) {
    return {};
  }
  Eigen::VectorXd variance = Eigen::VectorXd::Zero(discretisation.nodal_size());
  for (std::size_t e = 0; e < discretisation.elements(); ++e) {
    const std::vector<int>& dofs = discretisation.element_dofs(e);
    for (std::size_t i = discretisation.first_point(e); i < discretisation.first_point(e + 1); ++i) {
      const PointGeometry& point = discretisation.point(i);
      const StressNoise& noise = responses[i].noise;
      const double volume = square(point.volume);
      const double normal = square(noise.symmetric);
      // s12 and s21 are their mean and half of their difference; a Cauchy continuum feels the mean alone.
      const bool cosserat = continuum == Continuum::cosserat;
      const double shear = normal + (cosserat ? 0.25 * square(noise.skew) : 0.0);
      for (Eigen::Index a = 0; a < point.shape.size(); ++a) {
        const double d1 = square(point.gradient(a, 0));
        const double d2 = square(point.gradient(a, 1));
        const auto* entry = &dofs[static_cast<std::size_t>(entry_of(a))];
        variance(entry[0]) += volume * (d1 * normal + d2 * shear);
        variance(entry[1]) += volume * (d2 * normal + d1 * shear);
        if (!cosserat) continue;
        variance(entry[2]) +=
            volume * (square(point.shape(a) * noise.skew) + (d1 + d2) * square(noise.couple));
      }
    }
  }
  return std::sqrt(2.0 / M_PI) * variance.cwiseSqrt();
}

Eigen::VectorXd forces_of_rounding(const Discretisation& discretisation, Continuum continuum,
                                   std::span<const Response> responses, const Eigen::VectorXd& increment) {
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(discretisation.nodal_size());
  for (std::size_t e = 0; e < discretisation.elements(); ++e) {
    const std::vector<int>& dofs = discretisation.element_dofs(e);
    const Eigen::VectorXd moved = increment(dofs).cwiseAbs();
    for (std::size_t i = discretisation.first_point(e); i < discretisation.first_point(e + 1); ++i) {
      const PointGeometry& point = discretisation.point(i);
      const Eigen::Matrix<double, 7, Eigen::Dynamic> b = strain_matrix(point, continuum).cwiseAbs();
      const Vector7 strain = b * moved;
      const Vector7 stress = responses[i].stress.cwiseAbs() + responses[i].tangent.cwiseAbs() * strain;
      forces(dofs) += point.volume * (b.transpose() * stress);
    }
  }
  return std::numeric_limits<double>::epsilon() * forces;
}

}  // namespace polargrain::fem
