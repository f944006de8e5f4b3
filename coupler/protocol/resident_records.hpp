// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "common/record.hpp"
#include "common/resident_boxes.hpp"

namespace polargrain {

// The descriptions of what resident boxes are told and answer, for messages and archives.

template <RecordOf<ResidentMotion> Record, class Visit>
void describe(Record& motion, Visit&& visit) {
  visit(FieldNotes{"rate", "1/s", "Hdot H^-1 of the step behind it, in the frame of the box",
                   "_11 _12 _13 _21 _22 _23 _31 _32 _33"},
        motion.gradient);
  visit(FieldNotes{"spin", "rad/s", "spin of the grains, counted from the frame", "_1 _2 _3"}, motion.spin);
}

template <RecordOf<ResidentAnswer> Record, class Visit>
void describe(Record& answer, Visit&& visit) {
  visit(FieldNotes{"stress", "Pa", "stress s_ij", "11 12 13 21 22 23 31 32 33"}, answer.stress);
  visit(FieldNotes{"couple_stress", "N/m", "couple stress m_ij", "11 12 13 21 22 23 31 32 33"},
        answer.couple_stress);
  visit(FieldNotes{"unbalanced_force_ratio", "1", "see CellDiagnostics"}, answer.unbalanced_force_ratio);
  visit(FieldNotes{"coordination_number", "1", "2 contacts / grains"}, answer.coordination_number);
}

}  // namespace polargrain
