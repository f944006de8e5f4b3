// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "coupler/adaptivity/audits.hpp"
#include "coupler/adaptivity/error_estimate.hpp"
#include "coupler/cells/cell_calls.hpp"
#include "coupler/cells/cell_increment.hpp"
#include "coupler/cells/cosserat_part.hpp"
#include "coupler/cells/grains_of_points.hpp"
#include "coupler/cells/ground_start.hpp"
#include "coupler/cells/packing_at_start.hpp"
#include "coupler/cells/points_at_limits.hpp"
#include "fem/material/begins_in_ground.hpp"
#include "fem/material/material.hpp"

namespace polargrain::coupler {

struct AdaptivityOptions {
  /// Error in the in-plane norm of stress that a point may have, as a share of the reference pressure. 0: every point
  /// has a cell of its own.
  double tolerance = 0.02;
  /// Share of the points that are followed by a cell of their own through all steps, which measures the error; at
  /// least six, at the start twelve and the root of their number. 0: no point, and nothing is known of the error.
  double audit = 0.01;
  std::uint64_t seed = 1;
  /// Of grains whose rotations are controlled, m: it makes curvatures and couple stresses comparable with strains and
  /// stresses. 0: rotations are free.
  double mean_diameter = 0.0;
  /// Pa; nothing: the mean in-plane pressure of the packing. A scene that begins almost without stress and is loaded by
  /// its weight has no use for the latter.
  std::optional<double> reference_pressure = {};
};

/// Where the stress of a point came from in a committed step.
enum class Source : int {
  tangent = 0,    ///< no cell was run: an earlier answer was carried along its tangent
  neighbour = 1,  ///< a cell that follows another point was run, and carried to this one
  own = 2         ///< a cell was run along this point's own strain
};

constexpr Choices choices_of(Source) {
  return {0, 3};
}

/// A material whose stress comes from boxes of grains, of which no more are run than a tolerance asks for
/// (docs/adaptivity.md). Cells with free rotations give the symmetric stress, the Cosserat part is added to it; cells
/// with controlled rotations give everything, and an increment is also a micro-rotation and a curvature. Points with like histories share a cell; each point knows its offset from
/// where the cell was last run, and its stress is the cell's answer carried along the tangent by that offset.
/// Because the offset is kept, and given to the grains when the cell runs next, offsets
/// never add up over steps. When the estimated error of an offset exceeds the tolerance, a cell is
/// run from its state at the start of the step to one of the points, as often as it takes; points that this
/// does not serve take the state along and follow a branch of their own.
///
/// Within a step a cell that was run stays where it is until the estimate says otherwise, so that Newton's
/// method meets a function that is linear in each branch. evaluate therefore depends on the evaluations
/// before it since the last commit or revert, though never by more than the tolerance.
///
/// Some points, drawn by chance, are followed by cells of their own from the first step on. Their errors bound the mean
/// error of all points (error_bound.hpp), and a step whose bound exceeds the tolerance is answered anew, with a
/// smaller tolerance for estimates, before it is committed.
template <int dim>
class AdaptiveMaterial : public fem::Material<dim>, public fem::BeginsInGround<dim>, public GrainsOfPoints {
 public:
  /// @param calls must live as long as the material
  /// @param cosserat of cells with free rotations; nothing: they are controlled, and options.mean_diameter is that of
  /// the grains
  /// @param note remarks to the user on the parameters; may be empty
  AdaptiveMaterial(CellCalls<dim> calls, const std::optional<CosseratParameters>& cosserat,
                   const AdaptivityOptions& options, const std::string& note = {});

  void allocate(std::size_t points) override;
  /// Of level ground: cells begin at its levels, and each point beside one (GroundStart).
  void set_ground_stress(std::size_t point, const typename Cosserat<dim>::Vector& stress) override {
    ground_.set(point, stress);
  }
  void begin_in_ground() override;
  void evaluate(std::span<const Increment<dim>> increments, std::span<Response<dim>> responses) override;
  /// Brings all estimates within the tolerance and measures the error of the step; where its bound exceeds the tolerance,
  /// tightens the one that estimates are held to, as long as that helps.
  [[nodiscard]] bool confirm() override;
  void commit() override;
  void revert() override;
  void save(ArchiveWriter& archive) const override;
  void restore(ArchiveReader& archive) override;

