// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <vector>

#include "fem/element/kinematics.hpp"

namespace polargrain::fem {

/// The places that the point of an element stands for (ElementType::averaged); empty for elements with points of their own.
/// @param nodes positions, a row a node
template <int dim>
std::vector<PointGeometry<dim>> averaged_places(const ElementType<dim>& type, const VectorRows<dim>& nodes);

}  // namespace polargrain::fem
