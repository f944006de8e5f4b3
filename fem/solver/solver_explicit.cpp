// SPDX-License-Identifier: GPL-2.0-or-later
// The explicit steps of Solver (docs/theory/explicit.md).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "common/error.hpp"
#include "fem/solver/base_motion.hpp"
#include "fem/solver/explicit_pace.hpp"
#include "fem/solver/nodal_spin.hpp"
#include "fem/solver/solver_implementation.hpp"

namespace polargrain::fem {
namespace {

constexpr int kRampIsOver = 1 << 30;  // explicit steps since rest, more than any ramp has

/// In the order of the equations. Fields have no mass: theirs is one, and their velocity zero.
template <int dim>
Eigen::VectorXd masses_of_unknowns(const Constraints<dim>& constraints, const Eigen::VectorXd& nodal) {
  Eigen::VectorXd masses = constraints.restrict_to_free(nodal);
  masses.segment(constraints.mechanical_unknowns(), constraints.field_unknowns()).setOnes();
  return masses;
}

/// A row of explicit steps under way. @tparam Inside the inside of a Solver
template <int dim, class Inside>
class ExplicitRow {
 public:
  /// @param solver, options, quiet, report must outlive this object @param quiet null: no quiet boundary
  /// @param seconds of a step; without real time 1, where elements have the shape for which the masses were chosen
  ExplicitRow(Inside& solver, const ExplicitOptions& options, const QuietBoundary<dim>* quiet, double seconds,
              StepReport& report)
      : solver_(solver),
        options_(options),
        quiet_(quiet),
        seconds_(seconds),
        report_(report),
        damping_(damping_of_steps(solver.problem, solver.constraints, options,
                                  solver.state.seconds > 0.0 ? std::optional(seconds) : std::nullopt)),
        base_(solver.problem, solver.constraints, solver.state.stage),
        spin_(solver.state.velocity.isZero(0.0) ? Eigen::VectorXd::Zero(solver.constraints.unknowns())
                                                : spin_of_last_step()),
        forces_(solver.constraints.restrict_to_free(solver.unbalanced())) {}

  /// One step. @returns whether it could be taken; the report says why not
  [[nodiscard]] bool step_to(double time, double released) {
    SolverState<dim>& state = solver_.state;
    Step step = next();
    state.velocity = std::move(step.velocity);
    state.energies.damped += step.damped;
    state.energies.external -= step.supplied;  // works count from it
    state.energies.absorbed += step.absorbed;
    const Attempt went = solver_.go_on(time, released, seconds_ * state.velocity, report_);
    if (!went.converged) {
      report_.message = went.reason;
      report_.time = state.time;
      return false;
    }
    ++report_.explicit_steps;
    spin_ = spin_of_last_step();
    forces_ = solver_.constraints.restrict_to_free(solver_.last_unbalanced());
    return true;
  }

  /// Takes the steps of a pace. @param releases whether forces held back are let go over the row
  /// @param behind called with the number of each step behind it @returns as step_to
  template <class Behind>
  [[nodiscard]] bool follow(const ExplicitPace& pace, bool releases, const Behind& behind) {
    for (int step = 1; step <= pace.steps(); ++step) {
      if (!step_to(pace.time(step), releases ? pace.fraction(step) : solver_.released())) return false;
      behind(step);
    }
    return true;
  }

  /// Lets the nodes come to rest where they are, boundaries held. @returns as step_to
  [[nodiscard]] bool come_to_rest(double time, Residual& residual) {
    // Kinetic damping (Cundall 1976): the nodes stop whenever they are fastest, which is where they pass their balance.
    double before = 0.0;
    residual = solver_.relative(solver_.last_unbalanced());
    while (residual.force > options_.rest && report_.rest_steps < options_.most_rest_steps) {
      if (!step_to(time, solver_.released())) return false;
      ++report_.rest_steps;
      residual = solver_.relative(solver_.last_unbalanced());
      const double energy = kinetic_energy();
      // Half a step back, so that the next velocity is that of half a step from where they stop: whole ones would
      // drive the fastest waves.
      if (energy < before)
        solver_.state.velocity = -0.5 * seconds_ * forces_.cwiseQuotient(solver_.state.mass);
      stop_fields(solver_.state.velocity);
      before = energy < before ? 0.0 : energy;
    }
    solver_.state.velocity.setZero();
    return true;
  }

