// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "common/cell.hpp"
#include "coupler/case/keys.hpp"

namespace polargrain::coupler {

/// Keys of a material with cells: how a cell is loaded and when its answer counts. `rotations` is not among them, because other
/// keys of the material depend on it.
template <class Visit>
void describe_keys(CellControl& control, Visit&& visit) {
  constexpr const char* kAnyState = "any state at all would count as at rest";
  visit(
      Key{.name = "inertial_number",
          .meaning = "mean loading rate; smaller is slower and closer to quasi-static",
          .below = 0.1,
          .beyond =
              "grains would fly past each other instead of resting on each other; quasi-static is 1e-3 and less"},
      control.inertial_number);
  visit(Key{.name = "unbalanced_force_ratio",
            .meaning =
                "read-out when mean unbalanced over mean contact force is below. A contact force below a "
                "thousandth of the packing's counts as that thousandth",
            .below = 1.0,
            .beyond = kAnyState},
        control.unbalanced_force_ratio);
  visit(Key{.name = "unbalanced_moment_ratio",
            .meaning = "the same for moments",
            .below = 1.0,
            .beyond = kAnyState},
        control.unbalanced_moment_ratio);
  visit(Key{.name = "damping",
            .meaning = "against the affine flow, as a fraction of the critical one; less than 1",
            .limit = Limit::not_negative,
            .below = 1.0,
            .beyond = "grains would creep to where they rest",
            .also = "0.03 with `cell` in explicit steps"},
        control.damping);
  visit(
      Key{.name = "tangent",
          .meaning =
              "`condensed`: the contact network in its own equilibrium; `voigt`: affine motion, cheaper, far too "
              "stiff once contacts slide; `secant`: the tangent of the last step, corrected by the stress of the "
              "grains ([when](howto/method.md))"},
      control.tangent,
      std::array{Word<CellTangent>{"condensed", CellTangent::condensed},
                 Word<CellTangent>{"voigt", CellTangent::voigt},
                 Word<CellTangent>{"secant", CellTangent::secant}});
  visit(Key{.name = "least_steps",
            .meaning = "fewest DEM steps of an increment; more for [low stress](hard_cells.md#low-stress)"},
        control.least_steps);
  visit(Key{.name = "most_relaxation_steps",
            .meaning = "after so many the answer is unreliable and the step is cut"},
        control.most_relaxation_steps);
  visit(
      Key{.name = "loop",
          .meaning =
              "`automatic`: the project's loop over discs or spheres where it knows the scene, else LIGGGHTS's, "
              "which is slower; `engine`: always LIGGGHTS's. `run.log` says which"},
      control.loop,
      std::array{Word<CellLoop>{"automatic", CellLoop::automatic},
                 Word<CellLoop>{"engine", CellLoop::engine}});
}

}  // namespace polargrain::coupler
