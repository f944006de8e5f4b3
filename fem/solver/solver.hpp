// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "common/archive.hpp"
#include "common/response.hpp"
#include "fem/solver/problem.hpp"
#include "fem/solver/quasi_static.hpp"
#include "fem/solver/step_work.hpp"
#include "fem/solver/trouble.hpp"

namespace polargrain::fem {

struct SolverOptions {
  /// A step has converged when the sum of the absolute unbalanced nodal forces is below force_tolerance times
  /// the reference force, and the sum of the absolute unbalanced nodal moments is below moment_tolerance
  /// times the reference force times the reference length.
  double force_tolerance = 1e-8;
  double moment_tolerance = 1e-8;
  /// N per m of thickness; 0: sum of the absolute nodal loads at their largest plus the absolute reactions to
  /// the initial stress; when these are zero, the absolute reactions after the first iteration ever made; in an explicit
  /// step without reactions, Newton::force_of_path.
  /// Fixed from then on.
  double reference_force = 0.0;
  /// m; 0: square root of the mean area of the elements.
  double reference_length = 0.0;
  int most_iterations = 30;
  /// The iteration is given up when its residual has not fallen by a tenth over this many iterations; half as many where a
  /// jump may be passed at once.
  int stagnation_window = 6;
  /// A step may be halved this often in a row before the run is given up.
  int most_cuts = 6;
  /// When an iteration has made the residual larger, its correction may be halved this often, each at the
  /// price of an evaluation; the best of them is kept. 0: no line search.
  int most_line_search_halvings = 3;
  /// Where stresses carry noise (Response::noise), a step also counts as balanced when each residual is
  /// within its tolerance or this factor times the residual of the noise alone; StepReport::within_noise counts
  /// such steps. 0: the tolerances alone count. Corrections that cancel one sample of the noise meet the next
  /// one, so an iteration cannot be expected to get below sqrt(2).
  double noise_factor = 0.0;
  /// Earlier iterations of a step that each correction takes into account (anderson.hpp). 0: plain Newton.
  int acceleration_depth = 0;
  /// Strain of any point that an iteration may ask for, counted from the last committed state: norm of the
  /// symmetric strain. A longer correction is shortened, a predictor that asks for more (its tangent is
  /// nearly singular) gives way to the last step drawn on, or the step is cut; StepReport::limited counts
  /// that.
  double largest_strain = 1.0;
  /// Where stresses jump, as those of few grains do when they rearrange, an iteration stagnates at the height of the
  /// jumps. So many of them a step may be passed: the best iterate is committed, with the cells behind their jump, and
  /// the imbalance is held by fictive forces and let go from there, in parts where it has to be, so that the
  /// step as a whole ends in balance; StepReport::jumps counts them. 0: a jump ends the run.
  int most_jumps = 0;
  /// Force residual up to which a jump is passed as soon as the iteration stagnates; a larger one only where no cut of
  /// the step makes it smaller (jump_watch.hpp).
  double jump_residual = 0.05;
};

/// How explicit steps are taken (docs/theory/explicit.md).
struct ExplicitOptions {
  double safety = 0.6;  ///< a step over the critical one; stiffness may grow by 1 / safety^2
  double rotation_damping =
      1.0;  ///< share of the speed of a micro-rotation over the continuum's spin that a step takes away; not in real time
  /// Steps over which nodes at rest come to their speed. 0: as many as a wave needs through the mesh there and back; such a
  /// ramp hardly excites the slowest wave.
  int ramp = 0;
  /// Speed of the row before over that of this one; it changes evenly within the time of a wave. Of no account from rest.
  double speed_before = 1.0;
  /// Force residual that the nodes come to at the end of the row, their boundaries held; 0: they go on as they are.
  double rest = 0.0;
  int most_rest_steps = 2000;  ///< for that
  /// 1/s, in real time: forces of -mass_damping * mass * velocity, moments alike. The velocity is that
  /// relative to the base (BaseMotion): a body that the base carries along evenly is not dragged.
  double mass_damping = 0.0;
};

/// Energies of steps in real time, J (in the plane per m of thickness), since their begin.
struct Energies {
  double kinetic = 0.0;
  double internal = 0.0;  ///< work of the stresses
  double external = 0.0;  ///< work of loads and supports, and of the base through the damping
  double damped = 0.0;    ///< by ExplicitOptions::mass_damping, and of micro-rotations
  double absorbed = 0.0;  ///< by quiet boundaries
  double at_start = 0.0;  ///< the larger of the works of the start, which internal and external are without

