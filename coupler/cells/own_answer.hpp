// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <type_traits>

#include "common/increment.hpp"
#include "common/record.hpp"
#include "common/response.hpp"
#include "coupler/cells/cosserat_part.hpp"
#include "coupler/cells/packing_at_start.hpp"

namespace polargrain::coupler {

/// The data that a point of `informed` needs to go by the answer of its cell once its law has left it
/// (docs/theory/plasticity.md, B.9). The point starts in balance: the stress that its law had beyond the cell's is
/// carried along, turns with the material, and is worked off in a straight line over the strain that follows. So no
/// stress jumps, and a smaller step lets go of less.
template <int dim>
struct OwnAnswer {
  bool active = false;
  /// Skew and couple stress of a cell with free rotations; they go on from the law's.
  CosseratPart<dim> cosserat;
  typename Cosserat<dim>::Vector carried =
      Cosserat<dim>::Vector::Zero();  ///< stress of the law less that of the cell at the change, Pa and N/m
  double strained = 0.0;              ///< norms of the strain increments since, summed

  template <RecordOf<OwnAnswer> Record, class Visit>
  friend void describe(Record& own, Visit&& visit) {
    visit(FieldNotes{"active", "", "whether the point goes by its cell's answer"}, own.active);
    visit(FieldNotes{"cosserat", "", "skew and couple stress of the case"}, own.cosserat);
    visit(FieldNotes{"carried", "Pa, N/m", "stress of the law less that of the cell when it was left"},
          own.carried);
    visit(FieldNotes{"strained", "1", "strain since"}, own.strained);
  }
};

/// How points go by their cells' answers.
template <int dim>
struct OwnAnswerRules {
  /// Of cells with free rotations; the answer of controlled ones is taken whole.
  CosseratParameters cosserat;
  bool controlled = false;
  /// Over which the strain of a curvature is counted, m; of no effect with free rotations.
  double length = 0.0;
  double work_off_strain = 0.0;  ///< over which a carried stress goes to zero; 0: at once
  PackingAtStart<dim> packing = {};
};

/// From the law's stress to the cell's answer. Skew and couple stress of the law beyond the limits of the cell are
/// carried along too. @param law stress at the end of the step, Pa and N/m
template <int dim>
OwnAnswer<dim> left_law(const OwnAnswerRules<dim>& rules,
                        const std::type_identity_t<typename Cosserat<dim>::Vector>& law,
                        const PointReply<dim>& cell);

/// The answer of a point that goes by its cell. @param start at the start of the step @param cell the answer of the cell
/// to the increment @param end gets the point at the end of the step
template <int dim>
Response<dim> own_answer(const OwnAnswerRules<dim>& rules, const OwnAnswer<dim>& start,
                         const Increment<dim>& increment, const PointReply<dim>& cell, OwnAnswer<dim>& end);

}  // namespace polargrain::coupler
