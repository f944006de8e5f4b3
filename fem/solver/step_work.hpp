// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <algorithm>

namespace polargrain::fem {

/// The work of a step, lost tries included, and the doubts that it was let through with.
struct StepWork {
  int substeps = 0;  ///< committed on the way; 1 when nothing was cut
  int cuts = 0;
  int iterations = 0;
  long evaluations = 0;     ///< of material points
  int within_noise = 0;     ///< substeps committed with a residual above its tolerance but within the noise
  int within_rounding = 0;  ///< substeps committed above their tolerance because nothing but rounding is left
  int limited = 0;          ///< corrections that SolverOptions::largest_strain has shortened or replaced
  int jumps = 0;            ///< jumps of the stresses that were passed, see SolverOptions::most_jumps
  double jump_residual = 0.0;  ///< the largest force residual that one of them left, let go since
  double material_seconds = 0.0;
  double assembly_seconds = 0.0;
  double solve_seconds = 0.0;

  StepWork& operator+=(const StepWork& more) {
    substeps += more.substeps;
    cuts += more.cuts;
    iterations += more.iterations;
    evaluations += more.evaluations;
    within_noise += more.within_noise;
    within_rounding += more.within_rounding;
    limited += more.limited;
    jumps += more.jumps;
    jump_residual = std::max(jump_residual, more.jump_residual);
    material_seconds += more.material_seconds;
    assembly_seconds += more.assembly_seconds;
    solve_seconds += more.solve_seconds;
    return *this;
  }
};

}  // namespace polargrain::fem
