// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "fem/element/element_type.hpp"

namespace polargrain::fem {

/// W15: a triangle of six nodes drawn out, serendipity, 3 x 3 points (triangle x height). Fits beside H20R and T10.
ElementType<3> wedge15();

}  // namespace polargrain::fem
