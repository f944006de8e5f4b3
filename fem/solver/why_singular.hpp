// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <span>
#include <string>

#include "common/response.hpp"

namespace polargrain::fem {

/// Why a tangent that held before is singular now: a sentence without a full stop, which counts the points that have
/// no stiffness against strain left and says what stress they carry.
template <int dim>
std::string why_singular(std::span<const Response<dim>> responses);

}  // namespace polargrain::fem
