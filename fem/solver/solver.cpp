// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/solver/solver.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

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
#include "fem/solver/explicit_pace.hpp"
#include "fem/solver/jump_watch.hpp"
#include "fem/solver/left_out.hpp"
#include "fem/solver/nearest_states.hpp"
#include "fem/solver/newton.hpp"
#include "fem/solver/state_archive.hpp"
#include "fem/solver/substeps.hpp"

namespace polargrain::fem {
namespace {

constexpr int kRampIsOver = 1 << 30;  // explicit steps since rest, more than any ramp has

}  // namespace

namespace {

/// Sum of the normal strains that a mesh of the dimension can have.
template <int dim>
double volumetric(const typename Cosserat<dim>::Vector& strain) {
  double sum = strain(Cosserat<dim>::stress_place(0, 0));
  for (int i = 1; i < dim; ++i) sum += strain(Cosserat<dim>::stress_place(i, i));
  return sum;
}

}  // namespace

template <int dim>
struct Solver<dim>::Implementation : Newton<dim> {
  using Newton<dim>::Newton;
  using Newton<dim>::attempt;
  using Newton<dim>::best_residual;
  using Newton<dim>::evaluate_initial_state;
  using Newton<dim>::excess;
  using Newton<dim>::initial_residual;
  using Newton<dim>::observer;
  using Newton<dim>::options;
  using Newton<dim>::pass_jump;
  using Newton<dim>::revert;
  using Newton<dim>::state;
  using Newton<dim>::trouble;

  Trouble last_trouble;      ///< of the last attempt that failed
  int steps_since_rest = 0;  ///< explicit ones, as far as they count for a ramp

  /// Goes the whole of a step in substeps, cut where an attempt fails. Shares of the step, not times or
  /// lengths, are what is cut, so that a step under another control may follow.
  /// @param goal_at the goal that lies at a share of the way: (share at its end, share of the substep).
  /// @param most_iterations that it may take, lost ones too; 0: as many as it needs
  template <class GoalAt>
  StepReport march(StepReport report, GoalAt goal_at, int most_iterations = 0);

  /// Share of the forces held back that is let go at a share of the way from here to where `goal` of them are.
  [[nodiscard]] auto releasing(double goal) const {
    return [from = this->released(), goal](double end) {
      return end == 1.0 ? goal : from + end * (goal - from);
    };
  }

  [[nodiscard]] PointsOfRun<dim> points_of_run() const {
    PointsOfRun<dim> points{{}, this->materials.materials_of_points()};
    for (std::size_t i = 0; i < this->discretisation.points(); ++i)
      points.places.push_back(this->discretisation.point(i).position);
    return points;
  }

  /// Holds back the imbalance of the committed state, and the displacements given then, and lets them go in shares.
  StepReport let_go(StepReport report);

  /// A way was cut: counted and told. @param tried, next times, as Observer::cut has them
  void tell_cut(double tried, const std::string& reason, double next, StepReport& report);

  /// Evaluates the initial state. @returns its residual, which is in the report too; nothing, with a message there, where a
  /// material cannot begin
  std::optional<Residual> start(StepReport& report);

