// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/solver/residual_floor.hpp"

#include "fem/element/dofs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace polargrain::fem {
namespace {

double square(double x) {
  return x * x;
}

}  // namespace

template <int dim>
Eigen::VectorXd forces_of_noise(const Discretisation<dim>& discretisation, Continuum continuum,
                                std::span<const Response<dim>> responses) {
  if (std::all_of(responses.begin(), responses.end(),
                  [](const Response<dim>& r) { return r.noise.is_zero(); })) {
    return {};
  }
  Eigen::VectorXd variance = Eigen::VectorXd::Zero(discretisation.nodal_size());
  for (std::size_t e = 0; e < discretisation.elements(); ++e) {
    if (!discretisation.is_there(e)) continue;
    const std::vector<int>& dofs = discretisation.element_dofs(e);
    for (std::size_t i = discretisation.first_point(e); i < discretisation.first_point(e + 1); ++i) {
      const PointGeometry<dim>& point = discretisation.point(i);
      const StressNoise& noise = responses[i].noise;
      const double volume = square(point.volume);
      const double normal = square(noise.symmetric);
      // s12 and s21 are their mean and half of their difference; a Cauchy continuum feels the mean alone.
      const bool cosserat = continuum == Continuum::cosserat;
      const double shear = normal + (cosserat ? 0.25 * square(noise.skew) : 0.0);
      for (Eigen::Index a = 0; a < point.shape.size(); ++a) {
        std::array<double, dim> d{};
        for (int i = 0; i < dim; ++i) d[static_cast<std::size_t>(i)] = square(point.gradient(a, i));
        const auto* entry = &dofs[static_cast<std::size_t>(entry_of<dim>(a))];
        for (int j = 0; j < dim; ++j) {
          double sum = d[static_cast<std::size_t>(j)] * normal;
          for (int i = 0; i < dim; ++i)
            if (i != j) sum += d[static_cast<std::size_t>(i)] * shear;
          variance(entry[j]) += volume * sum;
        }
        if (!cosserat) continue;
        double all = 0.0;
        for (const double one : d) all += one;
        for (int k = 0; k < Cosserat<dim>::rotations; ++k)
          variance(entry[dim + k]) +=
              volume * (square(point.shape(a) * noise.skew) + all * square(noise.couple));
      }
    }
  }
  return std::sqrt(2.0 / M_PI) * variance.cwiseSqrt();
}

template <int dim>
Eigen::VectorXd forces_of_rounding(const Discretisation<dim>& discretisation, Continuum continuum,
                                   std::span<const Response<dim>> responses,
                                   const Eigen::VectorXd& increment) {
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(discretisation.nodal_size());
  for (std::size_t e = 0; e < discretisation.elements(); ++e) {
    if (!discretisation.is_there(e)) continue;
    const std::vector<int>& dofs = discretisation.element_dofs(e);
    const Eigen::VectorXd moved = increment(dofs).cwiseAbs();
    for (std::size_t i = discretisation.first_point(e); i < discretisation.first_point(e + 1); ++i) {
      const PointGeometry<dim>& point = discretisation.point(i);
      const StrainMatrix<dim> b = strain_matrix<dim>(point, continuum).cwiseAbs();
      const typename Cosserat<dim>::Vector strain = b * moved;
      const typename Cosserat<dim>::Vector stress =
          responses[i].stress.cwiseAbs() + responses[i].tangent.cwiseAbs() * strain;
      forces(dofs) += point.volume * (b.transpose() * stress);
    }
  }
  return std::numeric_limits<double>::epsilon() * forces;
}

template Eigen::VectorXd forces_of_noise<2>(const Discretisation<2>& discretisation, Continuum continuum,
                                            std::span<const Response<2>> responses);
template Eigen::VectorXd forces_of_noise<3>(const Discretisation<3>& discretisation, Continuum continuum,
                                            std::span<const Response<3>> responses);
template Eigen::VectorXd forces_of_rounding<2>(const Discretisation<2>& discretisation, Continuum continuum,
                                               std::span<const Response<2>> responses,
                                               const Eigen::VectorXd& increment);
template Eigen::VectorXd forces_of_rounding<3>(const Discretisation<3>& discretisation, Continuum continuum,
                                               std::span<const Response<3>> responses,
                                               const Eigen::VectorXd& increment);

}  // namespace polargrain::fem
