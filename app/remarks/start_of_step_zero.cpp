// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/remarks/start_of_step_zero.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "app/remarks/given_stress.hpp"
#include "common/error.hpp"
#include "fem/material/elastic.hpp"
#include "fem/material/local_material.hpp"

namespace polargrain::app {
namespace {

constexpr std::size_t kMostElements = 20000;  // a second or two
constexpr std::size_t kMostElementsInSpace = 1000;

template <int dim>
std::optional<fem::ElasticParameters<dim>> elastic_of(const Scene& scene, const SceneRegion& region) {
  const auto key = [&](const char* name, coupler::Dimension dimension) {
    return scene.quantity({"materials", region.material, name}, dimension);
  };
  fem::ElasticParameters<dim> elastic;
  const double length = key("lc", coupler::Dimension::length).value_or(0.0);
  if (region.cell == nullptr) {
    const auto young = key("E", coupler::Dimension::pressure);
    const auto poisson = key("nu", coupler::Dimension::number);
    if (!young || !poisson) return {};
    elastic.young_modulus = *young;
    elastic.poisson_ratio = *poisson;
    elastic.cosserat_shear_modulus = key("Gc", coupler::Dimension::pressure).value_or(0.0);
    elastic.internal_length = length;
    if (const auto confining = key("confining", coupler::Dimension::pressure))
      for (int i = 0; i < 3; ++i) elastic.initial_stress(Cosserat<dim>::stress_place(i, i)) = -*confining;
    return elastic;
  }
  if (region.packing == nullptr || !(region.packing->moduli.shear > 0.0)) return {};
  const coupler::NetworkModuli& moduli = region.packing->moduli;
  elastic.poisson_ratio = std::clamp(moduli.poisson, -0.9, 0.45);
  elastic.young_modulus = 2.0 * moduli.shear * (1.0 + elastic.poisson_ratio);
  elastic.cosserat_shear_modulus = std::max(moduli.cosserat_shear, 0.1 * moduli.shear);
  elastic.internal_length = length > 0.0 ? length : 2.0 * region.cell->packing.mean_radius();
  Vector7 symmetric = region.packing->stress;
  symmetric(k12) = symmetric(k21) = 0.5 * (symmetric(k12) + symmetric(k21));
  elastic.initial_stress = stress_in<dim>(symmetric);
  return elastic;
}

template <int dim>
std::shared_ptr<fem::Material<dim>> material_of(const fem::ElasticParameters<dim>& elastic) {
  return std::make_shared<fem::LocalMaterial<fem::ElasticLaw<dim>>>(fem::ElasticLaw<dim>(elastic));
}

/// Null where a modulus is not known. A solver wants one of its own.
template <int dim>
std::shared_ptr<fem::Material<dim>> elastic_material(const Scene& scene, const std::string& name) {
  const SceneRegion& region = *std::ranges::find(scene.regions(), name, &SceneRegion::name);
  // No element of it is there, so its stiffness is in no sum.
  if (region.comes_later) return material_of<dim>({.young_modulus = 1.0, .cosserat_shear_modulus = 1.0});
  const auto elastic = elastic_of<dim>(scene, region);
  if (!elastic || !fem::faults(*elastic).empty()) return nullptr;
  return material_of(*elastic);
}

/// Square of the norm of the stress, forces only; in the plane without s33.
template <int dim>
double square_of(const typename Cosserat<dim>::Vector& stress) {
  double sum = 0.0;
  for (int i = 0; i < dim; ++i)
    for (int j = 0; j < dim; ++j) sum += std::pow(stress(Cosserat<dim>::stress_place(i, j)), 2);
  return sum;
}

template <int dim>
StartOfStepZero judged(fem::Solver<dim>& solver, const Scene& scene) {
  StartOfStepZero start;
  const fem::SolverState<dim>& state = solver.state();
  for (Eigen::Index k = 0; k < solver.problem().places().mechanics(); k += Cosserat<dim>::dofs)
    start.largest_displacement =
        std::max(start.largest_displacement, state.displacement.template segment<dim>(k).norm());
  double change = 0.0;
  double initial = 0.0;
  for (std::size_t point = 0; point < solver.points(); ++point) {
    if (!solver.is_there(point)) continue;
    const double volume = solver.volume_of_point(point);
    const SceneRegion& region = scene.region_of(solver.element_of_point(point));
    const typename Cosserat<dim>::Vector before =
        scene.initial_stress<dim>(region, solver.position_of_point(point))
            .value_or(Cosserat<dim>::Vector::Zero());
    change += volume * square_of<dim>(state.responses[point].stress - before);
    initial += volume * square_of<dim>(before);
  }
  start.has_stress = initial > 0.0;
  start.stress_change = start.has_stress ? std::sqrt(change / initial) : 0.0;
  return start;
}

template <int dim>
std::optional<StartOfStepZero> start_of(const Scene& scene) {
  fem::Problem<dim> problem = scene.problem_of<dim>();
  if (problem.mesh.elements.size() > (dim == 2 ? kMostElements : kMostElementsInSpace)) return {};
  for (fem::InitialStress<dim>& item : problem.initial_stresses)
    item.stress = [&scene, named = item.region](const typename Cosserat<dim>::Place& place) {
      return given_stress<dim>(scene, named, place).value_or(Cosserat<dim>::Vector::Zero());
    };
  problem.deformation = fem::Deformation::small;
  for (auto& [name, material] : problem.materials) {
    material = elastic_material<dim>(scene, name);
    if (material == nullptr) return {};
  }
  fem::SolverOptions options;
  options.most_cuts = 0;
  options.most_iterations = 5;
  try {
    // Tolerances without end: the state is only looked at, never corrected.
    options.force_tolerance = options.moment_tolerance = 1e300;
    fem::Solver<dim> looking(problem, options);
    const double out_of_balance = looking.equilibrate().force_residual;
    for (auto& [name, material] : problem.materials) material = elastic_material<dim>(scene, name);
    options.force_tolerance = options.moment_tolerance = 1e-6;
    fem::Solver<dim> solver(std::move(problem), options);
    if (!solver.equilibrate().converged) return {};
    StartOfStepZero start = judged(solver, scene);
    start.out_of_balance = out_of_balance;
    return start;
  } catch (const RunError&) {
    return {};  // the check of the problem says why
  } catch (const InputError&) {
    return {};
  }
}

}  // namespace

std::optional<StartOfStepZero> start_of_step_zero(const Scene& scene) {
  return scene.dimension() == 3 ? start_of<3>(scene) : start_of<2>(scene);
}

}  // namespace polargrain::app
