// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "common/archive.hpp"
#include "fem/solver/solver.hpp"

namespace polargrain::fem {

/// Every member of a SolverState, under its own name. A member that is added there must be added here: a member
/// left out makes a run that goes on from a checkpoint differ.
template <int dim>
void write_state(ArchiveWriter& archive, const SolverState<dim>& state);
/// @throws RunError when the archive holds the state of another mesh, or no state
template <int dim>
SolverState<dim> read_state(ArchiveReader& archive, const FieldPlaces<dim>& places, std::size_t points,
                            bool has_contributions);

}  // namespace polargrain::fem
