// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "coupler/cells/point_cell.hpp"

namespace polargrain::coupler {

/// The cells a material asks: the packing at rest, and a batch of requests answered in their order. For
/// messages each request comes with the point of the material that it stands for.
template <int dim>
struct CellCalls {
  std::function<PointReply<dim>()> initial;
  std::function<std::vector<PointReply<dim>>(std::span<const PointRequest<dim>>,
                                             std::span<const std::size_t> points)>
      evaluate;
  /// The same states with their bytes, which a reply need not bring (State::is_here). To be called for the states
  /// committed. Empty: all replies bring them.
  std::function<std::vector<StatePointer>(std::span<const StatePointer>)> collect = {};
  /// The same cells in space, whatever the dimension of the points, with the bytes of their states. Empty where boxes are not led
  /// to a start of their own.
  std::function<CellReply()> initial_box = {};
  std::function<std::vector<CellReply>(std::span<const CellRequest>, std::span<const std::size_t> points)>
      ask_boxes = {};
};

class Pool;

/// The cells of a definition as the workers of a pool answer for them. @param pool must outlive the calls
/// @throws RunError where points in space are to have cells of discs
template <int dim>
CellCalls<dim> calls_of(Pool& pool, std::uint32_t definition);

/// The same cells, asked in the plane. @param calls must know all the stresses that it asks for
CellCalls<2> in_plane(const CellCalls<3>& calls);
/// The answer of a cell in space, seen in the plane.
PlaneReply in_plane(const PointReply<3>& reply);

/// The packing at rest. Remarks of the engine on it and its script go to the notes instead of into the
/// answer.
/// @throws RunError when it cannot be brought to rest
template <int dim>
PointReply<dim> packing_at_rest(const CellCalls<dim>& calls, std::vector<std::string>& notes);

/// Sees to it that the bytes of all these states are here; null pointers stay.
template <int dim>
void collect(const CellCalls<dim>& calls, std::span<StatePointer* const> states);

}  // namespace polargrain::coupler
