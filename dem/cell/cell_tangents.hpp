// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <span>
#include <type_traits>
#include <vector>

#include "common/cell.hpp"
#include "common/increment.hpp"
#include "dem/box/grain_box.hpp"
#include "dem/cell/condensed_tangent.hpp"
#include "dem/cell/increment_slip.hpp"
#include "dem/cell/space_tangents.hpp"

namespace polargrain::dem {

/// The tangent that a cell answers with, of the kind that its control asks for. The two dimensions part here: of the
/// springs that slide on the way of an increment discs are guessed from the end alone (near_limit.hpp), spheres are told by
/// the way that they have gone (IncrementSlip).
template <int dim>
class CellTangents {
 public:
  using Matrix = typename Cosserat<dim>::Matrix;

  /// @param grains their number
  CellTangents(const CellControl& control, int grains) : control_(control), grains_(grains) {
    if (control_.tangent == CellTangent::secant) control_.tangent = CellTangent::condensed;
  }

  /// Takes down where the grains are at the begin of an increment, with their contacts.
  void start(const GrainBox<dim>& box);
  /// The increment that the grains are under way along.
  struct Way {
    const Increment<dim>& increment;
    double size = 0.0;  ///< QuasiStatic::size
  };
  /// Of the recorded contacts, in the laboratory. @param weights of the grains in their mean rotation; empty where no grain
  /// could be turned @param volume of the box, m^3 @param way null: at rest
  Matrix of(const GrainBox<dim>& box, std::span<const double> weights, double volume,
            const Way* way = nullptr);

 private:
  [[nodiscard]] bool controlled() const { return control_.rotations == CellRotations::controlled; }
  /// Discs need nothing of the start.
  struct NoSlip {};

  CellControl control_;
  int grains_ = 0;
  std::conditional_t<dim == 2, CondensedTangent, CondensedSpaceTangent> condensed_;
  std::conditional_t<dim == 2, NoSlip, IncrementSlip> slip_;
};

}  // namespace polargrain::dem
