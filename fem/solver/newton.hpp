// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "fem/solver/anderson.hpp"
#include "fem/solver/constraints.hpp"
#include "fem/solver/contributions.hpp"
#include "fem/solver/discretisation.hpp"
#include "fem/solver/field_balance.hpp"
#include "fem/solver/linear_solver.hpp"
#include "fem/solver/loads.hpp"
#include "fem/solver/nodal_masses.hpp"
#include "fem/solver/point_materials.hpp"
#include "fem/solver/residual.hpp"
#include "fem/solver/solver.hpp"
#include "fem/solver/tangent_matrix.hpp"

namespace polargrain::fem {

/// The target of a step: a loading time, or a growth of a linear measure of the displacements.
struct StepGoal {
  double time = 0.0;        ///< used when `measure` is empty
  Eigen::VectorXd measure;  ///< nodal vector: the measure is its product with the displacements
  double amount = 0.0;      ///< by which the measure grows in this step
  /// Share, at the end of the step, of the forces that equilibrate() lets go: displacements given at time 0 and nodal
  /// forces that are out of balance then.
  double released = 1.0;
  bool releases_displacements = false;  ///< the given displacements too, not only the forces
  double jump_let_go =
      1.0;  ///< share of the imbalance left behind by a jump (Newton::pass_jump) let go at the end
  /// That the whole step may take, lost ones too (StepReport::iterations); 0: no bound but that of an attempt.
  int most_iterations = 0;

  [[nodiscard]] bool controls_time() const { return measure.size() == 0; }
  /// Whether so many iterations leave no further one.
  [[nodiscard]] bool is_spent(int iterations) const {
    return most_iterations > 0 && iterations >= most_iterations;
  }
};

/// The outcome of one attempt at a step.
struct Attempt {
  bool converged = false;
  std::string reason;        ///< why not
  double step_factor = 0.5;  ///< of the step that should be tried instead
};

/// Newton iterations for one step of a problem, from the committed state. Keeps that state, changes it only
/// by committing a step that has met its tolerances.
template <int dim>
class Newton {
 public:
  /// @throws RunError when the problem has faults.
  Newton(Problem<dim> problem, const SolverOptions& options);

