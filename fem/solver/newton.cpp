// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/solver/newton.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "common/elementary_functions.hpp"
#include "common/error.hpp"
#include "fem/material/rotation.hpp"
#include "fem/mesh/box_around.hpp"
#include "fem/solver/equation_scaling.hpp"
#include "fem/solver/free_rotations.hpp"
#include "fem/solver/residual_floor.hpp"
#include "fem/solver/stabilisation.hpp"
#include "fem/solver/stopwatch.hpp"
#include "fem/solver/why_singular.hpp"

namespace polargrain::fem {
namespace {

template <int dim>
Problem<dim> checked(Problem<dim> problem) {
  if (const auto messages = faults(problem); !messages.empty()) {
    throw RunError(fmt::format("the problem cannot be solved: {}", fmt::join(messages, "; ")));
  }
  return problem;
}

/// With the springs that elements with one integration point need, unless it brings its own.
template <int dim>
Problem<dim> stabilised(Problem<dim> problem) {
  for (const auto& contribution : problem.contributions)
    if (dynamic_cast<const Stabilisation<dim>*>(contribution.get()) != nullptr) return problem;
  if (auto springs = Stabilisation<dim>::of(problem.mesh, problem.continuum, problem.deformation))
    problem.contributions.push_back(std::move(springs));
  return problem;
}

template <int dim>
Eigen::Index field_entries(const Problem<dim>& problem) {
  const FieldPlaces<dim> places = problem.places();
  return places.size() - places.mechanics();
}

template <int dim>
double mean_element_size(const Discretisation<dim>& discretisation) {
  double volume = 0.0;
  for (std::size_t i = 0; i < discretisation.points(); ++i) volume += discretisation.point(i).volume;
  const double mean = volume / static_cast<double>(discretisation.elements());
  return dim == 2 ? std::sqrt(mean) : power(mean, 1.0 / 3.0);
}

}  // namespace

template <int dim>
Newton<dim>::Newton(Problem<dim> problem_in, const SolverOptions& options_in)
    : problem(stabilised(checked(std::move(problem_in)))),
      options(options_in),
      discretisation(problem.mesh, problem.continuum, field_entries(problem)),
      constraints(problem),
      loads(problem),
      materials(problem, discretisation),
      contributions(problem),
      reference_length(options.reference_length > 0.0
                           ? options.reference_length
                           : materials.moment_length(mean_element_size(discretisation))),
      body_size_(box_around(problem.mesh).sides().norm()),
      tangent_(discretisation, constraints, problem.contributions),
      linear_solver_(coarse_space<dim>(problem.mesh, constraints)),
      anderson_(options.acceleration_depth, reference_length, dim, constraints.places().mechanics()),
      start_(problem.mesh, problem.continuum, field_entries(problem)),
      trial_(discretisation.points()) {
  state.displacement = Eigen::VectorXd::Zero(discretisation.nodal_size());
  for (std::size_t k = 0; k < problem.fields.size(); ++k) {
    const std::vector<double>& initial = problem.fields[k].initial;
    std::copy(initial.begin(), initial.end(), state.displacement.begin() + constraints.places().start(k));
  }
  const bool contributions_come = std::ranges::any_of(
      problem.contributions, [](const auto& contribution) { return !contribution->life.is_whole(); });
  if (!problem.lifetimes.empty() || contributions_come) enter_stage();
  state.strain.assign(discretisation.points(), Cosserat<dim>::Vector::Zero());
  state.responses.resize(discretisation.points());
  if (problem.deformation == Deformation::large && !materials.can_turn())
    throw RunError("a material cannot turn its stress, as large deformation needs");
}

template <int dim>
Attempt Newton<dim>::evaluate_initial_state(StepReport& report) {
  {
    const Stopwatch watch(report.material_seconds);
    increments_.assign(discretisation.points(), Increment<dim>{});
    materials.evaluate(increments_, trial_);
    report.evaluations += static_cast<long>(trial_.size());
  }
  if (const Response<dim>& worst = worst_response(); worst.quality != Quality::good) {
    materials.revert();
    return {false, "the initial state of a material is not usable: " + worst.message};
  }
  if (problem.continuum == Continuum::cosserat) {
    if (std::string message = unresisted_rotation<dim>(problem.mesh, discretisation, constraints, trial_);
        !message.empty()) {
      materials.revert();
      return {false, std::move(message)};
    }
  }
  if (const std::string message = contribute_at_rest(trial_); !message.empty()) {
    materials.revert();
    contributions.revert();
    return {false, "the initial state is not usable: " + message};
  }
  // The increments were zero, so the initial state itself is committed.
  materials.commit();
  state.responses = trial_;
  return {true, ""};
}

template <int dim>
Residual Newton<dim>::initial_residual() {
  const Eigen::VectorXd unbalanced = loads.at(state.time) - committed_internal_forces();
  state.reference_force = options.reference_force;
  if (state.reference_force == 0.0) {
    state.reference_force = loads.largest_force() + sum_of_reactions(unbalanced, constraints);
  }
  return relative(unbalanced);
}

template <int dim>
Eigen::VectorXd Newton<dim>::committed_internal_forces() const {
  Eigen::VectorXd forces = discretisation.internal_forces(state.responses);
  if (state.contributed.size() > 0) forces += state.contributed;
  return forces;
}

template <int dim>
std::string Newton<dim>::contribute(double time, const Eigen::VectorXd& increment) {
  return contributions.evaluate({state.time, time, state.displacement, increment}, contributed_);
}

template <int dim>
void Newton<dim>::refuse_explicit() const {
  for (const auto& contribution : problem.contributions)
    if (!contribution->takes_explicit_steps())
      throw RunError("explicit steps do not take " + contribution->name() +
                     " yet; balance the steps by iterations instead");
}

template <int dim>
void Newton<dim>::refuse_unknown_time() const {
  const std::string name = contributions.depends_on_duration();
  if (name.empty()) return;
  throw RunError(name +
                 " needs steps of a given duration: control the time, not a measure of the displacements");
}

template <int dim>
void Newton<dim>::withhold_imbalance() {
  withheld_ = loads.at(state.time) - committed_internal_forces();
  released_ = 0.0;
  jump_let_go_ = 1.0;  // the imbalance of a jump is in it
}

template <int dim>
Eigen::VectorXd Newton<dim>::loads_at(double time, double released, double jump_let_go) const {
  Eigen::VectorXd forces = loads.at(time);
  if (released < 1.0) forces -= (1.0 - released) * withheld_;
  if (jump_let_go < 1.0) forces -= (1.0 - jump_let_go) * jump_;
  return forces;
}

template <int dim>
Linearisation<dim> Newton<dim>::linearised(const std::vector<Response<dim>>& answers) const {
  if (problem.deformation == Deformation::small) return {answers};
  return {answers, typename Linearisation<dim>::Moving{start_, increments_}};
}

template <int dim>
Residual Newton<dim>::relative(const Eigen::VectorXd& forces) const {
  return measure(constraints.folded(forces), constraints, state.reference_force, reference_length);
}

template <int dim>
double Newton<dim>::excess(const Residual& residual) const {
  double excess =
      std::max(residual.force / options.force_tolerance, residual.moment / options.moment_tolerance);
  for (std::size_t k = 0; k < residual.fields.size(); ++k)
    excess = std::max(excess, residual.fields[k] / problem.fields[k].tolerance);
  return excess;
}

template <int dim>
const Response<dim>& Newton<dim>::worst_response() const {
  return *std::min_element(trial_.begin(), trial_.end(), [](const Response<dim>& a, const Response<dim>& b) {
    return a.quality != b.quality ? a.quality < b.quality : a.step_factor < b.step_factor;
  });
}

template <int dim>
void Newton<dim>::revert() {
  materials.revert();
  contributions.revert();
  move_to_committed();
}

template <int dim>
void Newton<dim>::move_to_committed() {
  if (problem.deformation == Deformation::small) return;
  (void)discretisation.move_to(state.displacement);  // it was committed, so no element is inside out
  (void)start_.move_to(state.displacement);
  increments_.assign(discretisation.points(), Increment<dim>{});
  loads.move_to(state.displacement);
}

template <int dim>
void Newton<dim>::find_increments(const Eigen::VectorXd& displacement_increment) {
  refusal_.clear();
  if (problem.deformation == Deformation::small) {
    increments_ = discretisation.increments(displacement_increment);
    return;
  }
  refusal_ = discretisation.move_to(state.displacement + displacement_increment);
  if (!refusal_.empty()) return;
  loads.move_to(state.displacement + displacement_increment);
  increments_ = start_.increments_to(discretisation, displacement_increment);
}

template <int dim>
void Newton<dim>::ask_materials(const Iterate& iterate, StepReport& report) {
  const Stopwatch watch(report.material_seconds);
  find_increments(iterate.displacement);
  if (!refusal_.empty()) return;
  contributions.prepare({state.time, iterate.time, state.displacement, iterate.displacement});
  materials.evaluate(increments_, trial_);
  report.evaluations += static_cast<long>(trial_.size());
}

template <int dim>
void Newton<dim>::evaluate(Iterate& iterate, StepReport& report) {
  ask_materials(iterate, report);
  const Stopwatch watch(report.assembly_seconds);
  if (refusal_.empty() && !contributions.is_empty())
    refusal_ = contribute(iterate.time, iterate.displacement);
  if (!refusal_.empty()) {
    trial_.front().quality = Quality::failed;
    trial_.front().message = refusal_;
    trial_.front().step_factor = 0.5;
    iterate.residual = {HUGE_VAL, HUGE_VAL};
    return;
  }
  iterate.unbalanced =
      loads_at(iterate.time, iterate.released, iterate.jump_let_go) - discretisation.internal_forces(trial_);
  if (!contributions.is_empty()) iterate.unbalanced -= contributed_.internal;
  if (state.reference_force == 0.0) state.reference_force = sum_of_reactions(iterate.unbalanced, constraints);
  iterate.residual = relative(iterate.unbalanced);
  if (!problem.fields.empty())
    iterate.residual.fields =
        measure_fields(constraints.folded(iterate.unbalanced), contributed_.parts, constraints);
  unbalanced_ = iterate.unbalanced;
}

template <int dim>
bool Newton<dim>::factorise(const std::vector<Response<dim>>& responses, double time, StepReport& report) {
  const Eigen::SparseMatrix<double>* matrix = nullptr;
  {
    const Stopwatch watch(report.assembly_seconds);
    matrix = &tangent_.assemble(linearised(responses), loads.stiffness(time));
  }
  const Stopwatch watch(report.solve_seconds);
  if (problem.fields.empty()) return linear_solver_.factorise(*matrix);
  scaling_ = equation_scaling(*matrix, constraints.mechanical_unknowns());
  return linear_solver_.factorise(scaling_.asDiagonal() * *matrix * scaling_.asDiagonal());
}

template <int dim>
Eigen::VectorXd Newton<dim>::solved(const Eigen::VectorXd& forces) const {
  if (scaling_.size() == 0) return linear_solver_.solve(forces);
  return scaling_.cwiseProduct(linear_solver_.solve(scaling_.cwiseProduct(forces)));
}

template <int dim>
bool Newton<dim>::correction(const StepGoal& goal, const Iterate& iterate,
                             const std::vector<Response<dim>>& responses, const Eigen::VectorXd& right_side,
                             Correction& change, StepReport& report) {
  if (!factorise(responses, iterate.time, report)) {
    tell_of_solver();
    return false;
  }
  const Stopwatch watch(report.solve_seconds);
  const auto add_solution = [&](const Eigen::VectorXd& forces, Eigen::VectorXd& nodal) {
    constraints.add_free(solved(constraints.restrict_to_free(forces)), nodal);
  };
  Eigen::VectorXd per_time;
  if (!goal.controls_time()) {
    // Bordered system: the response to a unit of time, times the time that brings the measure to its goal.
    per_time = constraints.slope(iterate.time);
    Eigen::VectorXd forces = loads.slope(iterate.time) + loads.linearised(iterate.time, per_time) -
                             discretisation.linearised_forces(linearised(responses), per_time);
    if (!contributions.is_empty()) forces -= contributions.linearised_forces(per_time);
    add_solution(forces, per_time);
  }
  const auto respond = [&](const Eigen::VectorXd& forces, double growth) {
    Correction response{Eigen::VectorXd::Zero(state.displacement.size()), 0.0};
    add_solution(forces, response.displacement);
    if (!goal.controls_time()) {
      response.time = (growth - goal.measure.dot(response.displacement)) / goal.measure.dot(per_time);
      response.displacement += response.time * per_time;
    }
    return response;
  };
  const double missing = goal.controls_time() ? 0.0 : goal.amount - goal.measure.dot(iterate.displacement);
  change = respond(right_side, missing);
  if (!converges_fast_) {
    anderson_.accelerate(change, [&](const Eigen::VectorXd& forces) { return respond(forces, 0.0); });
  }
  tell_of_solver();
  return change.displacement.allFinite() && std::isfinite(change.time);
}

template <int dim>
bool Newton<dim>::tells_stability() const {
  return problem.deformation == Deformation::large && problem.fields.empty() &&
         // Jumps of grains turn the sign too.
         forces_of_noise<dim>(discretisation, problem.continuum, state.responses).size() == 0;
}

template <int dim>
void Newton<dim>::watch_stability(const StepGoal& goal) {
  if (!goal.controls_time() || !tells_stability()) return;
  const int sign = linear_solver_.sign_of_determinant();
  if (first_sign_ == 0) first_sign_ = sign;
  has_lost_stability_ = has_lost_stability_ || (sign != 0 && sign != first_sign_);
}

template <int dim>
void Newton<dim>::watch_last_state() {
  // Without a first sign there is nothing to compare with, and a large system need not be factorised.
  if (!is_balanced_at_time_ || first_sign_ == 0 || !tells_stability()) return;
  move_to_committed();
  linear_solver_.begin_step();
  if (!contributions.is_empty()) {
    contributions.learn(discretisation, state.responses);
    (void)contribute(state.time, Eigen::VectorXd::Zero(state.displacement.size()));
  }
  StepReport of_no_step;
  const int sign =
      factorise(state.responses, state.time, of_no_step) ? linear_solver_.sign_of_determinant() : 0;
  has_lost_stability_ = has_lost_stability_ || (sign != 0 && sign != first_sign_);
  contributions.revert();
}

template <int dim>
void Newton<dim>::tell_of_solver() {
  if (const std::string news = linear_solver_.news(); observer && !news.empty()) observer->solves(news);
}

template <int dim>
void Newton<dim>::move(Iterate& iterate, const Correction& change, double fraction, StepReport& report) {
  iterate.time += fraction * change.time;
  iterate.displacement += fraction * change.displacement;
  evaluate(iterate, report);
}

template <int dim>
void Newton<dim>::line_search(Iterate& iterate, const Correction& change, double excess_before,
                              StepReport& report) {
  double fraction = 1.0;
  double best_fraction = 1.0;
  double best = excess(iterate.residual);
  for (int halving = 0; halving < options.most_line_search_halvings && best > excess_before; ++halving) {
    move(iterate, change, -0.5 * fraction, report);
    fraction *= 0.5;
    if (worst_response().quality == Quality::failed || !(excess(iterate.residual) < best)) continue;
    best = excess(iterate.residual);
    best_fraction = fraction;
  }
  if (best_fraction != fraction) move(iterate, change, best_fraction - fraction, report);
}

template <int dim>
Newton<dim>::Iterate Newton<dim>::start_of(const StepGoal& goal) const {
  Iterate iterate{goal.controls_time() ? goal.time : state.time,
                  goal.released,
                  goal.jump_let_go,
                  state.displacement,
                  {},
                  {}};
  constraints.apply(iterate.time, iterate.displacement, iterate.released);
  if (turns_rotations())
    turn_given(goal, iterate.displacement);
  else
    iterate.displacement -= state.displacement;
  if (goal.releases_displacements && released_ < 1.0)
    iterate.displacement *= (goal.released - released_) / (1.0 - released_);
  return iterate;
}

template <int dim>
void Newton<dim>::remember(const Iterate& iterate) {
  if (!anderson_.is_on()) return;
  const auto free_part = [&](const Eigen::VectorXd& forces) {
    Eigen::VectorXd nodal = constraints.folded(forces);
    for (Eigen::Index entry = 0; entry < nodal.size(); ++entry) {
      if (!constraints.is_free(static_cast<std::size_t>(entry))) nodal(entry) = 0.0;
    }
    return nodal;
  };
  const Eigen::VectorXd noise = forces_of_noise<dim>(discretisation, problem.continuum, trial_);
  anderson_.remember({iterate.displacement, iterate.time}, free_part(iterate.unbalanced),
                     noise.size() > 0 ? free_part(noise) : noise);
}

template <int dim>
std::string Newton<dim>::residual_text(const Residual& residual) const {
  std::string text = fmt::format("{:.3g} (force), {:.3g} (moment)", residual.force, residual.moment);
  for (std::size_t k = 0; k < residual.fields.size(); ++k)
    text += fmt::format(", {:.3g} ({})", residual.fields[k], problem.fields[k].name);
  const Eigen::VectorXd noise = forces_of_noise<dim>(discretisation, problem.continuum, trial_);
  if (noise.size() == 0) return text;
  const Residual floor = relative(noise);
  return text + fmt::format("; the noise of the stresses alone leaves about {:.3g} and {:.3g}", floor.force,
                            floor.moment);
}

template <int dim>
Newton<dim>::Predictor Newton<dim>::predict(const StepGoal& goal) {
  move_to_committed();
  linear_solver_.begin_step();
  unbalanced_.resize(0);
  anderson_.clear();
  internal_before_ = discretisation.internal_forces(state.responses);
  loads_before_ = loads_at(state.time, released_, jump_let_go_);
  // The consistent predictor: given increments go through the last converged tangent. Moving the boundary
  // alone would strain the elements next to it only and localise there (docs/theory.md, G.6).
  Iterate iterate = start_of(goal);
  Eigen::VectorXd right_side =
      loads_at(iterate.time, iterate.released, iterate.jump_let_go) - internal_before_ +
      loads.linearised(iterate.time, iterate.displacement) -
      discretisation.linearised_forces(linearised(state.responses), iterate.displacement);
  if (!contributions.is_empty()) predict_contributions(iterate, right_side);
  return {std::move(iterate), std::move(right_side)};
}

// Given increments go through the tangent of the contributions at the committed state too.
template <int dim>
void Newton<dim>::predict_contributions(const Iterate& iterate, Eigen::VectorXd& right_side) {
  const Eigen::VectorXd nothing = Eigen::VectorXd::Zero(state.displacement.size());
  contributions.learn(discretisation, state.responses);
  (void)contribute(iterate.time, nothing);  // the first iterate meets again what it cannot answer
  right_side -= contributed_.internal + contributions.linearised_forces(iterate.displacement);
  internal_before_ += state.contributed;
}

template <int dim>
Attempt Newton<dim>::attempt(const StepGoal& goal, int cuts, StepReport& report) {
  constexpr double kFast = 0.1;  // a true tangent at work: nothing to accelerate
  report.force_residuals.clear();
  report.moment_residuals.clear();
  auto [iterate, right_side] = predict(goal);
  Correction change;
  best_.reset();
  StagnationWatch watch(options.stagnation_window);
  // Where a jump may be passed at once, further iterations from the same state find other samples of the jumps, and nothing better.
  StagnationWatch jump_watch((options.stagnation_window + 1) / 2);
  const int most = goal.most_iterations > 0
                       ? std::min(options.most_iterations, goal.most_iterations - report.iterations)
                       : options.most_iterations;
  for (int iteration = 1; iteration <= most; ++iteration) {
    const bool predictor = iteration == 1;
    const std::vector<Response<dim>>& known = predictor ? state.responses : trial_;
    if (!correction(goal, iterate, known, right_side, change, report))
      return {false, why_singular<dim>(known)};
    if (predictor) watch_stability(goal);
    const Attempt limited = predictor ? limit_predictor(goal, iterate, change, report)
                                      : limit_correction(iterate, change, report);
    if (!limited.converged) return limited;
    if (predictor) turn_predictor(iterate, change);
    const double excess_before = excess(iterate.residual);
    move(iterate, change, 1.0, report);
    ++report.iterations;
    const bool failed = worst_response().quality == Quality::failed;
    if (!predictor && !failed && excess(iterate.residual) > excess_before) {
      line_search(iterate, change, excess_before, report);
    }
    right_side = iterate.unbalanced;
    converges_fast_ = excess(iterate.residual) < kFast * excess_before;

    const Response<dim>& worst = worst_response();
    if (worst.quality == Quality::failed) {
      return {false, (refusal_.empty() ? "a material failed: " : "") + worst.message, worst.step_factor};
    }
    const Residual& residual = iterate.residual;
    report.force_residuals.push_back(residual.force);
    report.moment_residuals.push_back(residual.moment);
    if (observer)
      observer->iterated({iterate.time, cuts, iteration, residual.force, residual.moment, residual.fields});
    remember(iterate);
    if (worst.quality == Quality::good && residual.force < best_residual()) best_ = iterate;
    const bool finite = std::isfinite(residual.force + residual.moment);
    const bool passable = report.jumps < options.most_jumps && best_residual() <= options.jump_residual;
    const bool stands_still = watch.stagnates(excess(residual));
    const bool samples_jumps = jump_watch.stagnates(excess(residual));
    const bool stagnates = stands_still || (samples_jumps && passable);
    const bool last_chance = !finite || stagnates || iteration == most;
    if (const Balance balance = balance_of(iterate, last_chance); balance != Balance::none) {
      if (worst.quality != Quality::good) {
        return {false, "a material's answer is unreliable: " + worst.message, worst.step_factor};
      }
      if (!materials.confirm()) {
        // Other answers from here on: the history of the former ones is void.
        evaluate(iterate, report);
        if (const Response<dim>& again = worst_response(); again.quality == Quality::failed)
          return {false, "a material failed: " + again.message, again.step_factor};
        right_side = iterate.unbalanced;
        anderson_.clear();
        watch = StagnationWatch(options.stagnation_window);
        jump_watch = StagnationWatch((options.stagnation_window + 1) / 2);
        continue;
      }
      commit(iterate, balance, report);
      is_balanced_at_time_ = goal.controls_time();
      return {true, ""};
    }
    if (!finite) return {false, "the residual is not finite"};
    if (stagnates) return {false, "the residual stagnates at " + residual_text(residual)};
  }
  return {false, fmt::format("no balance after {} iterations, the residual is {}", most,
                             residual_text(iterate.residual))};
}

template <int dim>
void Newton<dim>::commit(const Iterate& iterate, Balance balance, StepReport& report) {
  report.force_residual = iterate.residual.force;
  report.moment_residual = iterate.residual.moment;
  report.field_residuals = iterate.residual.fields;
  report.within_noise += balance == Balance::within_noise ? 1 : 0;
  report.within_rounding += balance == Balance::within_rounding ? 1 : 0;
  if (const auto noise = forces_of_noise<dim>(discretisation, problem.continuum, trial_); noise.size() > 0) {
    const Residual floor = relative(noise);
    report.force_noise = floor.force;
    report.moment_noise = floor.moment;
  }
  const Eigen::VectorXd loads_mean =
      0.5 * (loads_before_ + loads_at(iterate.time, iterate.released, iterate.jump_let_go));
  Eigen::VectorXd internal_mean = 0.5 * (internal_before_ + discretisation.internal_forces(trial_));
  if (!contributions.is_empty()) internal_mean += 0.5 * contributed_.internal;
  Eigen::VectorXd contributed_mean;
  if (!contributions.is_empty()) contributed_mean = 0.5 * (state.contributed + contributed_.internal);
  const auto add_work = [&](Eigen::Index begin, Eigen::Index end) {
    for (Eigen::Index entry = begin; entry < end; ++entry) {
      // At given entries the support supplies what the loads do not: together the internal force.
      const bool free = constraints.is_free(static_cast<std::size_t>(entry));
      state.external_work += (free ? loads_mean(entry) : internal_mean(entry)) * iterate.displacement(entry);
      if (contributed_mean.size() > 0)
        state.internal_work += contributed_mean(entry) * iterate.displacement(entry);
    }
  };
  const FieldPlaces<dim>& places = constraints.places();
  add_work(0, places.mechanics());
  for (std::size_t k = 0; k < problem.fields.size(); ++k)
    if (problem.fields[k].is_motion) add_work(places.start(k), places.start(k + 1));
  const double from_outside = contributions.work_from_outside();
  state.external_work += from_outside;
  state.internal_work += from_outside;
  for (std::size_t i = 0; i < trial_.size(); ++i) {
    add_to_strain_and_work(i);
  }
  materials.commit();
  if (!contributions.is_empty()) {
    contributions.commit();
    state.contributed = contributed_.internal;
  }
  state.responses = trial_;
  if (turns_rotations())
    add_step(iterate);
  else
    state.displacement += iterate.displacement;
  state.last_increment = iterate.displacement;
  state.time = iterate.time;
  is_balanced_at_time_ = false;
  released_ = iterate.released;
  jump_let_go_ = iterate.jump_let_go;
  state.reactions.resize(0);
}

template <int dim>
void Newton<dim>::add_to_strain_and_work(std::size_t point) {
  const Increment<dim>& increment = increments_[point];
  const typename Cosserat<dim>::Vector before = state.responses[point].stress;
  const typename Cosserat<dim>::Vector after = trial_[point].stress;
  const double volume = discretisation.point(point).volume;
  if (increment.configuration == Configuration::fixed) {
    const typename Cosserat<dim>::Vector strain = increment.strain();
    state.internal_work += volume * 0.5 * (before + after).dot(strain);
    state.strain[point] += strain;
    return;
  }
  // The strain turns with the material as the stress does; the work is that of the stretch, in the axes of the start.
  const StretchAndTurn<dim> step = stretch_and_turn(increment);
  const typename Cosserat<dim>::Vector strain = step.stretch.strain();
  const double mean_volume = 0.5 * (start_.point(point).volume + volume);
  state.internal_work += mean_volume * 0.5 * (before + rotated(after, inverse(step.turn))).dot(strain);
  state.strain[point] = rotated(typename Cosserat<dim>::Vector(state.strain[point] + strain), step.turn);
}

template class Newton<2>;
template class Newton<3>;

}  // namespace polargrain::fem
