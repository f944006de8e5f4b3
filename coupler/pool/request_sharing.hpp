// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "coupler/pool/pool.hpp"

namespace polargrain::coupler {

/// For each request the number of the first one that asks the same: equal definitions, states of one name,
/// increments with the same bits. The answer of a cell depends on nothing else, so that one answer does for
/// all of them.
std::vector<std::size_t> first_alike(std::span<const PoolRequest> requests);

}  // namespace polargrain::coupler