  /// Evaluates all materials with increments of zero and commits their answer as the initial state.
  [[nodiscard]] Attempt evaluate_initial_state(StepReport& report);
  /// Behind that, where no other run was before: contributions begin with the stress of the ground beside them.
  [[nodiscard]] Attempt begin_at_rest();
  /// Residual of the committed state against the loads of its own time; fixes the reference force.
  [[nodiscard]] Residual initial_residual();
  /// Holds back the imbalance of the committed state until steps release it (StepGoal::released).
  void withhold_imbalance();
  /// Goes over to a stage of construction: elements, supports and loads of it, and the imbalance of all that changes held
  /// back. @throws RunError where the nodes have moved so that an element that comes is inside out, or nothing resists a
  /// micro-rotation of what is there
  void begin_stage(int stage);
  /// Sum of the nodal forces that the steps to come let go or change, N/m; zero where movements are given, as nobody knows
  /// the forces that they need.
  [[nodiscard]] double forces_to_change() const;
  /// The stage and the forces held back in it, for checkpoints.
  void save_stage(ArchiveWriter& archive) const;
  void restore_stage(ArchiveReader& archive);
  /// From now on given displacements count from where the nodes are.
  void count_supports_from_here();
  /// One attempt; commits when it converges, leaves the committed state alone when not.
  [[nodiscard]] Attempt attempt(const StepGoal& goal, int cuts, StepReport& report);
  /// Largest force residual that the best iterate of the last attempt has; infinite without an iterate to commit.
  [[nodiscard]] double best_residual() const { return best_ ? best_->residual.force : HUGE_VAL; }
  /// Commits the best iterate of the last attempt although it is out of balance: the stresses jump there. The imbalance
  /// is held by fictive forces until attempts let it go (StepGoal::jump_let_go). Leaves the committed state
  /// alone when a material does not stand by its answer.
  [[nodiscard]] Attempt pass_jump(StepReport& report);
  /// Moves the free nodal values by `moved` (in the order of the equations), the given ones to `time`, evaluates and commits,
  /// in balance or not: an explicit step. @param released see StepGoal
  [[nodiscard]] Attempt go_on(double time, double released, const Eigen::VectorXd& moved, StepReport& report);
  /// Behind a row of explicit steps: the next one has the bits of a run that goes on from here.
  void end_explicit_row() { field_balance_.forget(); }
  /// Loads less internal forces of the committed state.
  [[nodiscard]] Eigen::VectorXd unbalanced() const;
  /// The same of the last evaluation, which go_on has committed.
  [[nodiscard]] const Eigen::VectorXd& last_unbalanced() const { return unbalanced_; }
  /// Internal forces less loads of the same, without forces that are held back at the start.
  [[nodiscard]] Eigen::VectorXd last_supplied() const;
  /// Steps that a wave of compression needs through the mesh there and back, with the masses of the state.
  [[nodiscard]] int steps_of_wave() const;
  /// A stable step over the one that was stable at first: 1 until an element is squeezed so much that the reserve of
  /// ExplicitOptions::safety is half used up.
  [[nodiscard]] double stable_share();
  /// nodal_masses of the committed state.
  [[nodiscard]] Eigen::VectorXd stable_masses(double safety);
  /// true_masses by these answers, on the mesh of the committed state.
  [[nodiscard]] TrueMasses real_masses(const std::vector<Response<dim>>& answers, double safety);
  /// Of each element, by Problem::densities. @throws RunError where a region has no density
  [[nodiscard]] std::vector<double> densities() const;
  /// Share that committed steps have let go of the forces held back at the start.
  [[nodiscard]] double released() const { return released_; }
  /// Where the attempt that has just failed was out of balance; to be asked before revert().
  [[nodiscard]] Trouble trouble(const std::string& reason, const StepReport& report) const;
  /// Large deformation under given loads or movements, laws alone: whether the determinant of the tangent at a committed state
  /// had another sign than at the first one.
  [[nodiscard]] bool has_lost_stability() const { return has_lost_stability_; }
  /// Looks at the committed state too, which no step comes after. Another factorisation of its tangent.
  void watch_last_state();
  /// Drops the trial states.
  void revert();
  /// Puts mesh and loads where the committed displacements have them; nothing to do in small deformation.
  void move_to_committed();
  /// Largest residual over its tolerance: balanced when not above 1.
  [[nodiscard]] double excess(const Residual& residual) const;
  /// Nodal forces over the references of the run; no fields.
  [[nodiscard]] Residual relative(const Eigen::VectorXd& forces) const;
  /// Nodal forces of the committed stresses and contributions.
  [[nodiscard]] Eigen::VectorXd committed_internal_forces() const;
  /// @throws RunError where explicit steps cannot take what the problem has
  void refuse_explicit() const;
  /// @throws RunError where a contribution needs to know how long a step takes
  void refuse_unknown_time() const;

 protected:
  // Of both ways of solving: iterations here, explicit steps in Solver<dim>::Implementation.
  Problem<dim> problem;
  SolverOptions options;
  Discretisation<dim> discretisation;
  Constraints<dim> constraints;
  Loads<dim> loads;
  PointMaterials<dim> materials;
  Contributions<dim> contributions;
  double reference_length;
  SolverState<dim> state;
  Observer* observer = nullptr;

 private:
  /// Where an iteration stands: everything is counted from the committed state.
  struct Iterate {
    double time;
    double released;               ///< see StepGoal
    double jump_let_go;            ///< see StepGoal
    Eigen::VectorXd displacement;  ///< increment, given entries included
    Eigen::VectorXd unbalanced;    ///< loads less internal forces
    Residual residual;
  };
  enum class Balance { none, within_tolerance, within_noise, within_rounding };

