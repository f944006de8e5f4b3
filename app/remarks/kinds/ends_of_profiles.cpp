// SPDX-License-Identifier: GPL-2.0-or-later
// Profiles that end outside of the body, where they have no values: a unit or a sign is wrong, or the body is smaller.
#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "app/remarks/kinds.hpp"
#include "fem/mesh/find_place.hpp"

namespace polargrain::app {
namespace {

template <int dim>
void look_in(const Scene& scene, const fem::Problem<dim>& problem, Remarks& remarks) {
  const fem::PlaceFinder<dim> body(problem.mesh);
  for (const coupler::Profile& profile : scene.the_case().profiles) {
    const auto is_outside = [&](const std::vector<double>& at) {
      return body.find(Eigen::Map<const typename Cosserat<dim>::Place>(at.data())).elements.empty();
    };
    // A line across a hole is what it is meant to be; one that ends outside is not.
    if (!is_outside(profile.places.front()) && !is_outside(profile.places.back())) continue;
    remarks.push_back(
        {Rank::doubtful, 1.0,
         scene.place({"profiles", profile.name})
             .fault(fmt::format(
                 "profile '{}': it ends outside of the body: {} of its {} points have no values",
                 profile.name, std::ranges::count_if(profile.places, is_outside), profile.places.size())),
         "let 'from' and 'to' lie on the mesh as it is made"});
  }
}

}  // namespace

void ends_of_profiles(const Scene& scene, Remarks& remarks) {
  if (scene.the_case().profiles.empty()) return;
  scene.the_case().with_problem([&](const auto& problem) { look_in(scene, problem, remarks); });
}

}  // namespace polargrain::app
