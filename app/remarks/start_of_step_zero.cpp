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

std::optional<fem::ElasticParameters<2>> elastic_of(const Scene& scene, const SceneRegion& region) {
  const auto key = [&](const char* name, coupler::Dimension dimension) {
    return scene.quantity({"materials", region.material, name}, dimension);
  };
  fem::ElasticParameters<2> elastic;
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
      for (const int i : {k11, k22, k33}) elastic.initial_stress(i) = -*confining;
    return elastic;
  }
  if (region.packing == nullptr || !(region.packing->moduli.shear > 0.0)) return {};
  const coupler::NetworkModuli& moduli = region.packing->moduli;
  elastic.poisson_ratio = std::clamp(moduli.poisson, -0.9, 0.45);
  elastic.young_modulus = 2.0 * moduli.shear * (1.0 + elastic.poisson_ratio);
  elastic.cosserat_shear_modulus = std::max(moduli.cosserat_shear, 0.1 * moduli.shear);
  elastic.internal_length = length > 0.0 ? length : 2.0 * region.cell->packing.mean_radius();
  elastic.initial_stress = region.packing->stress;
  elastic.initial_stress(k12) = elastic.initial_stress(k21) =
      0.5 * (region.packing->stress(k12) + region.packing->stress(k21));
  elastic.initial_stress(kCurvature1) = elastic.initial_stress(kCurvature2) = 0.0;
  return elastic;
}

std::shared_ptr<fem::Material<2>> material_of(const fem::ElasticParameters<2>& elastic) {
  return std::make_shared<fem::LocalMaterial<fem::ElasticLaw<2>>>(fem::ElasticLaw<2>(elastic));
}

/// Null where a modulus is not known. A solver wants one of its own.
std::shared_ptr<fem::Material<2>> elastic_material(const Scene& scene, const std::string& name) {
  const SceneRegion& region = *std::ranges::find(scene.regions(), name, &SceneRegion::name);
  // No element of it is there, so its stiffness is in no sum.
  if (region.comes_later) return material_of({.young_modulus = 1.0, .cosserat_shear_modulus = 1.0});
  const auto elastic = elastic_of(scene, region);
  if (!elastic || !fem::faults(*elastic).empty()) return nullptr;
  return material_of(*elastic);
}

/// Norm of the stress in the plane, forces only.
double square_of(const Vector7& stress) {
  double sum = 0.0;
  for (const int i : {k11, k22, k12, k21}) sum += stress(i) * stress(i);
  return sum;
}

StartOfStepZero judged(fem::Solver<2>& solver, const Scene& scene) {
  StartOfStepZero start;
  const fem::SolverState<2>& state = solver.state();
  for (Eigen::Index k = 0; k < solver.problem().places().mechanics(); k += 3)
    start.largest_displacement =
        std::max(start.largest_displacement, state.displacement.segment<2>(k).norm());
  double change = 0.0;
  double initial = 0.0;
  for (std::size_t point = 0; point < solver.points(); ++point) {
    if (!solver.is_there(point)) continue;
    const double volume = solver.volume_of_point(point);
    const SceneRegion& region = scene.region_of(solver.element_of_point(point));
    const Vector7 before =
        scene.initial_stress(region, solver.position_of_point(point)).value_or(Vector7::Zero());
    change += volume * square_of(state.responses[point].stress - before);
    initial += volume * square_of(before);
  }
  start.has_stress = initial > 0.0;
  start.stress_change = start.has_stress ? std::sqrt(change / initial) : 0.0;
  return start;
}

}  // namespace

std::optional<StartOfStepZero> start_of_step_zero(const Scene& scene) {
  if (scene.mesh().elements.size() > kMostElements) return {};
  fem::Problem<2> problem = scene.problem();
  for (fem::InitialStress<2>& item : problem.initial_stresses)
    item.stress = [&scene, named = item.region](const Eigen::Vector2d& place) {
      return given_stress(scene, named, place).value_or(Vector7::Zero());
    };
  problem.deformation = fem::Deformation::small;
  for (auto& [name, material] : problem.materials) {
    material = elastic_material(scene, name);
    if (material == nullptr) return {};
  }
  fem::SolverOptions options;
  options.most_cuts = 0;
  options.most_iterations = 5;
  try {
    // Tolerances without end: the state is only looked at, never corrected.
    options.force_tolerance = options.moment_tolerance = 1e300;
    fem::Solver<2> looking(problem, options);
    const double out_of_balance = looking.equilibrate().force_residual;
    for (auto& [name, material] : problem.materials) material = elastic_material(scene, name);
    options.force_tolerance = options.moment_tolerance = 1e-6;
    fem::Solver<2> solver(std::move(problem), options);
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

}  // namespace polargrain::app