  [[nodiscard]] double moment_length() const override { return options_.mean_diameter; }
  /// source (see Source), cell (its number), error_estimate (of the reference pressure), the diagnostics of the cell, and
  /// of the point parted, skew_mobilisation, couple_mobilisation (PointsAtLimits).
  [[nodiscard]] std::vector<std::string> field_names() const override;
  void fields(std::size_t point, std::span<double> values) const override;
  [[nodiscard]] StatePointer grains_of(std::size_t point) const override {
    return cells_[points_[point].cell].answer.state;
  }
  [[nodiscard]] std::vector<fem::Figure> figures() const override;
  [[nodiscard]] std::string doubt() const override;
  [[nodiscard]] std::string at_limits() const override { return at_limits_.text(); }
  [[nodiscard]] std::vector<std::string> take_notes() override;

 private:
  using Vector = typename Cosserat<dim>::Vector;

  /// A cell at the start of the step.
  struct Cell {
    PointReply<dim> answer;  ///< stress and tangent symmetric where rotations are free
    Departure<dim> departure;

    template <RecordOf<Cell> Record, class Visit>
    friend void describe(Record& cell, Visit&& visit) {
      visit(FieldNotes{"answer", "", "its last answer"}, cell.answer);
      visit(FieldNotes{"departure", "", "from the tangent, as far as it is known"}, cell.departure);
    }
  };
  struct Point {
    std::uint32_t cell = 0;
    Increment<dim> offset;    ///< from the cell to the point
    Increment<dim> farthest;  ///< place along the cell's last loading since its last run, from the cell
    CosseratPart<dim> cosserat;
    double estimate = 0.0;  ///< of its error, Pa
    Source source = Source::tangent;

    template <RecordOf<Point> Record, class Visit>
    friend void describe(Record& point, Visit&& visit) {
      visit(FieldNotes{"cell", "", "its number"}, point.cell);
      visit(FieldNotes{"offset", "", "from the cell to the point"}, kept_of(point.offset));
      visit(FieldNotes{"farthest", "", "place since the cell was last run"}, kept_of(point.farthest));
      visit(FieldNotes{"cosserat", "", "skew and couple stress of the case"}, point.cosserat);
      visit(FieldNotes{"estimate", "Pa", "of its error"}, point.estimate);
      visit(FieldNotes{"source", "", "where the stress came from"}, point.source);
    }
  };
  /// A cell during the step: where it was, or run onward to a point. The first branches are the cells.
  struct Branch {
    std::size_t cell = 0;       ///< it comes from
    Increment<dim> place = {};  ///< from that cell to here
    std::size_t leader = 0;     ///< point it was run to
    PointReply<dim> answer = {};
    Departure<dim> departure = {};
    bool was_run = false;
    std::size_t start = 0;     ///< branch that its run began at
    Excursion excursion = {};  ///< of the cell on its way here
  };
  /// A point that is followed by a cell of its own along its whole history, to measure the error of sharing.
  struct Followed {
    std::size_t point;
    StatePointer state;
    PointReply<dim> reply = {};  ///< to the increment below, of the step at work
    Increment<dim> increment = {};
  };