  /// At the end of the last step.
  [[nodiscard]] Eigen::VectorXd velocity() const { return 0.5 * (solver_.state.velocity + next().velocity); }

  /// With the velocities of half a step ago.
  [[nodiscard]] double kinetic_energy() const {
    return 0.5 * solver_.state.velocity.cwiseAbs2().dot(solver_.state.mass);
  }

  /// At the end of the last step. With the kinetic energy 1/2 v_- M v_+ of the velocities half a step before and behind, and
  /// work by the trapezoidal rule, the balance of central differences holds without an error of the step.
  [[nodiscard]] Energies energies() const {
    const SolverState<dim>& state = solver_.state;
    const Step step = next();
    Energies now = state.energies;
    now.kinetic = 0.5 * state.velocity.cwiseProduct(state.mass).dot(step.velocity);
    now.internal = state.internal_work - state.energies.internal;
    now.external = state.external_work - state.energies.external;
    now.at_start = std::max(std::abs(state.energies.internal), std::abs(state.energies.external));
    now.external += step.supplied_first_half;
    now.damped += step.damped_first_half;
    now.absorbed += step.absorbed_first_half;
    return now;
  }

 private:
  /// From half a step before to half a step behind.
  struct Step {
    Eigen::VectorXd velocity;
    double damped = 0.0;               ///< energy over the step in whose middle the nodes are
    double absorbed = 0.0;             ///< the same through quiet boundaries
    double supplied = 0.0;             ///< the same, by the base through the damping
    double damped_first_half = 0.0;    ///< of that, until now
    double absorbed_first_half = 0.0;  ///< the same
    double supplied_first_half = 0.0;  ///< the same
  };

  [[nodiscard]] Step next() const {
    const Eigen::VectorXd& velocity = solver_.state.velocity;
    const Eigen::VectorXd& mass = solver_.state.mass;
    Step step;
    const Eigen::VectorXd damping = damping_.speed + damping_.lag;
    const Eigen::VectorXd base = base_.velocity(solver_.state.time);
    const Eigen::VectorXd pull = damping_.lag.cwiseProduct(spin_) + damping_.speed.cwiseProduct(base);
    step.velocity = ((1.0 - 0.5 * damping.array()) * velocity.array() +
                     seconds_ * forces_.array() / mass.array() + pull.array()) /
                    (1.0 + 0.5 * damping.array());
    stop_fields(step.velocity);
    if (quiet_ != nullptr) {
      const auto energy = quiet_->apply(solver_.constraints, velocity,
                                        mass + 0.5 * damping.cwiseProduct(mass), seconds_, step.velocity);
      step.absorbed = energy.over_step;
      step.absorbed_first_half = energy.first_half;
    }
    const Eigen::VectorXd force =
        mass.cwiseProduct(0.5 * damping.cwiseProduct(velocity + step.velocity) - pull);
    // The dampers stand on the base. They take the work on the way relative to it, and the base supplies the rest.
    step.supplied = -force.dot(base);
    step.supplied_first_half = 0.5 * step.supplied;
    step.damped = 0.5 * force.dot(velocity + step.velocity) + step.supplied;
    step.damped_first_half = 0.5 * force.dot(velocity) + step.supplied_first_half;
    return step;
  }

  void stop_fields(Eigen::VectorXd& velocity) const {
    const Constraints<dim>& constraints = solver_.constraints;
    velocity.segment(constraints.mechanical_unknowns(), constraints.field_unknowns()).setZero();
  }

  /// Spin of the continuum at the micro-rotations, over the time of a step: moments on them that hinder lag alone leave a body
  /// that turns as it is.
  [[nodiscard]] Eigen::VectorXd spin_of_last_step() const {
    return nodal_spin(solver_.problem, solver_.discretisation, solver_.constraints,
                      solver_.state.last_increment) /
           seconds_;
  }

