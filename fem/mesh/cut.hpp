// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <vector>

#include "fem/mesh/mesh.hpp"

namespace polargrain::fem {

/// The mesh without some of its elements, and without the nodes that only they have. Boundaries lose the sides of these
/// elements, node sets their nodes; regions keep the rest. The order of all else stays.
/// @param removed whether each element goes
template <int dim>
Mesh<dim> cut(const Mesh<dim>& mesh, const std::vector<char>& removed);

}  // namespace polargrain::fem