  void begin_step();
  /// Commits the stresses of the ground. @throws RunError when a cell cannot go there
  void take_stress_of_ground();
  /// Runs branches until the estimate of every point is within `allowed` (Pa). @returns false when a cell has failed
  bool settle(double allowed);
  [[nodiscard]] double estimate(std::size_t point, const Branch& branch) const;
  /// The excursion that a run of its cell to a point makes: the point's own where that is needed to hold the tolerance, else
  /// zero.
  [[nodiscard]] Excursion excursion_of_run(std::size_t leader) const;
  /// The branch of a point's cell with the smallest estimate.
  [[nodiscard]] std::size_t best_branch(std::size_t point) const;
  [[nodiscard]] std::vector<std::size_t> leaders_for(std::size_t cell,
                                                     const std::vector<std::size_t>& points) const;
  bool run_branches(const std::vector<std::size_t>& leaders);
  /// Runs cells to the farthest places of those leaders that have turned back, where that is needed. @returns the branches
  /// that the leaders' own runs begin at
  std::vector<std::size_t> run_turns(const std::vector<std::size_t>& leaders);
  /// Enters what a run over an increment from the branch of number `start` has made, and what it has shown.
  /// @returns the number of the new branch
  std::size_t enter(Branch moved, std::size_t start, const Increment<dim>& increment);
  /// Farthest place of a point at the start of the step.
  [[nodiscard]] Increment<dim> farthest(std::size_t point) const;
  [[nodiscard]] std::vector<PointReply<dim>> run(std::span<const PointRequest<dim>> requests,
                                                 std::span<const std::size_t> points, std::int64_t& steps);
  /// The increment that takes the cell of a point through the step.
  [[nodiscard]] Increment<dim> increment_of_step(std::size_t point) const;
  /// Size of an error of a stress, as a share of the reference pressure.
  [[nodiscard]] double share_of(const Vector& error) const { return measure_.stress(error) / reference_; }
  /// @param part skew and couple stress of the point at the start of the step; goes along to its end
  Response<dim> answer_to(std::size_t point, CosseratPart<dim>& part) const;
  /// The stress of the cells at a point, carried to it; without the Cosserat part of the case.
  [[nodiscard]] Vector stress_of_cells(std::size_t point) const;
  [[nodiscard]] double tolerance() const { return options_.tolerance / tightening_ * reference_; }
  [[nodiscard]] LimitsReached reached(const Point& point) const;
  void choose_followed();
  /// Runs the cells that follow points through the step at work, those that have not been. One that fails is let go.
  void run_followed();
  /// The errors of the answers at the followed points, shares of the reference pressure.
  [[nodiscard]] std::vector<double> measured_errors() const;
  /// The upper bound of the mean error of all points, a share of the reference pressure, with 95 % confidence.
  [[nodiscard]] double bound_of(std::span<const double> errors) const;
  /// By how much the estimates of all points, on the average, are above those of the points that are followed, which may
  /// happen to be calm ones: at least 1.
  [[nodiscard]] double neglected(std::span<const double> errors) const;
  /// The reference pressure in words.
  [[nodiscard]] std::string reference_name() const;
  /// The next larger tightening that asks for a run of a cell, as far as one is near.
  [[nodiscard]] double tightening_to_next_run() const;
  void note_tightening(double bound_before, double bound);
  /// Ends the audit of a step: keeps the errors measured, and where they leave much room one point less is followed.
  void keep_audit();
  [[nodiscard]] std::size_t fewest_followed() const;
  [[nodiscard]] bool audits() const { return options_.audit > 0.0 && options_.tolerance > 0.0; }
  void notice_sharing(std::size_t cells);
  void count_unused(std::vector<char> in_use);
  void forget_step();

  CellCalls<dim> calls_;
  std::optional<CosseratParameters> cosserat_;
  PointsAtLimits at_limits_;
  PackingAtStart<dim> packing_;
  GroundStart<dim> ground_;
  AdaptivityOptions options_;
  GrainMeasure<dim> measure_;
  double reference_ = 0.0;  ///< the pressure that errors are shares of, Pa
  ErrorEstimate<dim> estimate_;
  double noise_strain_ = 0.0;  ///< whose elastic stress is the tolerance

  std::vector<Cell> cells_;
  std::vector<Point> points_;
  std::int64_t step_ =
      0;  ///< increments committed; more than steps of the run, where these are cut or pass jumps

  // The step at work; empty between steps.
  std::vector<Branch> branches_;
  std::vector<std::vector<std::size_t>> branches_of_cell_;
  std::vector<std::size_t> branch_of_point_;
  std::vector<Increment<dim>> target_;        ///< from the cell's place to the point's
  std::vector<Excursion> excursions_;         ///< of the points, at their targets
  std::map<std::size_t, std::size_t> turns_;  ///< branches at the farthest places of leaders, by leader
  std::vector<Increment<dim>> increments_;

  std::vector<Followed> followed_;  ///< in the order they were drawn
  MeasuredErrors errors_;           ///< of the points followed, shares of the reference pressure
  double tightening_ = 1.0;         ///< the tolerance asked for is divided by it
  bool tightening_helps_ = true;    ///< in this step
  bool shares_ = true;              ///< points may follow others; false: there was nothing left to share
  struct Bounds {
    double last = 0.0;          ///< of the mean error of the last step, with 95 % confidence
    double largest = 0.0;       ///< of all steps
    double steps_beyond = 0.0;  ///< increments whose bound was beyond the tolerance,
    double first_beyond = 0.0;  ///< and the first of them; 0: no step
  } bounds_;
  std::array<std::int64_t, 3> sources_{};  ///< committed point steps by Source
  struct Costs {
    std::int64_t runs = 0;          ///< of cells, audits not counted
    std::int64_t steps = 0;         ///< DEM steps of these
    std::int64_t unused_runs = 0;   ///< runs that no point used in the end,
    std::int64_t unused_steps = 0;  ///< and their DEM steps
    std::int64_t audits = 0;        ///< runs of cells that follow points
    std::int64_t audit_steps = 0;   ///< DEM steps of these
    std::int64_t redone = 0;        ///< times that a step was answered anew
  } costs_;
  double seconds_ = 0.0;  ///< spent in decisions since the run was started, or resumed, last
  double seconds_of_cells_ = 0.0;
  std::vector<std::string> notes_;
};

}  // namespace polargrain::coupler
