// SPDX-License-Identifier: GPL-2.0-or-later
// Movements against the body they move.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/remarks/kinds.hpp"

namespace polargrain::app {
namespace {

constexpr double kLarge = 0.5;       // of the body
constexpr double kLargeSmall = 0.1;  // in small deformation
constexpr double kNoMovement = 1e-7;

template <int dim>
void look_at(const Scene& scene, const fem::Problem<dim>& problem, Remarks& remarks) {
  for (const fem::PrescribedDof<dim>& item : problem.prescribed) {
    // A body that is shaken is carried along.
    if (fem::is_rotation(item.dof) || scene.boundary_value(item.on, "accelerate") != nullptr) continue;
    const double movement = scene.reached(item.value);
    if (movement == 0.0) continue;
    const double side = scene.strained_side(item.dof);
    const double share = movement / side;
    const bool small = problem.deformation == fem::Deformation::small;
    const coupler::Entry* const value = scene.boundary_value(item.on, "move");
    const coupler::Entry& place = value != nullptr ? *value : scene.place({"boundary"});
    const std::string seen =
        fmt::format("boundary: '{}' moves by {:.4g} mm, {:.3g} % of the body ({:.4g} mm)", item.on,
                    1e3 * movement, 100.0 * share, 1e3 * side);
    if (share > kLarge)
      remarks.push_back(
          {Rank::wrong, share / kLarge, place.fault(seen), "check the unit: without one it is in m"});
    else if (share > kLargeSmall && small)
      remarks.push_back({Rank::doubtful, share / kLargeSmall, place.fault(seen + ", in small deformation"),
                         "set 'deformation: large', or move less"});
    else if (share < kNoMovement)
      remarks.push_back({Rank::doubtful, kNoMovement / share,
                         place.fault(seen + ", less than rounding and grains can resolve"),
                         "check the units of the movement and of the mesh (Gmsh's numbers are in m)"});
  }
}

}  // namespace

void movement(const Scene& scene, Remarks& remarks) {
  scene.with_problem([&](const auto& problem) { look_at(scene, problem, remarks); });
}

}  // namespace polargrain::app
