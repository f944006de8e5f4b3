// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <span>
#include <type_traits>
#include <vector>

#include "coupler/cells/cell_calls.hpp"

namespace polargrain::coupler {

/// The largest turn, rad, that is asked of a cell at once; cells take 0.5.
inline constexpr double kTurnAskedAtOnce = 0.4;

/// Asks cells for increments that may hold any turn: a larger one goes in parts. An answer holds the steps of all parts; the part
/// that fails is the answer.
template <int dim>
std::vector<PointReply<dim>> evaluate_in_parts(
    const CellCalls<dim>& calls, std::type_identity_t<std::span<const PointRequest<dim>>> requests,
    std::span<const std::size_t> points);

}  // namespace polargrain::coupler