  /// The outcome of a jump.
  struct Passing {
    bool passed = false;  ///< else nothing was committed
    bool stuck = false;   ///< what was committed cannot be balanced
    std::string reason;   ///< why it is stuck
  };
  /// Passes the jump that the last attempt has met, when it may and the jump is not larger than `largest`, and lets go
  /// at the place reached what is out of balance then; further jumps on the way too.
  /// @param goal what was aimed at
  Passing pass(StepGoal goal, double largest, StepReport& report);
};

template <int dim>
void Solver<dim>::Implementation::tell_cut(double tried, const std::string& reason, double next,
                                           StepReport& report) {
  ++report.cuts;
  if (!observer) return;
  observer->cut(tried, reason, next);
  if (report.cuts == 2) observer->struggles(last_trouble);
}

template <int dim>
std::optional<Residual> Solver<dim>::Implementation::start(StepReport& report) {
  report.time = state.time;
  if (const Attempt begun = evaluate_initial_state(report); !begun.converged) {
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
StepReport Solver<dim>::Implementation::march(StepReport report, GoalAt goal_at, int most_iterations) {
  // Growth is slower than cutting, or a step that is just too long would be tried every other time.
  Substeps way(1.5, state.next_step);
  JumpWatch jumps;
  const auto given_up = [&](std::string why) {
    report.message = std::move(why);
    report.time = state.time;
    return report;
  };
  while (!way.arrived()) {
    if (most_iterations > 0 && report.iterations >= most_iterations)
      return given_up(fmt::format("{} iterations have brought it {:.0f} % of its way, and that is its bound",
                                  report.iterations, 100.0 * way.done()));
    const StepGoal goal = goal_at(way.end(), way.share());
    const Attempt result = attempt(goal, way.cuts_in_a_row(), report);
    bool committed = result.converged;
    if (!committed) {
      last_trouble = trouble(result.reason, report);
      if (!report.force_residuals.empty()) {
        const Residual first{report.force_residuals.front(), report.moment_residuals.front()};
        jumps.failed(way.share(), first.force, excess(first));
      }
      last_trouble.jumps = jumps.seen();
      const Passing passing = pass(goal, jumps.seen() ? HUGE_VAL : options.jump_residual, report);
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
StepReport Solver<dim>::Implementation::let_go(StepReport report) {
  this->withhold_imbalance();
  // The imbalance of the stress at time zero and the loads is no step of the user's: no shorter one helps.
  constexpr int kMostTries = 10;
  state.next_step = 0.0;
  report = march(
      std::move(report),
      [&](double end, double) {
        return StepGoal{.time = state.time, .measure = {}, .released = end, .releases_displacements = true};
      },
      kMostTries * options.most_iterations);
  state.next_step = 0.0;
  return report;
}

template <int dim>
StepReport Solver<dim>::redistribute() {
  StepReport report;
  report.time = state().time;
  if (const Attempt begun = implementation_->evaluate_initial_state(report); !begun.converged) {
    report.message = begun.reason;
    return report;
  }
  if (state().reference_force == 0.0) (void)implementation_->initial_residual();
  return implementation_->let_go(std::move(report));
}

template <int dim>
StepReport Solver<dim>::start_from(ArchiveReader& end, const std::vector<std::string>& regions_of_end) {
  Implementation& self = *implementation_;
  const PointsOfRun<dim> before = read_points<dim>(end);
  const PointsOfRun<dim> now = self.points_of_run();
  std::size_t material = 0;
  for (const auto& [region, unused] : problem().materials) {
    const auto found = std::ranges::find(regions_of_end, region);
    if (found == regions_of_end.end())
      throw RunError(
          fmt::format("it has no region '{}'; it has {}", region, fmt::join(regions_of_end, ", ")));
    const auto number = static_cast<std::size_t>(found - regions_of_end.begin());
    const auto places_in = [](const PointsOfRun<dim>& points, std::size_t of) {
      std::vector<typename Cosserat<dim>::Place> places;
      for (std::size_t i = 0; i < points.places.size(); ++i)
        if (points.materials[i] == of) places.push_back(points.places[i]);
      return places;
    };
    const auto among = places_in(before, number);
    if (among.empty()) throw RunError(fmt::format("its region '{}' has no points", region));
    const std::vector<std::size_t> from = nearest_places<dim>(places_in(now, material), among);
    PrefixedReader own(end, fmt::format("materials/{}/", number));
    GatheringReader gathering(own, among.size(), from);
    self.materials.restore(material++, gathering);
  }
  return redistribute();
}

template <int dim>
StepReport Solver<dim>::equilibrate() {
  Implementation& self = *implementation_;
  StepReport report;
  const std::optional<Residual> residual = self.start(report);
  if (!residual) return report;
  Eigen::VectorXd given = self.state.displacement;
  self.constraints.apply(self.state.time, given);
  report.converged = given == self.state.displacement && self.excess(*residual) <= 1.0;
  if (report.converged) return report;
  return self.let_go(std::move(report));
}

template <int dim>
void Solver<dim>::begin_stage(int stage) {
  implementation_->begin_stage(stage);
}

template <int dim>
void Solver<dim>::reset_displacements() {
  implementation_->state.shown_from = state().displacement;
}

template <int dim>
StepReport Solver<dim>::advance(double time, double released) {
  const double start = state().time;
  const auto released_at = implementation_->releasing(released);
  return implementation_->march({}, [&](double end, double) {
    return StepGoal{.time = end == 1.0 ? time : start + end * (time - start),
                    .measure = {},
                    .released = released_at(end)};
  });
}

template <int dim>
StepReport Solver<dim>::advance_measure(const DisplacementMeasure& measure, double amount, double released) {
  Eigen::VectorXd vector = Eigen::VectorXd::Zero(state().displacement.size());
  const double sign = amount < 0.0 ? -1.0 : 1.0;
  for (const DisplacementMeasure::Term& term : measure.terms) {
    vector(entry_of<dim>(term.node, term.dof)) += sign * term.weight;
  }
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
  const auto released_at = implementation_->releasing(released);
  return implementation_->march({}, [&](double end, double share) {
    Eigen::VectorXd weighted = state().last_increment;
    for (Eigen::Index entry = 0; entry < weighted.size(); ++entry) {
      if (is_rotation(dof_at<dim>(entry)))
        weighted(entry) *= implementation_->reference_length * implementation_->reference_length;
    }
    return StepGoal{.measure = weighted / std::sqrt(weighted.dot(state().last_increment)),
                    .amount = share * length,
                    .released = released_at(end)};
  });
}

template <int dim>
StepReport Solver<dim>::begin_explicit() {
  Implementation& self = *implementation_;
  StepReport report;
  if (!self.start(report)) return report;
  self.withhold_imbalance();
  self.materials.settle();
  report.converged = true;
  return report;
}

template <int dim>
StepReport Solver<dim>::advance_explicit(double time, int steps, const ExplicitOptions& options) {
  Implementation& self = *implementation_;
  SolverState<dim>& state = self.state;
  StepReport report;
  const bool first = state.velocity.size() == 0;
  if (first) {
    // A run that goes on from behind its begin has its state, and nothing is held back yet.
    if (!self.withholds()) self.withhold_imbalance();
    state.mass = self.constraints.restrict_to_free(self.stable_masses(options.safety));
    state.velocity = Eigen::VectorXd::Zero(self.constraints.unknowns());
  } else if (state.velocity.size() != self.constraints.unknowns() ||
             state.mass.size() != state.velocity.size()) {
    throw RunError("the checkpoint holds explicit steps of another problem");
  }
  const int wave = self.steps_of_wave();
  const int ramp = options.ramp > 0 ? options.ramp : wave;
  const ExplicitPace pace(state.time, time, steps, ramp, self.steps_since_rest);
  const Eigen::VectorXd damping = damping_of_rotations(self.problem, self.constraints, options);
  RowOfForces<dim> row(self.constraints, pace.steps(), pace.last_times(2 * wave));
  Eigen::VectorXd forces = self.constraints.restrict_to_free(self.unbalanced());
  Residual sum;
  double kinetic = 0.0;
  // @returns whether it could be taken; the report says why not
  const auto step_to = [&](double end, double released) {
    state.velocity =
        ((1.0 - 0.5 * damping.array()) * state.velocity.array() + forces.array() / state.mass.array()) /
        (1.0 + 0.5 * damping.array());
    const Attempt went = self.go_on(end, released, state.velocity, report);
    if (!went.converged) {
      self.last_trouble = self.trouble(went.reason, report);
      report.message =
          fmt::format("explicit step {} of {}: {}", report.explicit_steps + 1, pace.steps(), went.reason);
      report.time = state.time;
      return false;
    }
    ++report.explicit_steps;
    forces = self.constraints.restrict_to_free(self.last_unbalanced());
    return true;
  };
  for (int step = 1; step <= pace.steps(); ++step) {
    if (!step_to(pace.time(step), first ? pace.fraction(step) : self.released())) return report;
    const Residual residual = self.relative(self.last_unbalanced());
    sum.force += residual.force / pace.steps();
    sum.moment += residual.moment / pace.steps();
    if (self.observer && (step % std::max(1, pace.steps() / 4) == 0))
      self.observer->iterated({state.time, 0, step, residual.force, residual.moment});
    kinetic = std::max(kinetic, 0.5 * state.velocity.cwiseAbs2().dot(state.mass));
    row.add(self.last_supplied());
  }
  QuasiStatic& reached = report.quasi_static;
  if (state.internal_work != 0.0) reached.kinetic_share = kinetic / std::abs(state.internal_work);
  reached.reaction_difference = row.difference(external_forces());
  Eigen::VectorXd reactions = row.reactions();
  if (options.rest > 0.0) {
    // Kinetic damping (Cundall 1976): the nodes stop whenever they are fastest, which is where they pass their balance.
    double before = 0.0;
    sum = self.relative(self.last_unbalanced());
    while (sum.force > options.rest && report.rest_steps < options.most_rest_steps) {
      if (!step_to(time, self.released())) return report;
      ++report.rest_steps;
      sum = self.relative(self.last_unbalanced());
      const double energy = 0.5 * state.velocity.cwiseAbs2().dot(state.mass);
      // Half a step back, so that the next velocity is that of half a step from where they stop: whole ones would
      // drive the fastest waves.
      if (energy < before) state.velocity = -0.5 * forces.cwiseQuotient(state.mass);
      before = energy < before ? 0.0 : energy;
    }
    state.velocity.setZero();
    RowOfForces<dim> at_rest(self.constraints, 1, {});
    at_rest.add(self.last_supplied());
    reactions = at_rest.reactions();
    reached.reaction_difference = at_rest.difference(external_forces());
  }
  reached.nodes_unbalanced = sum.force;
  if (const Unrest unrest = self.materials.unrest(); unrest.points > 0) {
    reached.grains_unbalanced = unrest.sum / static_cast<double>(unrest.points);
    reached.hot_points = static_cast<double>(unrest.hot) / static_cast<double>(unrest.points);
  }
  // A ramp that is over stays over, even where the next row would have a longer one.
  self.steps_since_rest = options.rest > 0.0 ? 0
                          : self.steps_since_rest + pace.steps() >= ramp
                              ? kRampIsOver
                              : self.steps_since_rest + pace.steps();
  state.reactions = reactions;
  self.materials.settle();
  report.converged = true;
  report.substeps = 1;
  report.time = state.time;
  report.force_residual = sum.force;
  report.moment_residual = sum.moment;
  return report;
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
  if (!problem().stages.empty()) implementation_->save_stage(archive);
  write_points(archive, implementation_->points_of_run());
  PrefixedWriter materials(archive, "materials/");
  implementation_->materials.save(materials);
}
template <int dim>
void Solver<dim>::restore(ArchiveReader& archive) {
  Implementation& self = *implementation_;
  self.state = read_state<dim>(archive, problem().mesh.nodes.size(), points());
  self.steps_since_rest = static_cast<int>(read_lists(archive, "explicit_steps_since_rest", 1, 1)[0]);
  if (!problem().stages.empty()) self.restore_stage(archive);
  PrefixedReader materials(archive, "materials/");
  self.materials.restore(materials);
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
  return implementation_->discretisation.internal_forces(state().responses);
}
template <int dim>
Eigen::VectorXd Solver<dim>::external_forces() const {
  return implementation_->loads.at(state().time);
}

template <int dim>
typename Cosserat<dim>::NodeValues Solver<dim>::reaction(const std::vector<std::string>& on) const {
  const Eigen::VectorXd supplied =
      state().reactions.size() > 0 ? state().reactions : internal_forces() - external_forces();
  typename Cosserat<dim>::NodeValues sum = Cosserat<dim>::NodeValues::Zero();
  for (const int node : problem().mesh.nodes_on(on)) {
    for (const Dof dof : node_dofs<dim>()) {
      const int entry = entry_of<dim>(node, dof);
      if (!implementation_->constraints.is_free(static_cast<std::size_t>(entry)))
        sum(place_of<dim>(dof)) += supplied(entry);
    }
  }
  return sum;
}

template <int dim>
typename Cosserat<dim>::NodeValues Solver<dim>::mean_displacement(const std::vector<std::string>& on) const {
  std::vector<int> nodes = problem().mesh.nodes_on(on);
  if (const std::vector<char> there = elements_in_stage(problem(), state().stage); !there.empty()) {
    const std::vector<char> has_element = nodes_of_elements(problem().mesh, there);
    const auto is_left = [&](int node) { return has_element[static_cast<std::size_t>(node)] != 0; };
    if (std::ranges::any_of(nodes, is_left)) std::erase_if(nodes, [&](int node) { return !is_left(node); });
  }
  const Eigen::VectorXd shown = shown_displacement();
  typename Cosserat<dim>::NodeValues sum = Cosserat<dim>::NodeValues::Zero();
  for (const int node : nodes) sum += shown.template segment<Cosserat<dim>::dofs>(entry_of<dim>(node));
  return sum / static_cast<double>(nodes.size());
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
  return left_out_by_small_deformation(implementation_->discretisation, state().displacement);
}

template class Solver<2>;
template class Solver<3>;

}  // namespace polargrain::fem