  /// External energy that the others do not account for, over the largest of all; where hardly anything moves, over what is
  /// above the rounding of the works. 0 but for rounding in small deformation.
  [[nodiscard]] double error() const;
};

/// After one evaluation of all materials.
struct IterationReport {
  double time = 0.0;                         ///< that the step is to reach
  int cuts = 0;                              ///< in a row so far
  int iteration = 0;                         ///< 1 is the predictor
  double force_residual = 0.0;               ///< relative to the reference force
  double moment_residual = 0.0;              ///< relative to reference force times reference length
  std::vector<double> field_residuals = {};  ///< of each nodal field (NodalField::tolerance)
};

/// The outcome of Solver::advance.
struct StepReport : StepWork {
  bool converged = false;
  std::string message;          ///< why it has not converged; empty when it has
  double time = 0.0;            ///< reached and committed
  double force_residual = 0.0;  ///< of the last committed substep
  double moment_residual = 0.0;
  std::vector<double> field_residuals;  ///< of each nodal field
  double force_noise = 0.0;             ///< the residual of noise alone, of the last committed substep
  double moment_noise = 0.0;
  int explicit_steps = 0;    ///< that it took; 0 where it was balanced by iterations
  int given_up = 0;          ///< iterations that did not balance it (automatic.hpp): explicit steps went on
  int rest_steps = 0;        ///< of them: after the last movement, see ExplicitOptions::rest
  Energies energies;         ///< of steps in real time
  QuasiStatic quasi_static;  ///< of explicit steps
  double speed = 1.0;        ///< of explicit steps whose rate follows what they reach (explicit_rate.hpp)
  std::vector<double> force_residuals;  ///< by iteration, of the last attempt
  std::vector<double> moment_residuals;
};

/// A linear measure of deformation whose growth is prescribed in place of the loading time, for instance the
/// displacement of two nodes against each other. The loading time, and with it loads and moved boundaries,
/// becomes an unknown and may go back: this follows softening through snap-back (indirect displacement
/// control).
struct DisplacementMeasure {
  struct Term {
    int node;
    Dof dof;
    double weight;
  };
  std::vector<Term> terms;
};

/// The outcome of Solver::start_from.
struct StartReport {
  StepReport step;
  bool same_mesh = false;
  double imbalance = 0.0;        ///< force residual of the states as they were taken over
  double moved = 0.0;            ///< largest displacement by which balance was found, m
  double farthest = 0.0;         ///< largest distance of a point from the nearest one of the other run, m
  std::size_t from_nearest = 0;  ///< TakenOver::from_nearest
  std::size_t zeroed = 0;        ///< TakenOver::zeroed
  std::size_t outside =
      0;  ///< points outside of their region there; they took the state of the nearest point
};

/// Told of every event while a step runs; for progress lines and logs. Must not change the solver.
class Observer {
 public:
  virtual ~Observer() = default;
  virtual void iterated(const IterationReport& report) { (void)report; }
  /// A step to `time` was given up for `reason`; `next_time` will be tried. Where a measure is controlled in
  /// place of the time, and where a jump is let go, both are the time of the last committed state.
  virtual void cut(double time, const std::string& reason, double next_time) {
    (void)time, (void)reason, (void)next_time;
  }
  /// How linear systems are solved, or why no longer so.
  virtual void solves(const std::string& text) { (void)text; }
  /// A step has been cut for the second time: where it is out of balance. The solver stands at its last committed state.
  virtual void struggles(const Trouble& trouble) { (void)trouble; }
};

/// All that the solver knows at the last committed time, apart from the states kept by the materials.
template <int dim>
struct SolverState {
  double time = 0.0;
  Eigen::VectorXd
      displacement;  ///< the entries of node_dofs for each node, then those of the fields (FieldPlaces)
  std::vector<typename Cosserat<dim>::Vector> strain;  ///< by point, accumulated
  std::vector<Response<dim>> responses;  ///< by point: stress and tangent of the last converged step
  double reference_force = 0.0;          ///< 0: not fixed yet
  Eigen::VectorXd last_increment;  ///< of the displacements in the last committed substep; empty at first
  double next_step = 0.0;          ///< after a cut: share of a step to try next; 0: as asked for
  double external_work = 0.0;      ///< J per m of thickness, loads and reactions, trapezoidal, since time 0
  double internal_work = 0.0;      ///< the same of stresses and contributions, by the same rule
  // Of explicit steps, in the order of the equations; empty before the first of them.
  Eigen::VectorXd mass;      ///< nodal_masses
  Eigen::VectorXd velocity;  ///< nodal values a step
  /// Nodal forces of the supports at the end of the last row of them (RowOfForces); empty where that row was no explicit one.
  Eigen::VectorXd reactions;
  Eigen::VectorXd contributed;  ///< nodal forces of the contributions; empty without any
  // Of stages of construction.
  int stage = 0;
  Eigen::VectorXd offsets;  ///< by entry: where supports that began in a later stage count from; empty before
  Eigen::VectorXd shown_from;  ///< results show displacements less these; empty: from zero
  /// By point: the displacement gradient with which its region was placed, from which its strain counts. Empty before a region
  /// is placed, and in large deformation.
  std::vector<typename Cosserat<dim>::Gradient> placed_with;
  // Of steps in real time.
  double seconds = 0.0;          ///< that a step may have; 0: steps have no real time
  Eigen::VectorXd held;          ///< nodal forces by which quiet boundaries held the start
  Eigen::VectorXd given_mass;    ///< nodal, of displacements that the case moves; zero at all others
  std::vector<double> dashpots;  ///< QuietBoundary::values
  Energies energies;             ///< but the kinetic one; works count from their values at the begin
};

/// Quasi-static equilibrium of a Problem: Newton iterations with a consistent predictor (docs/theory.md,
/// G.6), steps that are cut when something fails and grow back. A step that is not balanced is never
/// committed; above its tolerances only within noise or rounding, flagged; through a jump of the stresses only where
/// SolverOptions::most_jumps allows it, flagged too. Same problem, options: same bits.
///
/// Order of calls: construct, equilibrate once (evaluates the initial state), then advance to growing times.
template <int dim>
class Solver {
 public:
  /// Allocates the states of the materials.
  /// @throws RunError when faults(problem) is not empty or a material is null.
  Solver(Problem<dim> problem, SolverOptions options);
  ~Solver();
  Solver(const Solver<dim>&) = delete;
  Solver<dim>& operator=(const Solver<dim>&) = delete;