  [[nodiscard]] Eigen::VectorXd loads_at(double time, double released, double jump_let_go) const;
  /// The base of the tangent at the last evaluation, or at the committed state.
  [[nodiscard]] Linearisation<dim> linearised(const std::vector<Response<dim>>& answers) const;
  [[nodiscard]] Iterate start_of(const StepGoal& goal) const;
  /// Where the iteration of a step starts, and the forces that its first correction balances.
  struct Predictor {
    Iterate iterate;
    Eigen::VectorXd right_side;
  };
  [[nodiscard]] Predictor predict(const StepGoal& goal);
  /// Adds the contributions to the forces that the first correction balances, and to internal_before_.
  void predict_contributions(const Iterate& iterate, Eigen::VectorXd& right_side);
  /// solve() of the tangent factorised last, for forces on the unknowns.
  [[nodiscard]] Eigen::VectorXd solved(const Eigen::VectorXd& forces) const;
  /// Asks the materials for the end of a step. `refusal_` says where they cannot be asked.
  void ask_materials(const Iterate& iterate, StepReport& report);
  void evaluate(Iterate& iterate, StepReport& report);
  /// A reference force for steps of rotations or moments alone: in the first one supports react by moments only. The tangent
  /// of the committed state gives the forces that hold the free entries while the given ones are at their largest. The largest
  /// moments of the loads and the forces held back are added. Moments count over the reference length.
  [[nodiscard]] double force_of_path() const;
  /// Whether fields follow the answers of the materials (Contribution::fields_store).
  [[nodiscard]] bool fields_follow_answers() const;
  /// Fields follow explicit steps implicitly: gives their free entries of the iterate the values with which their rows vanish
  /// while all displacements stay. Rows that store must be linear in them. @returns why it cannot; empty: done
  [[nodiscard]] std::string carry_fields(Iterate& iterate);
  /// By element: the stiffness that fields add to displacements when nothing flows, condensed; empty without fields.
  /// @throws RunError where a field stores nothing
  [[nodiscard]] std::vector<Eigen::MatrixXd> stiffness_of_fields();
  /// Puts elements, supports, loads and the pattern of the tangent where the stage of the state has them.
  void enter_stage();
  /// Notes how the mesh has moved where elements come that were not there before (SolverState::placed_with).
  void note_placed(const std::vector<char>& there_before);
  /// Lets the contributions of a stage come and go, from the state of the stage before. @param at_rest the run begins with it
  void begin_contributions(int stage, bool at_rest);
  /// Evaluates the contributions at the committed state and commits them. @returns why one of them cannot
  [[nodiscard]] std::string contribute_at_rest(std::span<const Response<dim>> responses);
  /// Evaluates the contributions for a step from the committed state. @returns why one of them cannot
  [[nodiscard]] std::string contribute(double time, const Eigen::VectorXd& increment);
  void find_increments(const Eigen::VectorXd& displacement_increment);
  /// Hands on what the observer should know of the linear solver.
  void tell_of_solver();
  [[nodiscard]] bool factorise(const std::vector<Response<dim>>& responses, double time, StepReport& report);
  /// Whether the sign of the determinant of a tangent tells stability.
  [[nodiscard]] bool tells_stability() const;
  /// Looks at the tangent of the committed state, which must be the one factorised last.
  void watch_stability(const StepGoal& goal);
  [[nodiscard]] bool correction(const StepGoal& goal, const Iterate& iterate,
                                const std::vector<Response<dim>>& responses,
                                const Eigen::VectorXd& right_side, Correction& change, StepReport& report);
  [[nodiscard]] double allowed_share(const Eigen::VectorXd& from, const Eigen::VectorXd& change) const;
  [[nodiscard]] Attempt limit_correction(Iterate& iterate, Correction& change, StepReport& report) const;
  /// Large deformation in space, where nodal values of micro-rotations are vectors of rotations and a step adds to them as a
  /// further turn (newton_turn.cpp).
  [[nodiscard]] bool turns_rotations() const {
    return dim == 3 && problem.deformation == Deformation::large && problem.continuum == Continuum::cosserat;
  }
  /// Of an increment from given values less those at the start: turns at supports that give rotations.
  void turn_given(const StepGoal& goal, Eigen::VectorXd& increment) const;
  /// Adds a step to the nodal values.
  void add_step(const Iterate& iterate);
  [[nodiscard]] Attempt limit_predictor(const StepGoal& goal, Iterate& iterate, Correction& change,
                                        StepReport& report) const;
  /// The committed step before, as far as this goal, with the given entries of the goal; empty when there was no such step or it
  /// went another way.
  [[nodiscard]] Correction last_step_drawn_on(const StepGoal& goal, const Iterate& iterate) const;
  /// Large turns: a predictor is linear, and micro-rotations that follow a turn linearly stay behind it. Lets them catch up.
  void turn_predictor(const Iterate& iterate, Correction& change) const;
  /// Whether the last evaluation strained a point by more than 1, skew strain included.
  [[nodiscard]] bool has_gone_astray() const;
  /// Whether an increment takes a node so far from the body that forces are lost in rounding.
  [[nodiscard]] bool is_out_of_sight(const Eigen::VectorXd& increment) const;
  void remember(const Iterate& iterate);
  [[nodiscard]] std::string residual_text(const Residual& residual) const;
  void move(Iterate& iterate, const Correction& change, double fraction, StepReport& report);
  void line_search(Iterate& iterate, const Correction& change, double excess_before, StepReport& report);
  [[nodiscard]] Balance balance_of(const Iterate& iterate, bool last_chance) const;
  [[nodiscard]] const Response<dim>& worst_response() const;
  void commit(const Iterate& iterate, Balance balance, StepReport& report);
  void add_to_strain_and_work(std::size_t point);

