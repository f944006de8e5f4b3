// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <utility>

#include "common/cell.hpp"
#include "common/plane_in_space.hpp"

namespace polargrain::coupler {

// Cells as the points of finite elements see them: requests to a cell are put into space here, answers from it are
// taken out of space here, and nowhere else. Points in space have their increments and answers as they are.

/// The request of a point to a cell.
template <int dim>
struct PointRequest {
  StatePointer state;        ///< null: the packing
  Increment<dim> increment;  ///< about the start of the step (increment_for_cell)
  /// The answer at `state`, whose tangent may be carried on by the stress to come (secant_tangent.hpp); null: a tangent is asked
  /// for.
  const Response<dim>* start = nullptr;
};

/// The answer of a cell to a point.
template <int dim>
struct PointReply {
  Response<dim> response;  ///< the cell's own stress and tangent
  /// Whether the cell has a stress along e_3. Discs have no such stress: the s33 of the response is zero then, and the material
  /// that asks puts its own there.
  bool knows_s33 = true;
  CellDiagnostics diagnostics;
  StatePointer state;  ///< state after the increment; null when the evaluation failed

  template <RecordOf<PointReply> Record, class Visit>
  friend void describe(Record& reply, Visit&& visit) {
    visit(FieldNotes{"response", "", "stress and tangent of the cell"}, reply.response);
    visit(FieldNotes{"knows_s33", "", "whether the cell has a stress normal to the plane"}, reply.knows_s33);
    visit(FieldNotes{"diagnostics", "", "diagnostics at read-out"}, reply.diagnostics);
    visit(FieldNotes{"state", "", "state after the increment"}, reply.state);
  }
};

using PlaneRequest = PointRequest<2>;
using PlaneReply = PointReply<2>;

/// The increment of a point as its cell takes it.
inline CellIncrement increment_in_space(const Increment<2>& increment) {
  return polargrain::in_space(increment);
}
inline CellIncrement increment_in_space(const Increment<3>& increment) {
  return increment;
}

template <int dim>
CellRequest in_space(const PointRequest<dim>& request) {
  return {request.state, increment_in_space(request.increment)};
}

/// The part of a cell's answer that a point of the dimension knows.
template <int dim>
Response<dim> of_dimension(const CellResponse& response) {
  if constexpr (dim == 2) {
    return polargrain::in_plane(response);
  } else {
    Response<3> made;
    made.stress = response.components();
    made.tangent = response.tangent;
    static_cast<Trust&>(made) = response;
    return made;
  }
}

template <int dim>
PointReply<dim> of_dimension(CellReply reply) {
  return {of_dimension<dim>(reply.response), reply.response.known == KnownComponents::all, reply.diagnostics,
          std::move(reply.state)};
}

inline PlaneReply in_plane(CellReply reply) {
  return of_dimension<2>(std::move(reply));
}

}  // namespace polargrain::coupler
