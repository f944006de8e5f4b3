// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <optional>
#include <span>

#include "dem/cell/condensed_tangent.hpp"

namespace polargrain::dem {

// The condensed tangents as docs/theory/grains.md, C.7 writes them, by one sparse matrix and a factorisation
// with free exchange of pivots (Eigen's SparseLU: the same bits on any processor): the reference for tests of
// CondensedTangent, and its fallback. Empty when the matrix is singular or the solution does not
// satisfy it.

std::optional<Matrix7> plain_classical_tangent(const ContactNetwork& network);

std::optional<Matrix7> plain_cosserat_tangent(const ContactNetwork& network, std::span<const double> weights);

}  // namespace polargrain::dem
