// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/remarks/given_stress.hpp"

#include <algorithm>
#include <cmath>

namespace polargrain::app {
namespace {

constexpr double kRatioAtRest = 0.5;  ///< of sand: 1 - sin of 30 deg

template <int dim>
bool holds(const fem::InitialStress<dim>& item, const std::string& region) {
  return item.region.empty() || item.region == region;
}

}  // namespace

template <int dim>
std::optional<typename Cosserat<dim>::Vector> given_stress(const Scene& scene, const std::string& region,
                                                           const typename Cosserat<dim>::Place& place) {
  std::optional<typename Cosserat<dim>::Vector> given;
  for (const fem::InitialStress<dim>& item : scene.problem_of<dim>().initial_stresses)
    if (holds(item, region)) given = item.stress(place);
  if (!given) return given;
  constexpr int kUp = dim - 1;
  const double vertical = (*given)(Cosserat<dim>::stress_place(kUp, kUp));
  for (int i = 0; i < 3; ++i)
    if (double& across = (*given)(Cosserat<dim>::stress_place(i, i)); std::isnan(across))
      across = kRatioAtRest * vertical;
  return given;
}

template std::optional<Vector7> given_stress<2>(const Scene&, const std::string&, const Eigen::Vector2d&);
template std::optional<Vector18> given_stress<3>(const Scene&, const std::string&, const Eigen::Vector3d&);

bool has_given_stress(const Scene& scene, const std::string& region) {
  return scene.with_problem([&](const auto& problem) {
    return std::ranges::any_of(problem.initial_stresses,
                               [&](const auto& item) { return holds(item, region); });
  });
}

}  // namespace polargrain::app
