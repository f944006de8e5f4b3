// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/solver/solver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/error.hpp"
#include "common/prefixed_archive.hpp"
#include "fem/solver/newton.hpp"
#include "fem/solver/state_archive.hpp"

namespace polargrain::fem {

struct Solver::Implementation : Newton {
  using Newton::Newton;

  /// Goes from 0 to `total` in substeps, cut where an attempt fails.
  /// @param goal_at the goal that lies at a share of the way: (done, step) -> StepGoal.
  template <class GoalAt>
  StepReport march(double total, GoalAt goal_at);
};

template <class GoalAt>
StepReport Solver::Implementation::march(double total, GoalAt goal_at) {
  // Growth is slower than cutting, or a step that is just too long would be tried every other time.
  constexpr double kGrowth = 1.5;
  constexpr double kNearlyAll = 1.0 - 1e-6;
  StepReport report;
  double done = 0.0;
  int cuts_in_a_row = 0;
  while (done < total) {
    const bool cut = state.next_step > 0.0 && state.next_step < kNearlyAll * (total - done);
    const double step = cut ? state.next_step : total - done;
    const StepGoal goal = goal_at(cut ? done + step : total, step);
    const Attempt result = attempt(goal, cuts_in_a_row, report);
    if (result.converged) {
      ++report.substeps;
      cuts_in_a_row = 0;
      done = cut ? done + step : total;
      if (state.next_step > 0.0) state.next_step = std::max(state.next_step, kGrowth * step);
      continue;
    }
    revert();
    if (cuts_in_a_row == options.most_cuts) {
      report.message =
          fmt::format("the step was cut {} times in a row and still fails: {}", cuts_in_a_row, result.reason);
      report.time = state.time;
      return report;
    }
    ++cuts_in_a_row;
    ++report.cuts;
    state.next_step = step * std::clamp(result.step_factor, 0.1, 0.5);
    if (observer) {
      const bool controls_time = goal.controls_time();
      observer->cut(controls_time ? goal.time : state.time, result.reason,
                    state.time + (controls_time ? state.next_step : 0.0));
    }
  }
  report.converged = true;
  report.time = state.time;
  return report;
}

Solver::Solver(Problem problem, SolverOptions options)
    : implementation_(std::make_unique<Implementation>(std::move(problem), options)) {}
Solver::~Solver() = default;

void Solver::set_observer(Observer* observer) {
  implementation_->observer = observer;
}

StepReport Solver::equilibrate() {
  Implementation& self = *implementation_;
  StepReport report;
  Attempt result = self.evaluate_initial_state(report);
  if (result.converged) {
    const Residual residual = self.initial_residual();
    report.force_residual = residual.force;
    report.moment_residual = residual.moment;
    Eigen::VectorXd given = self.state.displacement;
    self.constraints.apply(self.state.time, given);
    if (given != self.state.displacement || self.excess(residual) > 1.0) {
      result = self.attempt({.time = self.state.time, .measure = {}}, 0, report);
      if (!result.converged) self.revert();
      report.substeps = 1;
    }
  }
  report.converged = result.converged;
  report.message = result.reason;
  report.time = self.state.time;
  return report;
}

StepReport Solver::advance(double time) {
  const double start = state().time;
  const double total = time - start;
  return implementation_->march(total, [&](double done, double) {
    return StepGoal{.time = done == total ? time : start + done, .measure = {}};
  });
}

StepReport Solver::advance_measure(const DisplacementMeasure& measure, double amount) {
  Eigen::VectorXd vector = Eigen::VectorXd::Zero(state().displacement.size());
  const double sign = amount < 0.0 ? -1.0 : 1.0;
  for (const DisplacementMeasure::Term& term : measure.terms) {
    vector(3 * term.node + static_cast<int>(term.dof)) += sign * term.weight;
  }
  return implementation_->march(
      std::abs(amount), [&](double, double step) { return StepGoal{.measure = vector, .amount = step}; });
}

StepReport Solver::advance_arc_length(double length) {
  if (state().last_increment.size() == 0) {
    throw RunError("arc-length control needs a first step under another control, to know its direction");
  }
  return implementation_->march(length, [&](double, double step) {
    Eigen::VectorXd weighted = state().last_increment;
    for (Eigen::Index w = 2; w < weighted.size(); w += 3) {
      weighted(w) *= implementation_->reference_length * implementation_->reference_length;
    }
    return StepGoal{.measure = weighted / std::sqrt(weighted.dot(state().last_increment)), .amount = step};
  });
}

const Problem& Solver::problem() const {
  return implementation_->problem;
}
const SolverState& Solver::state() const {
  return implementation_->state;
}
void Solver::save(ArchiveWriter& archive) const {
  write_state(archive, state());
  PrefixedWriter materials(archive, "materials/");
  implementation_->materials.save(materials);
}
void Solver::restore(ArchiveReader& archive) {
  Implementation& self = *implementation_;
  self.state = read_state(archive, problem().mesh.nodes.size(), points());
  PrefixedReader materials(archive, "materials/");
  self.materials.restore(materials);
  self.move_to_committed();
}

std::size_t Solver::points() const {
  return implementation_->discretisation.points();
}
int Solver::element_of_point(std::size_t point) const {
  return implementation_->discretisation.element_of_point(point);
}
Eigen::Vector2d Solver::position_of_point(std::size_t point) const {
  return implementation_->discretisation.point(point).position;
}
double Solver::volume_of_point(std::size_t point) const {
  return implementation_->discretisation.point(point).volume;
}
std::pair<const Material*, std::size_t> Solver::material_of_point(std::size_t point) const {
  return implementation_->materials.at(point);
}

Eigen::VectorXd Solver::internal_forces() const {
  return implementation_->discretisation.internal_forces(state().responses);
}
Eigen::VectorXd Solver::external_forces() const {
  return implementation_->loads.at(state().time);
}

Eigen::Vector3d Solver::reaction(const std::string& on) const {
  const Eigen::VectorXd supplied = internal_forces() - external_forces();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const int node : problem().mesh.nodes_on(on)) {
    for (int component = 0; component < 3; ++component) {
      const int entry = 3 * node + component;
      if (!implementation_->constraints.is_free(static_cast<std::size_t>(entry)))
        sum(component) += supplied(entry);
    }
  }
  return sum;
}

Eigen::Vector3d Solver::mean_displacement(const std::string& on) const {
  const std::vector<int> nodes = problem().mesh.nodes_on(on);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const int node : nodes) sum += state().displacement.segment<3>(3 * node);
  return sum / static_cast<double>(nodes.size());
}

double Solver::volume_strain() const {
  double volume = 0.0;
  double change = 0.0;
  for (std::size_t i = 0; i < points(); ++i) {
    volume += volume_of_point(i);
    change += volume_of_point(i) * (state().strain[i](k11) + state().strain[i](k22));
  }
  return change / volume;
}

}  // namespace polargrain::fem
