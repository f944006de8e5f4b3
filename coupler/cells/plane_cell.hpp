// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <utility>

#include "common/cell.hpp"
#include "common/plane_in_space.hpp"

namespace polargrain::coupler {

// Cells as the points of plane finite elements see them: requests to a cell are put into space here, answers from it
// are taken out of space here, and nowhere else.

/// The request of a point to a cell.
struct PlaneRequest {
  StatePointer state;      ///< null: the packing
  Increment<2> increment;  ///< about the start of the step (increment_for_cell)
};

/// The answer of a cell to a point of the plane.
struct PlaneReply {
  Response<2> response;  ///< the cell's own stress and tangent
  /// Whether the cell has a stress along e_3. Discs have none: the s33 of the response is zero then, and the material
  /// that asks puts its own there.
  bool knows_s33 = true;
  CellDiagnostics diagnostics;
  StatePointer state;  ///< state after the increment; null when the evaluation failed
};

template <RecordOf<PlaneReply> Record, class Visit>
void describe(Record& reply, Visit&& visit) {
  visit(FieldNotes{"response", "", "stress and tangent of the cell"}, reply.response);
  visit(FieldNotes{"knows_s33", "", "whether the cell has a stress normal to the plane"}, reply.knows_s33);
  visit(FieldNotes{"diagnostics", "", "diagnostics at read-out"}, reply.diagnostics);
  visit(FieldNotes{"state", "", "state after the increment"}, reply.state);
}

inline CellRequest in_space(const PlaneRequest& request) {
  return {request.state, polargrain::in_space(request.increment)};
}

inline PlaneReply in_plane(CellReply reply) {
  return {polargrain::in_plane(reply.response), reply.response.known == KnownComponents::all,
          reply.diagnostics, std::move(reply.state)};
}

}  // namespace polargrain::coupler