  Inside& solver_;
  const ExplicitOptions& options_;
  const QuietBoundary<dim>* quiet_;
  double seconds_;
  StepReport& report_;
  DampingOfSteps damping_;
  BaseMotion<dim> base_;
  Eigen::VectorXd spin_;    ///< see spin_of_last_step
  Eigen::VectorXd forces_;  ///< out of balance, in the order of the equations
};

}  // namespace

template <int dim>
StepReport Solver<dim>::begin_explicit() {
  Implementation& self = *implementation_;
  self.refuse_explicit();
  self.materials.expect({.once = true});
  StepReport report;
  if (!self.start(report, true)) return report;
  self.withhold_imbalance();
  self.materials.settle();
  report.converged = true;
  return report;
}

template <int dim>
StepReport Solver<dim>::begin_automatic(int most_iterations, const ExplicitOptions& options) {
  Implementation& self = *implementation_;
  self.materials.expect({.once = false});
  StepReport report;
  const std::optional<Residual> residual = self.start(report, true);
  if (!residual) return report;
  // Of the tangents at rest: tangents of later states may be far softer than the next one.
  self.state.mass = masses_of_unknowns(self.constraints, self.stable_masses(options.safety));
  report.converged = self.is_balanced(*residual);
  if (!report.converged) report = self.let_go(std::move(report), most_iterations);
  if (report.converged) return report;
  report.given_up = report.iterations;
  report.converged = true;
  return report;
}

template <int dim>
bool Solver<dim>::Implementation::start_from_balance(const ExplicitOptions& options) {
  if (state.reactions.size() > 0) {  // the last row was explicit too
    if (state.velocity.size() != constraints.unknowns() || state.mass.size() != state.velocity.size())
      throw RunError("the checkpoint holds explicit steps of another problem");
    return false;
  }
  withhold_imbalance();
  if (state.mass.size() == 0)
    state.mass = masses_of_unknowns(constraints, this->stable_masses(options.safety));
  state.velocity = Eigen::VectorXd::Zero(constraints.unknowns());
  state.next_step = 0.0;
  steps_since_rest = 0;
  return true;
}

template <int dim>
void Solver<dim>::Implementation::tell_quarters(int step, int steps, const Residual& residual) const {
  if (observer && step % std::max(1, steps / 4) == 0)
    observer->iterated({state.time, 0, step, residual.force, residual.moment});
}

template <int dim>
void Solver<dim>::Implementation::count_ramp(int steps, int ramp, bool comes_to_rest) {
  // A ramp that is over stays over, even where the next row would have a longer one.
  const int since_rest = steps_since_rest + steps;
  steps_since_rest = comes_to_rest ? 0 : since_rest >= ramp ? kRampIsOver : since_rest;
}

template <int dim>
StepReport Solver<dim>::Implementation::end_row(StepReport report, const Eigen::VectorXd& reactions) {
  if (const Unrest unrest = this->materials.unrest(); unrest.points > 0) {
    const auto points = static_cast<double>(unrest.points);
    report.quasi_static.grains_unbalanced = unrest.sum / points;
    report.quasi_static.hot_points = static_cast<double>(unrest.hot) / points;
  }
  state.reactions = reactions;
  this->materials.settle();
  this->end_explicit_row();
  report.converged = true;
  report.substeps = 1;
  report.time = state.time;
  return report;
}

template <int dim>
StepReport Solver<dim>::Implementation::stopped(StepReport report, const std::string& where) {
  last_trouble = trouble(report.message, report);
  report.message = fmt::format("{}: {}", where, report.message);
  return report;
}

template <int dim>
StepReport Solver<dim>::advance_explicit(double time, int steps, const ExplicitOptions& options) {
  Implementation& self = *implementation_;
  self.refuse_explicit();
  SolverState<dim>& state = self.state;
  StepReport report;
  self.materials.expect({.once = true});
  const bool releases = self.start_from_balance(options);
  const double share = self.stable_share();
  const auto shorter = [share](int count) { return static_cast<int>(std::ceil(count / share)); };
  const int wave = shorter(self.steps_of_wave());
  const int ramp = options.ramp > 0 ? options.ramp : wave;
  const ExplicitPace pace(state.time, time, shorter(steps), ramp, self.steps_since_rest, options.speed_before,
                          wave);
  RowOfForces<dim> forces(self.constraints, pace.steps(), pace.last_times(2 * wave));
  ExplicitRow<dim, Implementation> row(self, options, nullptr, share, report);
  const auto stopped = [&] {
    return self.stopped(report,
                        fmt::format("explicit step {} of {}", report.explicit_steps + 1, pace.steps()));
  };
  Residual mean;
  double kinetic = 0.0;
  const bool went = row.follow(pace, releases, [&](int step) {
    const Residual residual = self.relative(self.last_unbalanced());
    mean.force += residual.force / pace.steps();
    mean.moment += residual.moment / pace.steps();
    self.tell_quarters(step, pace.steps(), residual);
    kinetic = std::max(kinetic, row.kinetic_energy());
    forces.add(self.last_supplied());
  });
  if (!went) return stopped();
  QuasiStatic& reached = report.quasi_static;
  if (state.internal_work != 0.0) reached.kinetic_share = kinetic / std::abs(state.internal_work);
  const bool comes_to_rest = options.rest > 0.0;
  if (comes_to_rest && !row.come_to_rest(time, mean)) return stopped();
  RowOfForces<dim> at_rest(self.constraints, 1, {});
  at_rest.add(self.last_supplied());
  const RowOfForces<dim>& last = comes_to_rest ? at_rest : forces;
  // Rest ends the waves. Points that yielded and unload as they end keep what that has changed.
  reached.reaction_difference =
      std::max(forces.difference(external_forces()), last.difference(external_forces()));
  reached.nodes_unbalanced = mean.force;
  report.force_residual = mean.force;
  report.moment_residual = mean.moment;
  self.count_ramp(pace.steps(), ramp, comes_to_rest);
  return self.end_row(std::move(report), last.reactions());
}

template <int dim>
int Solver<dim>::steps_of_wave() const {
  return state().mass.size() == 0 ? 0 : implementation_->steps_of_wave();
}

template <int dim>
void Solver<dim>::Implementation::release_quiet_boundary() {
  quiet.emplace(state.dashpots);
  constraints.release(quiet->entries(this->problem));
  quiet->join(constraints);
  this->loads.hold(state.held);
}

template <int dim>
StepReport Solver<dim>::begin_real_time(const ExplicitOptions& options) {
  Implementation& self = *implementation_;
  self.refuse_explicit();
  SolverState<dim>& state = self.state;
  self.materials.expect({.once = false});
  StepReport report;
  const std::optional<Residual> residual = self.start(report, true);
  if (!residual) return report;
  const std::vector<Response<dim>> at_rest = state.responses;
  report.converged = self.is_balanced(*residual);
  if (!report.converged) report = self.let_go(std::move(report), self.most_of_start());
  if (!report.converged) return report;
  const TrueMasses true_masses = self.real_masses(at_rest, options.safety);
  const QuietBoundary<dim> quiet(self.problem, self.discretisation, at_rest, self.densities());
  state.seconds = true_masses.seconds;
  state.dashpots = quiet.values();
  state.held = Eigen::VectorXd::Zero(state.displacement.size());
  const Eigen::VectorXd supplied = internal_forces() - external_forces();
  for (const std::size_t entry : quiet.entries(self.problem))
    if (!self.constraints.is_free(entry))
      state.held(static_cast<Eigen::Index>(entry)) = supplied(static_cast<Eigen::Index>(entry));
  self.release_quiet_boundary();
  state.mass = masses_of_unknowns(self.constraints, true_masses.masses);
  state.given_mass = Eigen::VectorXd::Zero(state.displacement.size());
  for (Eigen::Index entry = 0; entry < self.constraints.places().mechanics(); ++entry)
    if (!is_rotation(dof_at<dim>(entry)) && !self.constraints.is_free(static_cast<std::size_t>(entry)))
      state.given_mass(entry) = true_masses.masses(entry);
  state.energies = {.internal = state.internal_work, .external = state.external_work};
  return report;
}

template <int dim>
StepReport Solver<dim>::advance_real_time(double time, const ExplicitOptions& options) {
  Implementation& self = *implementation_;
  SolverState<dim>& state = self.state;
  if (!(state.seconds > 0.0)) throw RunError("steps in real time begin with begin_real_time");
  constexpr double kWithinRounding = 1.0 - 1e-9;
  const double start = state.time;
  const double stable = self.stable_share() * state.seconds;
  const auto steps = static_cast<int>(std::ceil(kWithinRounding * (time - start) / stable));
  const double seconds = (time - start) / std::max(1, steps);
  StepReport report;
  self.materials.expect({.once = true, .seconds = seconds});
  const bool releases = self.start_from_balance(options);
  const ExplicitPace pace(start, time, std::max(1, steps), 0, 0);
  RowOfForces<dim> forces(self.constraints, pace.steps(), {});
  ExplicitRow<dim, Implementation> row(self, options, &*self.quiet, seconds, report);
  const bool went = row.follow(pace, releases, [&](int step) {
    self.tell_quarters(step, pace.steps(), {});
    forces.add(self.last_supplied());
  });
  if (!went) {
    const int at = report.explicit_steps + 1;
    return self.stopped(std::move(report),
                        fmt::format("step {} of {}, at {:.6g} s", at, pace.steps(), pace.time(at)));
  }
  report.energies = row.energies();
  Eigen::VectorXd reactions = forces.reactions() + state.held;
  self.quiet->add_forces(self.constraints, row.velocity(), reactions);
  self.add_inertia_of_given(seconds, reactions, report.energies);
  return self.end_row(std::move(report), reactions);
}

// Differences to the back, of second order: behind its table a motion may go on otherwise.
template <int dim>
void Solver<dim>::Implementation::add_inertia_of_given(double seconds, Eigen::VectorXd& reactions,
                                                       Energies& energies) const {
  std::array<Eigen::VectorXd, 4> given;
  for (std::size_t k = 0; k < given.size(); ++k) {
    given[k] = state.displacement;
    constraints.apply(state.time - static_cast<double>(k) * seconds, given[k]);
  }
  const Eigen::VectorXd velocity = (1.5 * given[0] - 2.0 * given[1] + 0.5 * given[2]) / seconds;
  const Eigen::VectorXd acceleration =
      (2.0 * given[0] - 5.0 * given[1] + 4.0 * given[2] - given[3]) / (seconds * seconds);
  reactions += state.given_mass.cwiseProduct(acceleration);
  const double kinetic = 0.5 * velocity.cwiseAbs2().dot(state.given_mass);
  energies.kinetic += kinetic;
  energies.external += kinetic;
}

double Energies::error() const {
  constexpr double kAboveRounding = 1e-9;  // sums over a million of steps have 1e-13
  const double missing = external - internal - kinetic - damped - absorbed;
  const double largest = std::max(
      {std::abs(external), std::abs(internal), kinetic, damped, absorbed, kAboveRounding * at_start});
  return largest > 0.0 ? std::abs(missing) / largest : 0.0;
}

template void Solver<2>::Implementation::release_quiet_boundary();
template void Solver<3>::Implementation::release_quiet_boundary();
template void Solver<2>::Implementation::add_inertia_of_given(double, Eigen::VectorXd&, Energies&) const;
template void Solver<3>::Implementation::add_inertia_of_given(double, Eigen::VectorXd&, Energies&) const;
template StepReport Solver<2>::begin_real_time(const ExplicitOptions&);
template StepReport Solver<2>::advance_real_time(double, const ExplicitOptions&);
template StepReport Solver<3>::begin_real_time(const ExplicitOptions&);
template StepReport Solver<3>::advance_real_time(double, const ExplicitOptions&);
template int Solver<2>::steps_of_wave() const;
template int Solver<3>::steps_of_wave() const;
template StepReport Solver<2>::begin_explicit();
template StepReport Solver<2>::begin_automatic(int, const ExplicitOptions&);
template StepReport Solver<2>::advance_explicit(double, int, const ExplicitOptions&);
template StepReport Solver<3>::begin_explicit();
template StepReport Solver<3>::begin_automatic(int, const ExplicitOptions&);
template StepReport Solver<3>::advance_explicit(double, int, const ExplicitOptions&);

}  // namespace polargrain::fem