  void set_observer(Observer* observer);

  /// Brings the initial stresses into balance with the loads and supports at time 0. Zero iterations when
  /// they already are. Where one attempt does not get there, the imbalance and the displacements
  /// given at time 0 are let go in shares, cut like any step, in ten times SolverOptions::most_iterations at most. Not
  /// converged too when nothing resists a micro-rotation.
  StepReport equilibrate();
  /// Goes over to a stage of construction: regions come and go, supports and loads begin and end (Lifetime). Nothing moves;
  /// the forces of all that changes are held back, and steps let them go.
  /// @throws RunError when the elements of the stage cannot be computed
  void begin_stage(int stage);
  /// After restore, where materials answer otherwise than those that were saved: evaluates them where they are, and lets go
  /// the imbalance in shares as equilibrate does. Not converged where no balance is found.
  StepReport redistribute();
  /// In place of equilibrate: begins with the state that an earlier run had at its end, also on another mesh. Displacements and
  /// micro-rotations come by the shape functions of the old elements, states by Material::take_over. Supports count from where
  /// nodes are. The imbalance is let go as in redistribute; the report tells how far that moves.
  /// @param end as save has written it @param regions_of_end names, in their order
  /// @throws RunError where a region of the problem is missing there, or a material cannot take its states over
  StartReport start_from(ArchiveReader& end, const std::vector<std::string>& regions_of_end);
  /// The largest unbalanced force that the tolerance lets pass, over the sum of the nodal forces that the steps to come let
  /// go or change; zero where that is not known, as movements are given,
  /// and where nothing changes.
  [[nodiscard]] double tolerated_share_of_change() const;
  /// From now on results show displacements and micro-rotations less those of this moment. Nothing else changes.
  void reset_displacements();

  /// Goes on to `time`, in smaller steps where needed. When it fails, the last committed substep stands.
  /// @param released share of the forces held back since the stage began that are let go at the end, here and below
  /// @param most_iterations that it may take, lost ones too; 0: as many as it needs
  StepReport advance(double time, double released = 1.0, int most_iterations = 0);

  /// Goes on until `measure` has grown by `amount` (not zero), at whatever loading time balances it. Time
  /// tables must be straight over the times passed through.
  /// @throws RunError where a contribution depends on the duration of a step
  StepReport advance_measure(const DisplacementMeasure& measure, double amount, double released = 1.0);
  /// Goes on by `length` (m, positive) along the direction of the last committed substep: sqrt of the sum
  /// over the nodes of u1^2 + u2^2 + (reference length w)^2, projected on that direction (arc-length
  /// control).
  /// @throws RunError before the first substep has been committed.
  StepReport advance_arc_length(double length, double released = 1.0);

  /// In place of equilibrate, before explicit steps: evaluates the initial state. Forces out of balance then, and the
  /// displacements given at time 0, come in smoothly over the first advance_explicit.
  /// @throws RunError for a problem with contributions or fields
  StepReport begin_explicit();
  /// In place of equilibrate, before steps of both methods (automatic.hpp): tries to balance the start in so many iterations. Where
  /// that fails, forces out of balance come in over the first explicit steps; StepReport::given_up says so.
  StepReport begin_automatic(int most_iterations, const ExplicitOptions& options = {});
  /// Goes on to `time` in `steps` explicit steps at one rate: central differences with nodal masses that make each step stable.
  /// The residuals of the report are means over these steps, unbalanced forces of the nodes with their inertia. Behind a
  /// step that iterations have balanced, or given up, the nodes start at rest; forces out of balance there come in over the
  /// row.
  /// @returns not converged when a step moves too far, or a material fails; steps before it stand
  StepReport advance_explicit(double time, int steps, const ExplicitOptions& options = {});

