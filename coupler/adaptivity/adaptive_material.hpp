// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "coupler/adaptivity/audits.hpp"
#include "coupler/adaptivity/error_estimate.hpp"
#include "coupler/cells/cell_calls.hpp"
#include "coupler/cells/cosserat_part.hpp"
#include "fem/material/material.hpp"

namespace polargrain::coupler {

struct AdaptivityOptions {
  /// Error in the in-plane norm of stress that a point may have, as a share of the confining pressure of the
  /// packing. 0: every point has a cell of its own.
  double tolerance = 0.02;
  /// Share of the saved evaluations that are run in full anyway; a quarter of it of the points, one at least,
  /// is followed in full.
  double audit = 0.01;
  std::uint64_t seed = 1;
  /// Of grains whose rotations are controlled, m: what makes curvatures and couple stresses comparable with strains and
  /// stresses. 0: rotations are free.
  double mean_diameter = 0.0;
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
/// Because the offset is kept, and given to the grains when the cell runs next, what a point has not yet told
/// its cell never adds up over steps. When the estimated error of an offset exceeds the tolerance, a cell is
/// run from its state at the start of the step to one of the points, as often as it takes; points that this
/// does not serve take the state along and follow a branch of their own.
///
/// Within a step a cell that was run stays where it is until the estimate says otherwise, so that Newton's
/// method meets a function that is linear in each branch. evaluate therefore depends on the evaluations
/// before it since the last commit or revert, though never by more than the tolerance.
class AdaptiveMaterial : public fem::Material {
 public:
  /// @param calls must live as long as the material
  /// @param cosserat of cells with free rotations; nothing: they are controlled, and options.mean_diameter is that of
  /// the grains
  /// @param note what the user is to know of the parameters; may be empty
  AdaptiveMaterial(CellCalls calls, const std::optional<CosseratParameters>& cosserat,
                   const AdaptivityOptions& options, const std::string& note = {});

  void allocate(std::size_t points) override;
  void evaluate(std::span<const Increment> increments, std::span<Response> responses) override;
  /// Runs the audits of the step; tightens the tolerance worked with when they break the one asked for.
  void commit() override;
  void revert() override;
  void save(ArchiveWriter& archive) const override;
  void restore(ArchiveReader& archive) override;

  [[nodiscard]] double moment_length() const override { return options_.mean_diameter; }
  /// source (see Source), cell (its number), error_estimate (of the confining pressure), and of the cell
  /// void_ratio, coordination_number, unbalanced_force_ratio, sliding_fraction, dem_steps.
  [[nodiscard]] std::vector<std::string> field_names() const override;
  void fields(std::size_t point, std::span<double> values) const override;
  [[nodiscard]] std::vector<fem::Figure> figures() const override;
  [[nodiscard]] std::vector<std::string> take_notes() override;

 private:
  /// A cell at the start of the step.
  struct Cell {
    PlaneReply answer;  ///< stress and tangent symmetric where rotations are free
    Departure departure;

    template <RecordOf<Cell> Record, class Visit>
    friend void describe(Record& cell, Visit&& visit) {
      visit(FieldNotes{"answer", "", "its last answer"}, cell.answer);
      visit(FieldNotes{"departure", "", "from the tangent, as far as it is known"}, cell.departure);
    }
  };
  struct Point {
    std::uint32_t cell = 0;
    Increment offset;             ///< from the cell to the point
    std::vector<Increment> path;  ///< its committed offsets since the cell was last run
    CosseratPart cosserat;
    double estimate = 0.0;  ///< of its error, Pa
    Source source = Source::tangent;

    template <RecordOf<Point> Record, class Visit>
    friend void describe(Record& point, Visit&& visit) {
      visit(FieldNotes{"cell", "", "its number"}, point.cell);
      visit(FieldNotes{"offset", "", "from the cell to the point"}, point.offset);
      visit(FieldNotes{"path", "", "offsets since the cell was last run"}, point.path);
      visit(FieldNotes{"cosserat", "", "skew and couple stress of the case"}, point.cosserat);
      visit(FieldNotes{"estimate", "Pa", "of its error"}, point.estimate);
      visit(FieldNotes{"source", "", "where the stress came from"}, point.source);
    }
  };
  /// A cell during the step: where it was, or run onward to a point. The first branches are the cells.
  struct Branch {
    std::size_t cell = 0;    ///< it comes from
    Increment place = {};    ///< from that cell to here
    std::size_t leader = 0;  ///< point it was run to
    PlaneReply answer = {};
    Departure departure = {};
  };
  /// A point that is followed by a cell of its own along its whole history, to measure what sharing costs.
  struct Followed {
    std::size_t point;
    StatePointer state;
  };

  void begin_step();
  /// Runs branches until every point is served. @returns false when a cell has failed
  bool settle();
  [[nodiscard]] double estimate(std::size_t point, const Branch& branch) const;
  /// The branch of a point's cell with the smallest estimate.
  [[nodiscard]] std::size_t best_branch(std::size_t point) const;
  [[nodiscard]] std::vector<std::size_t> leaders_for(std::size_t cell,
                                                     const std::vector<std::size_t>& points) const;
  bool run_branches(const std::vector<std::size_t>& leaders);
  /// The answer that a leader's branch starts from, and its place: that of its cell, taken along the turns of
  /// the path that the point has gone without it. @returns false when a cell has failed
  bool replay_paths(std::vector<Branch>& starts);
  [[nodiscard]] std::vector<PlaneReply> run(std::span<const PlaneRequest> requests,
                                            std::span<const std::size_t> points) const;
  /// What takes the cell of a point through the step.
  [[nodiscard]] Increment increment_of_step(std::size_t point) const;
  /// Size of an error of a stress, as a share of the confining pressure.
  [[nodiscard]] double share_of(const Vector7& error) const { return measure_.stress(error) / confining_; }
  [[nodiscard]] Response response_of(std::size_t point) const;
  [[nodiscard]] double tolerance() const { return options_.tolerance / tightening_ * confining_; }
  void choose_followed();
  void audit();
  void audit_offsets();
  void audit_histories();
  void tighten();

  CellCalls calls_;
  std::optional<CosseratParameters> cosserat_;
  AdaptivityOptions options_;
  GrainMeasure measure_;
  double confining_ = 0.0;  ///< mean in-plane pressure of the packing, Pa
  ErrorEstimate estimate_;
  double turn_tolerance_ =
      0.0;  ///< strain by which a path must leave a straight one to be replayed in pieces

  std::vector<Cell> cells_;
  std::vector<Point> points_;
  std::int64_t step_ = 0;

  // The step at work; empty between steps.
  std::vector<Branch> branches_;
  std::vector<std::vector<std::size_t>> branches_of_cell_;
  std::vector<std::size_t> branch_of_point_;
  std::vector<Increment> target_;  ///< from the cell's place to the point's
  std::vector<Increment> increments_;

  std::vector<Followed> followed_;
  MeasuredErrors offset_errors_;   ///< of carrying answers along offsets, shares of the confining pressure
  MeasuredErrors history_errors_;  ///< of whole histories, the same
  double tightening_ = 1.0;        ///< the tolerance asked for is divided by it
  std::size_t judged_ = 0;         ///< offset errors that a tightening has answered
  std::array<std::int64_t, 3> sources_{};  ///< committed point steps by Source
  std::int64_t runs_ = 0;                  ///< of cells, audits not counted
  std::int64_t audits_ = 0;
  std::vector<std::string> notes_;
};

}  // namespace polargrain::coupler
