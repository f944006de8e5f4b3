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
constexpr double kNothing = 1e-7;

}  // namespace

void movement(const Scene& scene, Remarks& remarks) {
  for (const fem::PrescribedDof<2>& item : scene.problem().prescribed) {
    if (item.dof == fem::Dof::w) continue;
    const double movement = scene.reached(item.value);
    if (movement == 0.0) continue;
    const double side = item.dof == fem::Dof::u2 ? scene.body().size().y() : scene.body().smaller_side();
    const double share = movement / side;
    const bool small = scene.problem().deformation == fem::Deformation::small;
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
    else if (share < kNothing)
      remarks.push_back({Rank::doubtful, kNothing / share,
                         place.fault(seen + ", less than rounding and grains can resolve"),
                         "check the units of the movement and of the mesh (Gmsh's numbers are in m)"});
  }
}

}  // namespace polargrain::app