  double body_size_;  ///< diagonal of the box around the mesh, m
  TangentMatrix<dim> tangent_;
  LinearSolver linear_solver_;
  int first_sign_ = 0;  ///< of the determinant of the tangent; 0: not known yet
  bool has_lost_stability_ = false;
  bool is_balanced_at_time_ = false;  ///< the committed state: by iterations, at a given time
  Eigen::VectorXd scaling_;           ///< of the equations (equation_scaling.hpp); empty without fields
  NodalForces contributed_;           ///< of the evaluation made last
  FieldBalance<dim> field_balance_;   ///< of explicit steps
  Anderson anderson_;
  bool converges_fast_ = false;  ///< the last iteration needs no acceleration
  Discretisation<dim> start_;    ///< large deformation: at the start of the step
  /// Why the last iterate cannot be: an element that it turns inside out, a contribution that cannot answer.
  std::string refusal_;
  Eigen::VectorXd internal_before_;  ///< nodal forces of the committed state
  Eigen::VectorXd loads_before_;
  Eigen::VectorXd withheld_;     ///< forces out of balance at the start; empty when all are in balance
  Eigen::VectorXd left_behind_;  ///< of these, by the tolerance of the stage before; empty: nothing
  double released_ = 1.0;        ///< share of them that committed steps have let go
  Eigen::VectorXd jump_;         ///< forces out of balance behind the jump that was passed last
  double jump_let_go_ = 1.0;     ///< share of them that committed steps have let go
  std::optional<Iterate> best_;  ///< of the last attempt, of those that could be committed
  Eigen::VectorXd unbalanced_;   ///< of the evaluation made last; empty before the first one of an attempt
  std::vector<Increment<dim>> increments_;  ///< of the evaluation made last
  std::vector<Response<dim>> trial_;        ///< its responses
};

}  // namespace polargrain::fem
