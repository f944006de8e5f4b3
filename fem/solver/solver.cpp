// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/solver/solver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "common/error.hpp"
#include "common/packed_values.hpp"
#include "common/prefixed_archive.hpp"
#include "fem/element/dofs.hpp"
#include "fem/solver/jump_watch.hpp"
#include "fem/solver/left_out.hpp"
#include "fem/solver/solver_implementation.hpp"
#include "fem/solver/state_archive.hpp"
#include "fem/solver/substeps.hpp"

namespace polargrain::fem {
namespace {

/// Sum of the normal strains that a mesh of the dimension can have.
template <int dim>
double volumetric(const typename Cosserat<dim>::Vector& strain) {
  double sum = strain(Cosserat<dim>::stress_place(0, 0));
  for (int i = 1; i < dim; ++i) sum += strain(Cosserat<dim>::stress_place(i, i));
  return sum;
}

/// The largest change of a strain at any point.
template <class Strain>
double largest_change(const std::vector<Strain>& before, const std::vector<Strain>& now) {
  double largest = 0.0;
  for (std::size_t i = 0; i < now.size(); ++i) largest = std::max(largest, (now[i] - before[i]).norm());
  return largest;
}

}  // namespace

template <int dim>
void Solver<dim>::Implementation::tell_cut(double tried, const std::string& reason, double next,
                                           StepReport& report) {
  ++report.cuts;
  if (!observer) return;
  observer->cut(tried, reason, next);
  if (report.cuts == 2) observer->struggles(last_trouble);
}

template <int dim>
std::optional<Residual> Solver<dim>::Implementation::start(StepReport& report, bool at_rest) {
  report.time = state.time;
  Attempt begun = evaluate_initial_state(report);
  if (begun.converged && at_rest) begun = begin_at_rest();
  if (!begun.converged) {
    report.message = begun.reason;
    return {};
  }
  const Residual residual = initial_residual();
  report.force_residual = residual.force;
  report.moment_residual = residual.moment;
  return residual;
}

template <int dim>
Solver<dim>::Implementation::Passing Solver<dim>::Implementation::pass(StepGoal goal, double largest,
                                                                       StepReport& report) {
  const auto may_pass = [&](double most) {
    return report.jumps < options.most_jumps && best_residual() <= most;
  };
  if (!may_pass(largest) || !pass_jump(report).converged) {
    revert();
    return {};
  }
  Eigen::VectorXd moved = state.last_increment;
  if (goal.controls_time()) goal.time = state.time;
  goal.amount = 0.0;
  Substeps letting_go(2.0);
  Passing result{true, false, ""};
  while (!letting_go.arrived()) {
    if (goal.is_spent(report.iterations)) {
      result.stuck = true;
      result.reason = fmt::format("{} iterations are the bound of the step", report.iterations);
      break;
    }
    goal.jump_let_go = letting_go.end();
    const Attempt attempted = attempt(goal, letting_go.cuts_in_a_row(), report);
    if (attempted.converged) {
      moved += state.last_increment;
      letting_go.went();
      continue;
    }
    last_trouble = trouble(attempted.reason, report);
    revert();
    const bool last = letting_go.cuts_in_a_row() == options.most_cuts;
    if (may_pass(last ? HUGE_VAL : largest) && pass_jump(report).converged) {
      moved += state.last_increment;
      letting_go.begin_again();
      continue;
    }
    revert();
    if (last) {
      result.stuck = true;
      result.reason = attempted.reason;
      break;
    }
    letting_go.failed(attempted.step_factor);
    tell_cut(state.time, attempted.reason, state.time, report);
  }
  state.last_increment = moved;
  return result;
}

template <int dim>
template <class GoalAt>
StepReport Solver<dim>::Implementation::march(StepReport report, GoalAt goal_at, int most_iterations,
                                              double duration) {
  // Growth is slower than cutting, or a step that is just too long would be tried every other time.
  Substeps way(1.5, state.next_step);
  JumpWatch jumps;
  const std::vector<typename Cosserat<dim>::Vector> strain_before = state.strain;
  const auto given_up = [&](std::string why) {
    report.message = std::move(why);
    report.time = state.time;
    return report;
  };
  while (!way.arrived()) {
    if (duration > 0.0) way.limit(this->contributions.longest_step() / duration);
    StepGoal goal = goal_at(way.end(), way.share());
    goal.most_iterations = most_iterations;
    if (goal.is_spent(report.iterations))
      return given_up(fmt::format("{} iterations have brought it {:.0f} % of its way, and that is its bound",
                                  report.iterations, 100.0 * way.done()));
    const Attempt result = attempt(goal, way.cuts_in_a_row(), report);
    bool committed = result.converged;
    if (!committed) {
      last_trouble = trouble(result.reason, report);
      if (!report.force_residuals.empty()) {
        const Residual first{report.force_residuals.front(), report.moment_residuals.front()};
        jumps.failed(way.share(), first.force, excess(first));
      }
      last_trouble.jumps = jumps.seen();
      if (goal.is_spent(report.iterations)) {  // a jump that is passed now could not be let go
        revert();
        continue;
      }
      // Behind a jump at the very end of a step there would be no time in which water could flow.
      constexpr double kLeastTimeBehind = 0.05;
      const bool leaves_no_time = way.end() == 1.0 && way.share() > kLeastTimeBehind &&
                                  !this->contributions.depends_on_duration().empty();
      const double largest = leaves_no_time ? -1.0 : jumps.seen() ? HUGE_VAL : options.jump_residual;
      const Passing passing = pass(goal, largest, report);
      committed = passing.passed;
      if (passing.stuck)
        return given_up("a jump of the stresses was passed and cannot be balanced: " + passing.reason);
    }
    if (committed) {
      ++report.substeps;
      jumps.clear();
      way.went();
      state.next_step = way.next();
      continue;
    }
    if (way.cuts_in_a_row() == options.most_cuts)
      return given_up(fmt::format("the step was cut {} times in a row and still fails: {}{}",
                                  way.cuts_in_a_row(), result.reason, jumps.statement()));
    way.failed(result.step_factor);
    // Near the load that a body can bear, ever shorter parts go and fail in turn, and each that goes strains it on. At the very end
    // of a way back to zero parts may be as short, since fields are balanced against what is left of them.
    constexpr double kLeastShare = 1e-5;
    constexpr double kNearlyThere = 1e-3;
    constexpr int kManyCuts = 10;
    if (report.cuts > kManyCuts && this->contributions.longest_step() == HUGE_VAL &&
        ((way.next() < kLeastShare && 1.0 - way.done() > kNearlyThere) ||
         largest_change(strain_before, state.strain) > options.largest_strain)) {
      last_trouble.jumps = false;
      last_trouble.no_part_helps = true;
      state.next_step = 0.0;
      return given_up(fmt::format(
          "no balance beyond time {:.6g}, {:.4g} % of the way of this step: even {:.0e} of it fails ({}). Where a load grows, "
          "the body bears no more than what it has there: move a boundary in the place of the load, or let 'measure' or "
          "'arc_length' control the steps",
          state.time, 100.0 * way.done(), way.next(), result.reason));
    }
    state.next_step = way.next();
    const auto time_of = [&](const StepGoal& of) { return of.controls_time() ? of.time : state.time; };
    tell_cut(time_of(goal), result.reason, time_of(goal_at(way.end(), way.share())), report);
  }
  report.converged = true;
  report.time = state.time;
  return report;
}

template <int dim>
Solver<dim>::Solver(Problem<dim> problem, SolverOptions options)
    : implementation_(std::make_unique<Implementation>(std::move(problem), options)) {}
template <int dim>
Solver<dim>::~Solver() = default;

template <int dim>
void Solver<dim>::set_observer(Observer* observer) {
  implementation_->observer = observer;
}

template <int dim>
StepReport Solver<dim>::Implementation::let_go(StepReport report, int most_iterations) {
  withhold_imbalance();
  state.next_step = 0.0;
  report = march(
      std::move(report),
      [&](double end, double) {
        return StepGoal{.time = state.time, .measure = {}, .released = end, .releases_displacements = true};
      },
      most_iterations);
  state.next_step = 0.0;
  return report;
}

template <int dim>
bool Solver<dim>::Implementation::is_balanced(const Residual& residual) const {
  Eigen::VectorXd given = state.displacement;
  constraints.apply(state.time, given);
  return given == state.displacement && excess(residual) <= 1.0;
}

template <int dim>
StepReport Solver<dim>::redistribute() {
  StepReport report;
  implementation_->materials.expect({.once = false});
  report.time = state().time;
  if (const Attempt begun = implementation_->evaluate_initial_state(report); !begun.converged) {
    report.message = begun.reason;
    return report;
  }
  return implementation_->let_go(std::move(report), implementation_->most_of_start());
}

template <int dim>
StepReport Solver<dim>::equilibrate() {
  Implementation& self = *implementation_;
  self.materials.expect({.once = false});
  StepReport report;
  const std::optional<Residual> residual = self.start(report, true);
  if (!residual) return report;
  report.converged = self.is_balanced(*residual);
  return report.converged ? report : self.let_go(std::move(report), self.most_of_start());
}

template <int dim>
void Solver<dim>::begin_stage(int stage) {
  implementation_->begin_stage(stage);
}

template <int dim>
double Solver<dim>::tolerated_share_of_change() const {
  constexpr double kNothing = 1e-9;  // of all forces: rounding, and no tolerance would be met that sees it
  const double change = implementation_->forces_to_change();
  if (!(change > kNothing * state().reference_force)) return 0.0;
  return implementation_->options.force_tolerance * state().reference_force / change;
}

template <int dim>
void Solver<dim>::reset_displacements() {
  implementation_->state.shown_from = state().displacement;
}

template <int dim>
StepReport Solver<dim>::advance(double time, double released, int most_iterations) {
  implementation_->materials.expect({.once = false});
  const double start = state().time;
  const auto released_at = implementation_->releasing(released);
  return implementation_->march(
      {},
      [&](double end, double) {
        return StepGoal{.time = end == 1.0 ? time : start + end * (time - start),
                        .measure = {},
                        .released = released_at(end)};
      },
      most_iterations, time - start);
}

template <int dim>
StepReport Solver<dim>::advance_measure(const DisplacementMeasure& measure, double amount, double released) {
  Eigen::VectorXd vector = Eigen::VectorXd::Zero(state().displacement.size());
  const double sign = amount < 0.0 ? -1.0 : 1.0;
  for (const DisplacementMeasure::Term& term : measure.terms) {
    vector(entry_of<dim>(term.node, term.dof)) += sign * term.weight;
  }
  implementation_->refuse_unknown_time();
  const auto released_at = implementation_->releasing(released);
  return implementation_->march({}, [&](double end, double share) {
    return StepGoal{.measure = vector, .amount = share * std::abs(amount), .released = released_at(end)};
  });
}

template <int dim>
StepReport Solver<dim>::advance_arc_length(double length, double released) {
  if (state().last_increment.size() == 0) {
    throw RunError("arc-length control needs a first step under another control, to know its direction");
  }
  implementation_->refuse_unknown_time();
  const auto released_at = implementation_->releasing(released);
  const Eigen::Index mechanics = implementation_->constraints.places().mechanics();
  return implementation_->march({}, [&](double end, double share) {
    Eigen::VectorXd weighted = state().last_increment;
    weighted.tail(weighted.size() - mechanics).setZero();
    for (Eigen::Index entry = 0; entry < mechanics; ++entry) {
      if (is_rotation(dof_at<dim>(entry)))
        weighted(entry) *= implementation_->reference_length * implementation_->reference_length;
    }
    return StepGoal{.measure = weighted / std::sqrt(weighted.dot(state().last_increment)),
                    .amount = share * length,
                    .released = released_at(end)};
  });
}

template <int dim>
const Trouble& Solver<dim>::trouble() const {
  return implementation_->last_trouble;
}
template <int dim>
const Problem<dim>& Solver<dim>::problem() const {
  return implementation_->problem;
}
template <int dim>
const SolverState<dim>& Solver<dim>::state() const {
  return implementation_->state;
}
template <int dim>
void Solver<dim>::save(ArchiveWriter& archive) const {
  write_state(archive, state());
  const std::array<double, 1> since_rest{static_cast<double>(implementation_->steps_since_rest)};
  archive.write("explicit_steps_since_rest", std::span<const double>(since_rest));
  implementation_->save_stage(archive);
  PrefixedWriter body(archive, "body/");
  implementation_->save_body(body);
  PrefixedWriter materials(archive, "materials/");
  implementation_->materials.save(materials);
  PrefixedWriter contributions(archive, "contributions/");
  implementation_->contributions.save(contributions);
}
template <int dim>
void Solver<dim>::restore(ArchiveReader& archive) {
  Implementation& self = *implementation_;
  self.state = read_state<dim>(archive, self.constraints.places(), points(), !self.contributions.is_empty());
  self.steps_since_rest = static_cast<int>(read_lists(archive, "explicit_steps_since_rest", 1, 1)[0]);
  self.restore_stage(archive);
  PrefixedReader materials(archive, "materials/");
  self.materials.restore(materials);
  PrefixedReader contributions(archive, "contributions/");
  self.contributions.restore(contributions);
  if (self.state.seconds > 0.0) self.release_quiet_boundary();
  self.move_to_committed();
}

template <int dim>
std::size_t Solver<dim>::points() const {
  return implementation_->discretisation.points();
}
template <int dim>
int Solver<dim>::element_of_point(std::size_t point) const {
  return implementation_->discretisation.element_of_point(point);
}
template <int dim>
typename Cosserat<dim>::Place Solver<dim>::position_of_point(std::size_t point) const {
  return implementation_->discretisation.point(point).position;
}
template <int dim>
bool Solver<dim>::is_there(std::size_t point) const {
  return implementation_->discretisation.is_there(static_cast<std::size_t>(element_of_point(point)));
}
template <int dim>
Eigen::VectorXd Solver<dim>::shown_displacement() const {
  if (state().shown_from.size() == 0) return state().displacement;
  return state().displacement - state().shown_from;
}
template <int dim>
double Solver<dim>::volume_of_point(std::size_t point) const {
  return implementation_->discretisation.point(point).volume;
}
template <int dim>
std::pair<const Material<dim>*, std::size_t> Solver<dim>::material_of_point(std::size_t point) const {
  return implementation_->materials.at(point);
}

template <int dim>
Eigen::VectorXd Solver<dim>::internal_forces() const {
  return implementation_->committed_internal_forces();
}
template <int dim>
Eigen::VectorXd Solver<dim>::external_forces() const {
  return implementation_->loads.at(state().time);
}

template <int dim>
typename Cosserat<dim>::NodeValues Solver<dim>::reaction(const std::vector<std::string>& on) const {
  const Eigen::VectorXd supplied =
      state().reactions.size() > 0 ? state().reactions : internal_forces() - external_forces();
  // A quiet boundary pushes on nodes that are free; elsewhere these have no reaction.
  const Eigen::VectorXd& quiet = state().reactions.size() > 0 ? state().reactions : state().held;
  typename Cosserat<dim>::NodeValues sum = Cosserat<dim>::NodeValues::Zero();
  std::vector<char> is_on(problem().mesh.nodes.size(), 0);
  for (const int node : problem().mesh.nodes_on(on)) {
    is_on[static_cast<std::size_t>(node)] = 1;
    for (const Dof dof : node_dofs<dim>()) {
      const int entry = entry_of<dim>(node, dof);
      if (!implementation_->constraints.is_free(static_cast<std::size_t>(entry)))
        sum(place_of<dim>(dof)) += supplied(entry);
      else if (quiet.size() > 0)
        sum(place_of<dim>(dof)) += quiet(entry);
    }
  }
  const auto mechanics = static_cast<std::size_t>(implementation_->constraints.places().mechanics());
  for (const auto& [entry, giver] : implementation_->constraints.carried()) {
    if (giver >= mechanics || is_on[giver / Cosserat<dim>::dofs] == 0 ||
        is_on[entry / Cosserat<dim>::dofs] != 0)
      continue;
    sum(place_of<dim>(dof_at<dim>(entry))) += supplied(static_cast<Eigen::Index>(entry));
  }
  return sum;
}

namespace {

/// Nodes of places whose elements are there. Where all elements have gone, all nodes count.
template <int dim>
std::vector<int> nodes_there(const Problem<dim>& problem, int stage, const std::vector<std::string>& on) {
  std::vector<int> nodes = problem.mesh.nodes_on(on);
  const std::vector<char> there = elements_in_stage(problem, stage);
  if (there.empty()) return nodes;
  const std::vector<char> left = nodes_in_stage(problem.mesh, there);
  const auto is_left = [&](int node) { return left[static_cast<std::size_t>(node)] != 0; };
  if (std::ranges::any_of(nodes, is_left)) std::erase_if(nodes, [&](int node) { return !is_left(node); });
  return nodes;
}

}  // namespace

template <int dim>
typename Cosserat<dim>::NodeValues Solver<dim>::mean_displacement(const std::vector<std::string>& on) const {
  const std::vector<int> nodes = nodes_there(problem(), state().stage, on);
  const Eigen::VectorXd shown = shown_displacement();
  typename Cosserat<dim>::NodeValues sum = Cosserat<dim>::NodeValues::Zero();
  for (const int node : nodes) sum += shown.template segment<Cosserat<dim>::dofs>(entry_of<dim>(node));
  return sum / static_cast<double>(nodes.size());
}

template <int dim>
double Solver<dim>::mean_field(std::size_t field, const std::vector<std::string>& on) const {
  double sum = 0.0;
  int count = 0;
  for (const int node : nodes_there(problem(), state().stage, on)) {
    const int entry = implementation_->constraints.places().entry(field, node);
    if (entry < 0) continue;
    sum += state().displacement(entry);
    ++count;
  }
  return sum / count;
}

template <int dim>
double Solver<dim>::field_reaction(std::size_t field, const std::vector<std::string>& on) const {
  double sum = 0.0;
  for (const int node : problem().mesh.nodes_on(on)) {
    const int entry = implementation_->constraints.places().entry(field, node);
    if (entry >= 0 && !implementation_->constraints.is_free(static_cast<std::size_t>(entry)))
      sum += state().contributed(entry);
  }
  return sum;
}

template <int dim>
double Solver<dim>::volume_strain() const {
  double volume = 0.0;
  double change = 0.0;
  for (std::size_t i = 0; i < points(); ++i) {
    if (!is_there(i)) continue;
    volume += volume_of_point(i);
    change += volume_of_point(i) * volumetric<dim>(state().strain[i]);
  }
  return change / volume;
}

template <int dim>
std::string Solver<dim>::left_out() const {
  if (problem().deformation == Deformation::large) return {};
  return left_out_by_small_deformation(implementation_->discretisation, state().displacement,
                                       state().placed_with);
}

template <int dim>
bool Solver<dim>::has_lost_stability() const {
  return implementation_->has_lost_stability();
}

template <int dim>
bool Solver<dim>::has_lost_stability_at_end() {
  implementation_->watch_last_state();
  return implementation_->has_lost_stability();
}

template class Solver<2>;
template class Solver<3>;

}  // namespace polargrain::fem