  /// Explicit steps that a wave of compression needs through the mesh there and back. 0 before the first row of them.
  [[nodiscard]] int steps_of_wave() const;

  /// In place of equilibrate, before steps in real time: balances the start, then gives the nodes their true masses and lets
  /// quiet boundaries go (Problem::densities, Problem::quiet).
  StepReport begin_real_time(const ExplicitOptions& options = {});
  /// Goes on to `time`, s, in as many explicit steps as are stable. StepReport::energies tells where the energy is.
  /// @returns as advance_explicit
  StepReport advance_real_time(double time, const ExplicitOptions& options = {});

  /// Of the last attempt of the last step that failed; empty when no step has failed.
  [[nodiscard]] const Trouble& trouble() const;
  [[nodiscard]] const Problem<dim>& problem() const;
  [[nodiscard]] const SolverState<dim>& state() const;
  /// Writes all that the steps to come depend on, states of the materials included (state_archive.hpp).
  /// @throws RunError when a material cannot be kept
  void save(ArchiveWriter& archive) const;
  /// In place of equilibrate: goes on from the archive of save for an equal problem with equal options. The run
  /// continues to the same bits as without the interruption.
  /// @throws RunError when the archive holds something else; the solver can then only be destroyed
  void restore(ArchiveReader& archive);

  /// Integration points, in the order of all vectors by point: elements in order, points of an element in
  /// order.
  [[nodiscard]] std::size_t points() const;
  [[nodiscard]] int element_of_point(std::size_t point) const;
  [[nodiscard]] typename Cosserat<dim>::Place position_of_point(std::size_t point) const;
  /// Whether the element of a point is there in the stage.
  [[nodiscard]] bool is_there(std::size_t point) const;
  /// Displacements and micro-rotations as results show them (reset_displacements).
  [[nodiscard]] Eigen::VectorXd shown_displacement() const;
  /// Volume that belongs to the point, m^3; in the plane per unit thickness, m^2.
  [[nodiscard]] double volume_of_point(std::size_t point) const;
  /// The material of a point and the number of the point within that material.
  [[nodiscard]] std::pair<const Material<dim>*, std::size_t> material_of_point(std::size_t point) const;

  /// Nodal forces of the stresses (N and N m; in the plane N/m and N), internal and of the loads, at the committed time.
  [[nodiscard]] Eigen::VectorXd internal_forces() const;
  [[nodiscard]] Eigen::VectorXd external_forces() const;
  /// Sum over the nodes of boundaries and node sets, each node once, of the forces of the supports: force along each axis
  /// (N; in the plane per m of thickness) and nodal moments, in the order of node_dofs. Behind explicit steps they are
  /// those of SolverState::reactions.
  [[nodiscard]] typename Cosserat<dim>::NodeValues reaction(const std::vector<std::string>& on) const;
  [[nodiscard]] typename Cosserat<dim>::NodeValues reaction(const std::string& on) const {
    return reaction(std::vector{on});
  }
  /// Mean displacement, as results show it, over the nodes of boundaries and node sets, each node once, in the order of
  /// node_dofs: m, rad. Nodes that no element has in the stage do not count while others do.
  [[nodiscard]] typename Cosserat<dim>::NodeValues mean_displacement(
      const std::vector<std::string>& on) const;
  [[nodiscard]] typename Cosserat<dim>::NodeValues mean_displacement(const std::string& on) const {
    return mean_displacement(std::vector{on});
  }
  /// Mean value of a nodal field over those nodes of boundaries and node sets that carry it; NaN where no node does.
  [[nodiscard]] double mean_field(std::size_t field, const std::vector<std::string>& on) const;
  /// Sum of the contributed rows of a field at given values of it there: its supports take out so much over the last substep.
  [[nodiscard]] double field_reaction(std::size_t field, const std::vector<std::string>& on) const;
  /// Mean over the volume of the sum of the normal strains; positive is expansion.
  [[nodiscard]] double volume_strain() const;
  /// The effects that small deformation leaves out of the committed state (left_out.hpp); empty where small, and in large
  /// deformation.
  [[nodiscard]] std::string left_out() const;
  /// Whether a committed state before the last step was unstable or past a bifurcation, as far as the sign of the determinant of
  /// the tangent tells (Newton::has_lost_stability): two bifurcations within a step hide each other.
  [[nodiscard]] bool has_lost_stability() const;
  /// The same, of the last state too: for the end of a run, where no step looks at it. Takes another factorisation.
  [[nodiscard]] bool has_lost_stability_at_end();

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace polargrain::fem
