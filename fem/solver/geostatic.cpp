// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/solver/geostatic.hpp"

#include <utility>

namespace polargrain::fem {

template <int dim>
InitialStress<dim> geostatic_stress(const Ground& ground, std::string region) {
  const auto stress = [ground](const typename Cosserat<dim>::Place& x) {
    constexpr int up = dim - 1;
    double vertical = -(ground.surcharge + ground.unit_weight * (ground.surface_height - x(up)));
    if (ground.water_level) vertical += ground.water_weight * (*ground.water_level - x(up));
    typename Cosserat<dim>::Vector s = Cosserat<dim>::Vector::Zero();
    for (int i = 0; i < dim; ++i)
      s(Cosserat<dim>::stress_place(i, i)) = i == up ? vertical : ground.earth_pressure_ratio * vertical;
    if constexpr (dim == 2) s(k33) = s(k11);
    return s;
  };
  return {stress, std::move(region)};
}

template <int dim>
BodyLoad<dim> gravity(double unit_weight, TimeTable factor, std::string region) {
  return {[unit_weight](const typename Cosserat<dim>::Place&) {
            return
                typename Cosserat<dim>::NodeValues(-unit_weight * Cosserat<dim>::NodeValues::Unit(dim - 1));
          },
          std::move(factor), std::move(region)};
}

template InitialStress<2> geostatic_stress<2>(const Ground& ground, std::string region);
template InitialStress<3> geostatic_stress<3>(const Ground& ground, std::string region);
template BodyLoad<2> gravity<2>(double unit_weight, TimeTable factor, std::string region);
template BodyLoad<3> gravity<3>(double unit_weight, TimeTable factor, std::string region);

}  // namespace polargrain::fem
