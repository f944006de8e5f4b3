// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "common/record.hpp"
#include "common/response.hpp"
#include "coupler/adaptivity/grain_measure.hpp"

namespace polargrain::coupler {

/// The departure of an answer of a cell from its tangent, as far as known (docs/adaptivity.md, 2).
template <int dim>
struct Departure {
  /// Stress (Pa, GrainMeasure::stress) by which linearisation was wrong over an offset of size `length`. Unknown
  /// while length is 0: nothing has been learned of this cell or of those it comes from.
  double error = 0.0;
  double length = 0.0;
  /// Unit strain (GrainMeasure::strain) that the cell was last loaded along, in the axes of where it ended; zero for a
  /// packing at rest.
  typename Cosserat<dim>::Vector direction = Cosserat<dim>::Vector::Zero();
  [[nodiscard]] bool known() const { return length > 0.0; }
  /// The error (Pa) that the departure seen makes over an offset of some size: it grows with the power 3/2 up
  /// to the length it was seen over, and with the square beyond.
  [[nodiscard]] double over(double size) const;

  template <RecordOf<Departure> Record, class Visit>
  friend void describe(Record& departure, Visit&& visit) {
    visit(FieldNotes{"error", "Pa", "by which linearisation was wrong"}, departure.error);
    visit(FieldNotes{"length", "1", "size of the offset over which it was"}, departure.length);
    visit(FieldNotes{"direction", "1", "unit strain of the last loading"}, departure.direction);
  }
};

/// How far something has been along the last loading of a cell since that cell was last run.
struct Excursion {
  double depth = 0.0;  ///< the farthest place, a strain
  double back = 0.0;   ///< the part of it that has been taken back
};

/// Estimates errors of linearisation for the cells of one packing.
template <int dim>
class ErrorEstimate {
 public:
  using Vector = typename Cosserat<dim>::Vector;
  using Matrix = typename Cosserat<dim>::Matrix;

  ErrorEstimate() = default;
  /// @param elastic tangent of the packing at rest; symmetric where rotations are free
  /// @param noise_length runs shorter than this show mostly noise, and any longer one replaces
  /// them
  ErrorEstimate(const GrainMeasure<dim>& measure, const Matrix& elastic, double noise_length)
      : measure_(measure), elastic_(elastic), noise_length_(noise_length) {}

  /// Estimated error (Pa) of carrying `answer` by `offset`: the part of the departure, and half of the stress
  /// that separates the answer's tangent from the elastic one along all of the offset that does not continue
  /// the last loading. Infinite where nothing is known.
  [[nodiscard]] double of(const Response<dim>& answer, const Departure<dim>& departure,
                          const Increment<dim>& offset) const;

  /// How far an offset goes on along the last loading of a cell, a strain; 0 where it goes back.
  [[nodiscard]] double onward(const Departure<dim>& departure, const Increment<dim>& offset) const;

  /// Estimated error (Pa) of the history of a cell that has been elsewhere than its point. Loading onward is soft and the
  /// way back is stiff: a way out and back that only one of them has gone leaves this stress between them. It shows no
  /// offset.
  /// @param answer of the cell before both excursions
  [[nodiscard]] double of_history(const Response<dim>& answer, const Departure<dim>& departure,
                                  const Excursion& point, const Excursion& cell) const;

  /// Learns from a run from `start` to `end` over `offset` about both ends.
  /// @param at_start updated: the largest error seen from there
  /// @returns the departure of the answer at the end
  Departure<dim> learn(const Response<dim>& start, const Response<dim>& end, const Increment<dim>& offset,
                       Departure<dim>& at_start) const;

 private:
  GrainMeasure<dim> measure_;
  Matrix elastic_ = Matrix::Zero();
  double noise_length_ = 0.0;
};

}  // namespace polargrain::coupler
