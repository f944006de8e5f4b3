// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <optional>
#include <string>

#include "fem/solver/end_of_run.hpp"
#include "fem/solver/newton.hpp"
#include "fem/solver/quiet_boundary.hpp"
#include "fem/solver/recovery.hpp"
#include "fem/solver/solver.hpp"

namespace polargrain::fem {

/// The inside of a Solver: solver.cpp has its iterations, solver_explicit.cpp its explicit steps.
template <int dim>
struct Solver<dim>::Implementation : Newton<dim> {
  using Newton<dim>::Newton;
  using Newton<dim>::constraints;
  using Newton<dim>::contributions;
  using Newton<dim>::discretisation;
  using Newton<dim>::loads;
  using Newton<dim>::materials;
  using Newton<dim>::observer;
  using Newton<dim>::options;
  using Newton<dim>::problem;
  using Newton<dim>::reference_length;
  using Newton<dim>::state;
  // Found without this->, as the parts above.
  using Newton<dim>::attempt;
  using Newton<dim>::begin_at_rest;
  using Newton<dim>::best_residual;
  using Newton<dim>::evaluate_initial_state;
  using Newton<dim>::excess;
  using Newton<dim>::initial_residual;
  using Newton<dim>::pass_jump;
  using Newton<dim>::revert;
  using Newton<dim>::trouble;
  using Newton<dim>::withhold_imbalance;

  Trouble last_trouble;      ///< of the last attempt that failed
  int steps_since_rest = 0;  ///< explicit ones, as far as they count for a ramp

  std::optional<QuietBoundary<dim>> quiet;  ///< in real time, where there is one

  /// Lets quiet boundaries go, as the state has them.
  void release_quiet_boundary();

  /// Goes the whole of a step in substeps, cut where an attempt fails. Shares of the step, not times or
  /// lengths, are what is cut, so that a step under another control may follow.
  /// @param goal_at the goal that lies at a share of the way: (share at its end, share of the substep).
  /// @param most_iterations that it may take, lost ones too; 0: as many as it needs
  /// @param duration of the way, which contributions may limit parts of; 0: they do not
  template <class GoalAt>
  StepReport march(StepReport report, GoalAt goal_at, int most_iterations = 0, double duration = 0.0);

  /// Share of the forces held back that is let go at a share of the way from here to where `goal` of them are.
  [[nodiscard]] auto releasing(double goal) const {
    return [from = this->released(), goal](double end) {
      return end == 1.0 ? goal : from + end * (goal - from);
    };
  }

  /// Holds back the imbalance of the committed state, and the displacements given then, and lets them go in shares.
  StepReport let_go(StepReport report, int most_iterations);
  /// Iterations for that at the start: the imbalance of the stress at time zero and the loads is no step of the user's, and no
  /// shorter one helps.
  [[nodiscard]] int most_of_start() const {
    constexpr int kMostTries = 10;
    return kMostTries * options.most_iterations;
  }
  /// Whether the start, with this residual and the displacements given then, is in balance.
  [[nodiscard]] bool is_balanced(const Residual& residual) const;

  /// The body as another run needs it that starts from here (EndOfRun).
  void save_body(ArchiveWriter& archive) const;
  /// Displacements and micro-rotations of another run by its shape functions.
  void take_displacements(const EndOfRun<dim>& end, const Eigen::VectorXd& of_end,
                          const Recovery<dim>& recovery);

  /// Before a row of explicit steps: where the step before was not explicit, the nodes are at rest, and forces out of balance are held
  /// back. @returns whether they are, for this row to let them go. @throws RunError when the state is of another problem
  bool start_from_balance(const ExplicitOptions& options);

  /// Four times a row of explicit steps the observer is told where it stands. @param step of so many `steps`
  void tell_quarters(int step, int steps, const Residual& residual) const;
  /// Behind a row of `steps`: how much of a ramp of so many steps is behind. @param comes_to_rest a new ramp follows
  void count_ramp(int steps, int ramp, bool comes_to_rest);
  /// In real time nodes that the case moves have mass too: adds its inertia to the reactions and its energy to what is put in and to
  /// the kinetic one. @param seconds of the last steps
  void add_inertia_of_given(double seconds, Eigen::VectorXd& reactions, Energies& energies) const;
  /// The end of a row of explicit steps: boxes are read out, and the report says that it was reached.
  StepReport end_row(StepReport report, const Eigen::VectorXd& reactions);
  /// A row that could not go on, for the reason in the report. @param where the step of it
  StepReport stopped(StepReport report, const std::string& where);

  /// A way was cut: counted and told. @param tried, next times, as Observer::cut has them
  void tell_cut(double tried, const std::string& reason, double next, StepReport& report);

  /// Evaluates the initial state. @param at_rest no other run was before (Newton::begin_at_rest)
  /// @returns its residual, which is in the report too; nothing, with a message there, where a material cannot begin
  std::optional<Residual> start(StepReport& report, bool at_rest);

  /// The outcome of a jump.
  struct Passing {
    bool passed = false;  ///< else nothing was committed
    bool stuck = false;   ///< the state committed cannot be balanced
    std::string reason;   ///< why it is stuck
  };
  /// Passes the jump that the last attempt has met, when it may and the jump is not larger than `largest`, and lets go
  /// of the forces out of balance at the place reached; further jumps on the way too.
  /// @param goal the aim of the step @param largest force residual that a jump may leave; negative: it may not be passed
  Passing pass(StepGoal goal, double largest, StepReport& report);
};

}  // namespace polargrain::fem
