// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/run/run_observer.hpp"

namespace polargrain::app {

void log_step(spdlog::logger& log, const fem::StepReport& report, double largest_strain) {
  if (report.within_noise > 0) {
    log.warn(
        "  accepted above the tolerance, within the noise of the stresses: force residual {:.3e}, noise "
        "{:.3e}",
        report.force_residual, report.force_noise);
  }
  if (report.within_rounding > 0) {
    log.warn("  accepted above the tolerance because nothing but rounding is left: force residual {:.3e}",
             report.force_residual);
  }
  if (report.limited > 0) {
    log.warn("  {} corrections asked for strains beyond {} and were shortened or replaced", report.limited,
             largest_strain);
  }
  if (report.jumps > 0) {
    log.warn(
        "  {} jumps of the stresses were passed; the largest left a force residual of {:.3e}, let go since",
        report.jumps, report.jump_residual);
  }
  if (report.given_up > 0)
    log.warn("  {} iterations did not balance it: explicit steps go on from here", report.given_up);
  if (report.energies.kinetic > 0.0) {
    log.info(
        "  {} explicit steps to {:.6g} s, kinetic energy {:.4g} of {:.4g} J supplied, energy error {:.2e}",
        report.explicit_steps, report.time, report.energies.kinetic, report.energies.external,
        report.energies.error());
    return;
  }
  if (report.explicit_steps > 0) {
    log.info(
        "  {} explicit steps, {} of them to come to rest, mean force residual {:.3e}, kinetic energy of the chosen masses "
        "{:.2e} of the internal work, reactions differ by {:.2e}, grains unbalanced by {:.2e}, time {:.6g}",
        report.explicit_steps, report.rest_steps, report.force_residual, report.quasi_static.kinetic_share,
        report.quasi_static.reaction_difference, report.quasi_static.grains_unbalanced, report.time);
    return;
  }
  log.info("  {} after {} iterations, {} cuts, {} evaluations, time {:.6g}",
           report.converged ? "converged" : "NOT converged", report.iterations, report.cuts,
           report.evaluations, report.time);
}

}  // namespace polargrain::app
