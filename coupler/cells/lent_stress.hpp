// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "common/cosserat.hpp"

namespace polargrain::coupler {

// The cone of a law is a circle about the mean stress, the strength of grains is not. At the same q/p the law would have
// another friction angle wherever its intermediate stress differs from that of its cell (docs/theory/plasticity.md, B.9). So
// friction is read from the major and minor stress of the cell, and the intermediate one is lent by the law in proportion:
//
//     s2 of the cell = s2 of the law (s1 + s3) of the cell / (s1 + s3) of the law,   where the law is under pressure
//
// In the plane the stress normal to it is the intermediate one, which discs have not. All Pa, tension positive.

/// @param cell its stress; of controlled rotations with skew stress, which stays @param law its stress
template <int dim>
typename Cosserat<dim>::Vector with_lent_stress(const typename Cosserat<dim>::Vector& cell,
                                                const typename Cosserat<dim>::Vector& law);

}  // namespace polargrain::coupler
